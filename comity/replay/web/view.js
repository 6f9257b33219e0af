// One run with all its parts, shown at one moment.

import { INSTANT } from "./order.js";
import { Plan } from "./plan.js";
import { Series } from "./series.js";
import { Tree } from "./tree.js";
import { Why } from "./why.js";
import { World } from "./world.js";
import { el } from "./dom.js";
import { seconds } from "./words.js";

const TALL = 1.5; // height to width of a place whose panel is as high as the page

export class View {
  /**
   * @param {function(View, number)} ontime called with a time of this run that was asked for
   */
  constructor(episode, id, filter, ontime) {
    this.episode = episode;
    this.filter = filter;
    this.ontime = ontime;
    const go = (t) => {
      this.why.event = null;
      ontime(this, t);
    };
    const goEvent = (event) => {
      this.why.event = event;
      ontime(this, event.t);
      this.tree.mark(event.node);
    };
    this.world = new World(episode);
    this.plan = new Plan(episode, go);
    this.series = new Series(episode, id, filter, go);
    this.why = new Why(episode, filter, goEvent);
    this.tree = new Tree(episode, filter, (node) => this.chooseNode(node), go);
    const { width, height } = this.world.projection;
    const tall = height > TALL * width ? " tall" : "";
    this.worldPanel = el(
      "section",
      { class: `panel world-panel${tall}`, "aria-label": "World" },
      this.world.element,
      (this.over = el("p", { class: "over", hidden: true }, `ended at ${seconds(episode.end)}`)),
    );
  }

  /** Go to what a node did last before the cursor, or first of all. */
  chooseNode(node) {
    const event = this.episode.stateOf(node, this.t) ?? node.events[0];
    this.tree.mark(node);
    if (!event) return;
    if (!this.filter.passes(event)) this.filter.set({ node: null, asked: event });
    this.why.choose(event);
  }

  /** Go to the change of plan before or after the cursor. */
  visitPlan(direction) {
    const t = this.plan.revisions.beside(this.t, direction);
    if (t === null) return;
    this.why.event = this.episode.planAt(t).event;
    this.ontime(this, t);
  }

  /** Show a time; after the end everything stays as it was then. */
  show(t) {
    this.t = Math.min(t, this.episode.end);
    this.over.hidden = t <= this.episode.end + INSTANT;
    for (const part of [this.world, this.plan, this.series, this.tree, this.why]) part.show(this.t);
  }
}
