// What became of the plan: the moments at which it changed, and for the one in force what changed and why.

import { el, put } from "./dom.js";
import { PLANS, SIGNS } from "./status.js";
import { seconds } from "./words.js";

export class Revisions {
  constructor(episode, ontime) {
    this.episode = episode;
    this.tabs = episode.plans.map((plan) => tab(plan, ontime));
    this.text = el("span", { class: "revision-text" });
    this.details = el("ul", {});
    this.box = el("details", { class: "revision-box" }, el("summary", {}, this.text), this.details);
    this.element = el(
      "div",
      { class: "revisions", role: "group", "aria-label": "Changes of the plan", hidden: this.tabs.length < 2 },
      el("div", { class: "revision-tabs" }, this.tabs),
      this.box,
    );
  }

  show(plan) {
    this.tabs.forEach((one, i) => put(one, "aria-current", String(i === plan.index)));
    this.text.replaceChildren(
      el("b", {}, capital(wordOf(plan))),
      plan.index === 0 ? "" : `: ${plan.because.join("; ")}`,
    );
    this.details.replaceChildren(...plan.because.map((text) => el("li", {}, text)));
    put(this.box, "data-empty", String(plan.because.length === 0));
  }

  /** The moment of the change before or after a time; null where there is none. */
  beside(t, direction) {
    const moments = this.episode.plans.map((plan) => plan.t);
    const found =
      direction > 0 ? moments.find((one) => one > t + 0.005) : moments.findLast((one) => one < t - 0.005);
    return found ?? null;
  }
}

const wordOf = ({ index, kind }) => (index === 0 ? "first plan" : PLANS[kind]);
const capital = (words) => words[0].toUpperCase() + words.slice(1);

function tab(plan, ontime) {
  const { t, kind, index } = plan;
  const sign = index === 0 ? "○" : SIGNS[kind];
  const word = wordOf(plan);
  return el(
    "button",
    { type: "button", class: "revision", title: word, "data-kind": kind, onclick: () => ontime(t) },
    el("span", { class: "state", "aria-hidden": "true" }, sign),
    ` ${seconds(t)}`,
    el("span", { class: "unseen" }, ` ${word}`),
  );
}
