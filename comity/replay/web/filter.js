// What of a run is shown: which events, whose, of which node, and what is searched for.

import { revises } from "./plans.js";

export const LEVELS = [
  ["deeds", "What happened"],
  ["halts", "Halts only"],
  ["plans", "Changes of plan"],
  ["all", "Every change"],
];

export class Filter {
  constructor() {
    this.level = "deeds";
    this.person = "";
    this.node = null; // a name
    this.text = "";
    this.asked = null; // an event that is shown beside the others because its node was chosen
    this.listeners = [];
  }

  follow(listener) {
    this.listeners.push(listener);
    listener(this);
  }

  set(change) {
    if (Object.keys(change).length > 0) this.asked = null;
    Object.assign(this, change);
    for (const listener of this.listeners) listener(this);
  }

  /** Whether an event is shown: composites only repeat what their leaves did. */
  passes(event) {
    if (event === this.asked) return true;
    if (!this.passesNode(event.node)) return false;
    if (this.node !== null && event.node.name !== this.node) return false;
    if (this.level === "halts") return event.status === "halted";
    if (this.level === "plans") return revises(event);
    return this.level === "all" || this.node !== null || this.tells(event);
  }

  tells({ node, status, halt }) {
    if (node.children.length === 0) return true;
    return status === "failure" || (halt !== null && halt === "timed_out");
  }

  /** Whether a node is shown for its own sake. */
  passesNode(node) {
    if (this.person && node.person !== this.person) return false;
    return node.name.toLowerCase().includes(this.text.toLowerCase());
  }
}
