// The plan in force as a strip of steps: what is done, what is under way, and why a step is done this way.

import { el, put, say } from "./dom.js";
import { Disturbances } from "./disturbances.js";
import { Revisions } from "./revisions.js";
import { measured, plain } from "./words.js";

const SIGNS = { done: "✓", current: "▶", failed: "✕", halted: "■", skipped: "–", declined: "–", pending: "○" };
const STATES = {
  done: "done",
  current: "under way",
  failed: "failed",
  halted: "stopped",
  skipped: "left out",
  declined: "declined",
  pending: "to come",
};

export class Plan {
  constructor(episode, ontime) {
    Object.assign(this, { episode, ontime });
    this.strip = el("ol", { class: "plan", "aria-label": "Plan" });
    this.revisions = new Revisions(episode, ontime);
    this.disturbances = new Disturbances(episode, ontime);
    this.element = el(
      "div",
      { class: "plan-panel" },
      this.strip,
      this.revisions.element,
      this.disturbances.element,
    );
  }

  show(t) {
    const plan = this.episode.planAt(t);
    if (plan !== this.plan) this.draw(plan);
    this.disturbances.show(t);
    for (const shown of this.steps) {
      const state = this.state(shown.step, t);
      if (shown.state !== state) this.mark(shown, state);
    }
  }

  draw(plan) {
    this.plan = plan;
    this.steps = plan.steps.map((step) => this.step(step));
    const unserved = Object.entries(plan.unserved).map(([person, reason]) => unable(person, reason));
    this.strip.replaceChildren(...this.steps.map(({ element }) => element), ...unserved);
    this.revisions.show(plan);
  }

  step(step) {
    const sign = el("b", { "aria-hidden": "true" }, SIGNS.pending);
    const button = el(
      "button",
      { type: "button", disabled: step.start === null, onclick: () => this.ontime(step.start) },
      sign,
      el("span", { class: "action" }, plain(step.action)),
      el("span", { class: "who" }, step.people.join(" and ")),
      el("span", { class: "how" }, how(step)),
      formerly(step) && el("span", { class: "was" }, formerly(step)),
    );
    const look = formerly(step) ? "step changed" : "step";
    const element = el("li", { class: look, "data-state": "pending", title: step.why.text }, button);
    return { step, element, sign, button };
  }

  mark(shown, state) {
    const { element, sign, button } = shown;
    shown.state = state;
    if (state === "current") this.bringIntoSight(element);
    put(element, "data-state", state);
    put(element, "aria-current", state === "current" ? "step" : "false");
    put(button, "aria-label", `${button.textContent.slice(1)}, ${STATES[state]}`);
    say(sign, SIGNS[state]);
  }

  /** Scroll the strip, and nothing else. */
  bringIntoSight(element) {
    this.strip.scrollLeft = element.offsetLeft - (this.strip.clientWidth - element.offsetWidth) / 2;
    this.strip.scrollTop = element.offsetTop - (this.strip.clientHeight - element.offsetHeight) / 2;
  }

  state({ nodes, action, people }, t) {
    if (action === "Skip_visit") return "skipped";
    const events = nodes.map((node) => this.episode.stateOf(node, t)).filter(Boolean);
    if (events.length === 0) return "pending";
    if (events.some(({ status }) => status === "running")) return "current";
    const last = events.reduce((one, other) => (other.index > one.index ? other : one));
    if (last.status === "success" || last.halt === "achieved_early") return "done";
    if (last.status === "halted") return "halted";
    return this.declined(people) ? "declined" : "failed";
  }

  /** Whether a step failed because the person declined. */
  declined(people) {
    return this.episode.visits.some(({ person, outcome }) => people.includes(person) && outcome === "declined");
  }
}

function unable(person, reason) {
  const sign = el("b", { "aria-hidden": "true" }, SIGNS.failed);
  return el(
    "li",
    { class: "step unreachable", title: reason },
    sign,
    el("span", { class: "action" }, `${person} cannot be served`),
    el("span", { class: "how" }, reason),
  );
}

/** How a step is done, in a few words. */
const how = (step) => parts(step).filter(Boolean).join(" · ");

/** How a step was done by the plan before, as far as that was otherwise. */
function formerly(step) {
  if (step.was === null) return "new";
  if (!step.was) return "";
  const now = parts(step);
  const other = parts(step.was).filter((part, i) => part && part !== now[i]);
  return other.length > 0 ? `was ${other.join(" · ")}` : "";
}

function parts({ action, arguments: [, , ...words], parameters }) {
  const distance = parameters.conversational_distance;
  const near = typeof distance === "number" ? measured(distance, "m", 2) : "";
  return [manner(action, words, parameters), near];
}

function manner(action, words, { text, thing, place, cap_s: cap, until }) {
  if (text !== undefined) return `“${text}”`;
  if (action === "Fetch") return `${plain(thing)} from ${plain(place)}`;
  if (cap !== undefined) return until ? `until they ${plain(until)}, at most ${cap} s` : `${cap} s`;
  return words
    .filter((one) => one !== "none")
    .map(plain)
    .join(", ");
}
