// Two runs side by side on one clock, with what differs between them.

import { comparison } from "./comparison.js";
import { choice, el, put } from "./dom.js";
import { foldingBox } from "./fold.js";
import { sidesTitle } from "./header.js";
import { BY_TIME, byStep } from "./sync.js";
import { View } from "./view.js";

export class SideBySide {
  constructor(episodes, parting, filter, clock) {
    Object.assign(this, { episodes, parting, filter, clock });
    this.steps = byStep(...episodes);
    this.sync = BY_TIME;
    this.views = episodes.map(
      (episode, i) => new View(episode, `side-${i}`, filter, (_, t) => this.visit(i, t)),
    );
    this.focused = 0;
    this.title = sidesTitle(episodes);
    this.controls = [
      choice(
        "Together",
        [
          ["time", "Same time"],
          ["step", "Same plan step"],
        ],
        "time",
        (by) => this.together(by),
      ),
      foldingBox(this.views.map(({ tree }) => tree)),
    ];
    this.tabs = episodes.map((episode, i) =>
      el(
        "button",
        { type: "button", role: "tab", class: "tab", onclick: () => this.look(i) },
        el("span", { class: "letter" }, "AB"[i]),
        ` ${episode.name}`,
      ),
    );
    this.parts = [...this.views.map((view, i) => this.planOf(view, i)), this.main()];
    this.look(0);
  }

  planOf(view, i) {
    return el("div", { class: "plan-of" }, el("span", { class: "letter" }, "AB"[i]), view.plan.element);
  }

  main() {
    const columns = this.views.map(({ worldPanel, series, tree }, i) => {
      worldPanel.append(el("span", { class: "letter corner" }, "AB"[i]));
      return el("div", { class: "side" }, worldPanel, series.element, tree.element);
    });
    this.compared = comparison(this.episodes, this.parting, this.filter, (i, t) => this.visit(i, t));
    const whys = el(
      "div",
      { class: "whys" },
      el("div", { class: "tabs", role: "tablist", "aria-label": "Whose events" }, this.tabs),
      this.views.map(({ why }) => why.element),
    );
    return el("main", { class: "sides" }, columns, el("div", { class: "side" }, this.compared.element, whys));
  }

  together(by) {
    const t = this.sync.there(this.clock.t);
    this.sync = by === "step" ? this.steps : BY_TIME;
    this.clock.end = this.end;
    this.filter.set({});
    this.clock.visit(this.focused === 1 ? this.sync.back(t) : this.clock.t);
  }

  /** Look at one run's events. */
  look(i) {
    this.focused = i;
    this.views.forEach(({ why }, k) => {
      why.element.hidden = k !== i;
    });
    this.tabs.forEach((tab, k) => put(tab, "aria-selected", String(k === i)));
    if (this.views[i].t !== undefined) this.filter.set({});
  }

  /** Go to a time of one run. */
  visit(i, t) {
    if (this.focused !== i) this.look(i);
    this.clock.visit(this.onClock(t));
  }

  get end() {
    const [one, other] = this.episodes;
    return this.sync === BY_TIME ? Math.max(one.end, other.end) : one.end;
  }

  get focus() {
    return this.views[this.focused];
  }

  onClock(t) {
    return this.focused === 0 ? t : this.sync.back(t);
  }

  /** When the runs part, on the clock. */
  partings() {
    return this.parting.map(({ t }) => t);
  }

  show(t) {
    this.views[0].show(t);
    this.views[1].show(this.sync.there(t));
    this.compared.show([t, this.sync.there(t)]);
  }
}
