// One run on the whole page.

import { foldingBox } from "./fold.js";
import { title } from "./header.js";
import { View } from "./view.js";
import { el } from "./dom.js";

export class Single {
  constructor([episode], filter, clock) {
    this.view = new View(episode, "one", filter, (_, t) => clock.visit(t));
    this.title = title(episode);
    this.controls = [];
    this.view.tree.header.append(foldingBox([this.view.tree]));
    const { plan, worldPanel, series, tree, why } = this.view;
    this.parts = [
      plan.element,
      el("main", { class: "single" }, worldPanel, series.element, tree.element, why.element),
    ];
  }

  get end() {
    return this.view.episode.end;
  }

  /** The run whose events the arrow keys go through. */
  get focus() {
    return this.view;
  }

  /** When that run's time is t, on the clock. */
  onClock(t) {
    return t;
  }

  partings() {
    return [];
  }

  show(t) {
    this.view.show(t);
  }
}
