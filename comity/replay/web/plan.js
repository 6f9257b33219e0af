// The plan as a strip of steps: what is done, what is under way, and why a step is done this way.

import { el, put, say } from "./dom.js";
import { measured, plain } from "./words.js";

const SIGNS = { done: "✓", current: "▶", failed: "✕", pending: "○" };

export class Plan {
  constructor(episode, ontime) {
    this.episode = episode;
    this.steps = episode.steps.map((step) => this.step(step, ontime));
    const left = episode.plan.unreachable.map(({ person, reason }) =>
      el(
        "li",
        { class: "step unreachable", title: reason },
        el("b", {}, "✕"),
        el("span", {}, `${person}: cannot be reached`),
      ),
    );
    this.element = el(
      "ol",
      { class: "plan", "aria-label": "Plan" },
      this.steps.map(({ element }) => element),
      left,
    );
  }

  step(step, ontime) {
    const sign = el("b", { "aria-hidden": "true" }, SIGNS.pending);
    const how = step.arguments.filter(
      (one) => one !== step.person && one !== this.episode.robot && one !== "none",
    );
    const element = el(
      "li",
      { class: "step", "data-state": "pending", title: step.why.text },
      el(
        "button",
        { type: "button", disabled: step.start === null, onclick: () => ontime(step.start) },
        sign,
        el("span", { class: "action" }, plain(step.action)),
        el("span", { class: "who" }, step.person ?? ""),
        el(
          "span",
          { class: "how" },
          [how.map(plain).join(", "), firstNumber(step)].filter(Boolean).join(" · "),
        ),
      ),
    );
    return { step, element, sign };
  }

  show(t) {
    for (const { step, element, sign } of this.steps) {
      const state = this.state(step, t);
      if (state === "current" && element.dataset.state !== state) this.bringIntoSight(element);
      put(element, "data-state", state);
      put(element, "aria-current", state === "current" ? "step" : "false");
      say(sign, SIGNS[state]);
    }
  }

  /** Scroll the strip, and nothing else. */
  bringIntoSight(element) {
    this.element.scrollLeft = element.offsetLeft - (this.element.clientWidth - element.offsetWidth) / 2;
  }

  state({ node }, t) {
    const event = node && this.episode.stateOf(node, t);
    if (!event) return "pending";
    if (event.status === "running") return "current";
    return event.status === "success" || event.halt === "achieved_early" ? "done" : "failed";
  }
}

function firstNumber({ parameters }) {
  const distance = parameters.conversational_distance;
  return typeof distance === "number" ? measured(distance, "m", 2) : "";
}
