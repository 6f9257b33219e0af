// Why: what happened around the cursor, in plain sentences, each with the chain behind it.

import { Blackboard } from "./blackboard.js";
import { chain } from "./chain.js";
import { el, say } from "./dom.js";
import { countUntil } from "./order.js";
import { revises } from "./plans.js";
import { SIGNS, did, reading } from "./status.js";
import { wordings } from "./wordings.js";
import { seconds } from "./words.js";

const AROUND = 16; // events on each side of the cursor
const ABOVE_PX = 90; // of what came before stays in sight above the chosen event

export class Why {
  constructor(episode, filter, onevent) {
    Object.assign(this, { episode, filter, onevent });
    this.event = null; // the chosen one; null: the last one before the cursor
    this.now = el("p", { class: "now", "aria-live": "polite" });
    this.list = el("ol", { class: "events", "aria-label": "Events around the cursor" });
    this.only = el("button", {
      type: "button",
      class: "only",
      hidden: true,
      onclick: () => filter.set({ node: null }),
    });
    this.element = el(
      "section",
      { class: "panel why", "aria-label": "Why" },
      el("header", {}, el("h2", {}, "Why"), (this.count = el("span", { class: "count" })), this.only),
      this.now,
      (this.blackboard = new Blackboard(episode)).element,
      (this.scroll = el("div", { class: "scroll" }, this.list)),
    );
    filter.follow(() => this.refilter());
  }

  refilter() {
    this.events = this.episode.events.filter((event) => this.filter.passes(event));
    this.only.hidden = this.filter.node === null;
    say(this.only, `only ${this.filter.node} ×`);
    this.drawn = undefined;
    if (this.t !== undefined) this.show(this.t);
  }

  /** Choose an event and go there. */
  choose(event) {
    this.event = event;
    this.onevent(event);
  }

  /** The event before or after the chosen one, of those that are shown. */
  step(direction) {
    const here = this.current();
    const place = here ? this.events.indexOf(here) : -1;
    const next = this.events[place + direction];
    if (next) this.choose(next);
  }

  /** The chosen event while the cursor stands on it, else the last one before the cursor. */
  current() {
    if (this.event && Math.abs(this.event.t - this.t) < 0.005 && this.events.includes(this.event))
      return this.event;
    return this.events[countUntil(this.events, this.t) - 1] ?? null;
  }

  show(t) {
    this.t = t;
    this.blackboard.show(t);
    const current = this.current();
    if (current === this.drawn) return;
    this.drawn = current;
    this.draw(current);
  }

  draw(current) {
    const place = this.events.indexOf(current);
    const first = Math.max(0, place - AROUND);
    const shown = this.events.slice(first, Math.max(place, 0) + AROUND);
    say(
      this.count,
      this.events.length === 0 ? "no such events" : `event ${place + 1} of ${this.events.length}`,
    );
    let before = null;
    const rows = [];
    for (const event of shown) {
      if (event.t !== before) rows.push(el("li", { class: "time", "aria-hidden": "true" }, seconds(event.t)));
      before = event.t;
      rows.push(this.row(event, event === current, event.index > (current?.index ?? -1)));
    }
    this.list.replaceChildren(...rows);
    say(this.now, this.doing());
    const row = this.list.querySelector("[aria-current=true]");
    this.scroll.scrollTop = row ? row.offsetTop - ABOVE_PX : 0;
  }

  /** What runs at the cursor, in a sentence. */
  doing() {
    const running = this.episode.nodes.filter(
      (node) => node.kind === "action" && this.episode.stateOf(node, this.t)?.status === "running",
    );
    if (running.length === 0) return "No action is running.";
    return `Running: ${running.map((node) => node.name).join(", ")}.`;
  }

  row(event, current, later) {
    const sentence = el(
      "button",
      { type: "button", class: "sentence", onclick: () => this.choose(event) },
      el("span", { class: "state", "aria-hidden": "true" }, SIGNS[event.status]),
      el("span", {}, el("b", { class: "node" }, event.node.name), ` ${did(event)}`, near(event), this.words(event)),
    );
    return el(
      "li",
      {
        class: later ? "event later" : "event",
        "data-event": event.index,
        "data-status": event.status,
        "aria-current": String(current),
      },
      sentence,
      current && this.card(event),
    );
  }

  /** What is said from an event on. */
  words(event) {
    const act = this.said(event);
    return act ? `: “${act.text}”${act.latin ? ` (${act.latin})` : ""}` : "";
  }

  /** The act of speech that begins with an event, if one does. */
  said({ t, node, status }) {
    if (node.kind !== "action" || status !== "running") return undefined;
    return this.episode.acts.find(
      ({ act: kind, text, person, start_s: start }) =>
        text !== null && person === node.person && node.action === kind && Math.abs(start - t) < 0.001,
    );
  }

  card(event) {
    const grounds = event.grounds.map((i) => this.episode.events[i]);
    const closest = event.because.length > 0 ? event : grounds[0];
    return el(
      "div",
      { class: "card" },
      wordings(this.said(event)),
      grounds.length > 0 && el("p", { class: "faint" }, "Because"),
      grounds.length > 0 &&
        el(
          "ul",
          { class: "grounds" },
          grounds.map((ground) => this.ground(ground)),
        ),
      closest?.because.length > 0 && chain(this.episode, closest),
      !closest && el("p", { class: "faint" }, "The tree asks it first, or nothing else is known about it."),
      this.filter.node === null &&
        el(
          "button",
          { type: "button", class: "link-button", onclick: () => this.filter.set({ node: event.node.name }) },
          "Only this node",
        ),
    );
  }

  ground(event) {
    return el(
      "li",
      {},
      el(
        "button",
        { type: "button", class: "link-button", onclick: () => this.choose(event) },
        event.node.name,
      ),
      ` ${did(event)} at ${seconds(event.t)}`,
      near(event),
    );
  }
}

function near(event) {
  const causes = reading(event);
  return causes.length > 0 ? `: ${causes.join(revises(event) ? "; " : ", as ")}` : "";
}
