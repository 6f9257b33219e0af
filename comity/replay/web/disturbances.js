// What happened whatever the robot did: changes, faults, messages and walks, each at its time.

import { el, put } from "./dom.js";
import { INSTANT } from "./order.js";
import { seconds } from "./words.js";

/** One button for each; it is current while the disturbance lasts. */
export class Disturbances {
  constructor(episode, ontime) {
    this.all = episode.account.disturbances;
    this.tabs = this.all.map(({ t, kind, text }) =>
      el(
        "button",
        { type: "button", class: "disturbance", title: text, "data-kind": kind, onclick: () => ontime(t) },
        `${seconds(t)} `,
        el("b", {}, kind),
        ` ${text}`,
      ),
    );
    this.element = el(
      "div",
      { class: "disturbances", role: "group", "aria-label": "What happened", hidden: this.all.length === 0 },
      this.tabs,
    );
  }

  show(now) {
    this.all.forEach(({ t, end_s: end }, i) => {
      const state = t > now + INSTANT ? "to come" : end === null || end > now ? "under way" : "over";
      put(this.tabs[i], "data-state", state);
    });
  }
}
