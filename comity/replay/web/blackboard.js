// What the leaves share on the blackboard, as it was at the cursor.

import { el, put, say } from "./dom.js";
import { countUntil } from "./order.js";
import { seconds } from "./words.js";

const NEW_S = 1; // an entry is marked for so long after it got its value

export class Blackboard {
  constructor(episode) {
    const entries = new Map();
    for (const [t, entry, value, leaf] of episode.blackboard) {
      if (!entries.has(entry)) entries.set(entry, []);
      entries.get(entry).push({ t, value, leaf });
    }
    this.rows = [...entries].sort(([a], [b]) => (a < b ? -1 : 1)).map(([entry, writes]) => row(entry, writes));
    const head = ["Entry", "Value", "Since", "Written by"].map((name) => el("th", { scope: "col" }, name));
    const body = this.rows.map(({ element }) => element);
    this.count = el("span", { class: "count" });
    this.element = el(
      "details",
      { class: "blackboard", hidden: this.rows.length === 0 },
      el("summary", {}, "Blackboard ", this.count),
      el(
        "div",
        { class: "scroll", tabindex: 0, role: "region", "aria-label": "Blackboard" },
        el("table", {}, el("thead", {}, el("tr", {}, head)), el("tbody", {}, body)),
      ),
    );
  }

  show(t) {
    let written = 0;
    for (const { element, cells, writes } of this.rows) {
      const last = writes[countUntil(writes, t) - 1];
      element.hidden = !last;
      if (!last) continue;
      written += 1;
      put(element, "data-new", t - last.t < NEW_S);
      say(cells[0], last.value);
      say(cells[1], seconds(last.t));
      say(cells[2], last.leaf);
    }
    say(this.count, `${written} ${written === 1 ? "entry" : "entries"}`);
  }
}

function row(entry, writes) {
  const cells = [1, 2, 3].map(() => el("td", {}));
  const name = entry.split("/").flatMap((part, i) => (i > 0 ? ["/", el("wbr"), part] : [part]));
  return { writes, cells, element: el("tr", {}, el("th", { scope: "row" }, name), cells) };
}
