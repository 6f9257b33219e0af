// The behaviour tree with live states, and beside each node its lane over time.

import { el, put, say } from "./dom.js";
import { Follower } from "./follow.js";
import { lane } from "./lanes.js";
import { SIGNS, stateWord } from "./status.js";
import { walk } from "./walk.js";
import { seconds } from "./words.js";

const KINDS = {
  sequence: ["→", "sequence"],
  memory_sequence: ["→*", "sequence with memory"],
  fallback: ["?", "fallback"],
  parallel: ["⇉", "parallel"],
  decorator: ["◇", "decorator"],
  condition: ["○", "condition"],
  action: ["□", "action"],
};
const MANY = 100; // nodes; beyond, finished branches are folded from the start

export class Tree {
  /**
   * @param {function(object)} onnode called with a node that was chosen
   * @param {function(number)} ontime called with a time that was clicked on a lane
   */
  constructor(episode, filter, onnode, ontime) {
    Object.assign(this, { episode, filter, onnode, ontime });
    this.foldFinished = episode.nodes.length > MANY;
    this.folded = new Map(); // what the user chose, by path
    this.several = episode.nodes.filter(({ parent }) => parent === null).length > 1;
    this.rows = episode.nodes.map((node) => this.row(node, onnode));
    this.cursor = el("div", { class: "cursor" });
    this.list = el(
      "div",
      {
        class: "tree",
        role: "tree",
        "aria-label": "Behaviour tree",
        onkeydown: (event) => walk(this, event),
        // Who clicks goes on with the arrows from event to event; who came by Tab walks the tree with them.
        onmousedown: (event) => event.preventDefault(),
      },
      this.rows.map((row) => row.element),
      el("div", { class: "cursor-frame" }, this.beyond(), this.cursor),
    );
    this.rows[0]?.element.setAttribute("tabindex", "0");
    this.header = this.head();
    this.nothing = el("p", { class: "nothing", role: "status" });
    this.element = el(
      "section",
      { class: "panel tree-panel", "aria-label": "Tree and lanes" },
      this.header,
      (this.scroll = el("div", { class: "scroll" }, this.nothing, this.list)),
    );
    this.follower = new Follower(this.scroll);
    filter.follow(() => this.arrange());
  }

  head() {
    return el(
      "header",
      {},
      el("h2", {}, "Tree"),
      el("span", { class: "count" }, `${this.episode.nodes.length} nodes`),
    );
  }

  row(node, onnode) {
    const [sign, kind] = KINDS[node.kind] ?? ["·", node.kind];
    const twisty = el("span", {
      class: "twisty",
      "aria-hidden": "true",
      onclick: (event) => {
        event.stopPropagation();
        this.fold(node, !this.isFolded(node));
      },
    });
    const state = el("span", { class: "state", "aria-hidden": "true" }, SIGNS.idle);
    const label = el(
      "span",
      { class: "label", title: `${node.name} (${kind})` },
      twisty,
      el("span", { class: "kind", title: kind }, sign),
      el("span", { class: "name" }, node.name),
      this.several && node.parent === null && el("span", { class: "count" }, this.planOf(node)),
    );
    const track = el(
      "div",
      {
        class: "track",
        onclick: (event) => {
          event.stopPropagation();
          this.clicked(event, track);
        },
      },
      lane(node, this.episode.end, this.episode.span),
    );
    const element = el(
      "div",
      {
        class: "row",
        role: "treeitem",
        "aria-level": node.depth + 1,
        "data-node": node.name,
        "data-path": node.path,
        "data-status": "idle",
        tabindex: "-1",
        onclick: () => onnode(node),
      },
      state,
      label,
      track,
    );
    element.style.setProperty("--depth", node.depth);
    return { node, element, twisty, state };
  }

  /** From when on a tree is that of the plan: each new plan has one of its own. */
  planOf(root) {
    const plan = this.episode.plans.find(({ event }) => event && event.node.path >= root.path);
    const anew = root.path > 0 && plan;
    return anew ? `plan from ${seconds(plan.t)}` : "first plan";
  }

  clicked(event, track) {
    const box = track.getBoundingClientRect();
    this.ontime(((event.clientX - box.left) / box.width) * this.episode.span);
  }

  /** Where the lanes of the longer run go on after this one has ended. */
  beyond() {
    const { end, span } = this.episode;
    if (end >= span) return null;
    const element = el("div", { class: "beyond" });
    element.style.left = `${(100 * end) / span}%`;
    return element;
  }

  /** Mark a node, and bring it into sight. */
  mark(node) {
    this.marked = node;
    const row = this.showMark();
    if (row) this.follower.nudge(row.element);
  }

  /** The mark stands on the node, or where that is folded away on the nearest one above it in sight. */
  showMark() {
    const marked = this.marked && this.inSight(this.marked);
    for (const row of this.rows) put(row.element, "aria-selected", String(row === marked));
    return marked;
  }

  /** The row of a node or of the nearest one above it that is not folded away. */
  inSight(node) {
    for (let one = node; one; one = this.episode.nodes[one.parent])
      if (!this.rows[one.path].element.hidden) return this.rows[one.path];
    return null;
  }

  focus(node) {
    for (const row of this.rows) put(row.element, "tabindex", row.node === node ? "0" : "-1");
    this.rows[node.path].element.focus({ preventScroll: true });
  }

  setFolding(on) {
    this.foldFinished = on;
    this.folded.clear();
    this.arrange();
  }

  fold(node, folded) {
    if (node.children.length === 0) return;
    this.folded.set(node.path, folded);
    this.arrange();
  }

  isFolded(node) {
    if (this.folded.has(node.path)) return this.folded.get(node.path);
    const state = this.rows[node.path].status;
    if (node.parent === null) return this.foldFinished && this.isOver(node);
    return this.foldFinished && state !== "running" && state !== undefined;
  }

  /** Whether the tree of an earlier plan has given way to that of a later one. */
  isOver(root) {
    const later = this.rows.find(({ node }) => node.parent === null && node.path > root.path);
    return later !== undefined && later.status !== undefined && later.status !== "idle";
  }

  show(t) {
    this.cursor.style.left = `${this.episode.span > 0 ? (100 * t) / this.episode.span : 0}%`;
    let changed = false;
    for (const row of this.rows) {
      const event = this.episode.stateOf(row.node, t);
      if (row.event === event && row.status) continue;
      row.event = event;
      row.status = event?.status ?? "idle";
      put(row.element, "data-status", row.status);
      put(row.element, "aria-label", `${row.node.name}, ${stateWord(event)}`);
      say(row.state, SIGNS[row.status]);
      row.state.title = stateWord(event);
      changed = true;
    }
    if (changed && this.foldFinished) this.arrange();
    if (changed) this.running = this.runningNode();
    this.follower.follow(this.running && this.inSight(this.running)?.element);
  }

  /** The action that began last of those that run. */
  runningNode() {
    const running = this.rows.filter(({ node, status }) => node.kind === "action" && status === "running");
    if (running.length === 0) return null;
    return running.reduce((last, row) => (row.event.index > last.event.index ? row : last)).node;
  }

  /** Which rows are in sight: not below a folded one, and with a filter only what it asks for and its parents. */
  arrange() {
    const { filter } = this;
    const narrowed = Boolean(filter.person || filter.text);
    const wanted = new Set();
    if (narrowed) {
      for (const { node } of this.rows) {
        if (!filter.passesNode(node)) continue;
        for (let one = node; one; one = this.episode.nodes[one.parent]) wanted.add(one.path);
      }
    }
    say(this.nothing, narrowed && wanted.size === 0 ? this.noHit() : "");
    this.list.hidden = narrowed && wanted.size === 0;
    const below = new Set();
    for (const { node, element, twisty } of this.rows) {
      const covered = node.parent !== null && below.has(node.parent);
      const folded = !filter.text && this.isFolded(node);
      if (covered || folded) below.add(node.path);
      put(element, "data-found", String(narrowed && filter.passesNode(node)));
      element.hidden = covered || (narrowed && !wanted.has(node.path));
      if (node.children.length === 0) continue;
      put(element, "aria-expanded", String(!folded));
      say(twisty, folded ? "▸" : "▾");
    }
    this.showMark();
  }

  noHit() {
    const { text, person } = this.filter;
    const whose = person ? ` of ${person}` : "";
    return text ? `No node${whose} is called “${text}”. Esc empties the search.` : `No node${whose}.`;
  }
}
