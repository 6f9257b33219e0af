// What the keys do, in a box that opens over the page.

import { el } from "./dom.js";

const KEYS = [
  ["space", "play and pause"],
  ["← →  or  , .", "the event before, the next event"],
  ["Shift + ← →", "the change of plan before, the next one"],
  ["Home, End", "start and end"],
  ["/", "search nodes; Esc ends it"],
  ["h", "halts only, and back"],
  ["↑ ↓ ← →", "in the tree: walk it, fold and unfold"],
  ["?", "this box"],
];

/** The button that opens the box, and a function that does the same. */
export function help() {
  const close = el("button", { type: "button", onclick: () => box.close() }, "Close");
  const rows = KEYS.map(([key, what]) => el("tr", {}, el("th", { scope: "row" }, key), el("td", {}, what)));
  const box = el(
    "dialog",
    { class: "help", "aria-label": "Keys" },
    el("h2", {}, "Keys"),
    el("table", {}, el("tbody", {}, rows)),
    close,
  );
  const open = () => box.open || box.showModal();
  const button = el(
    "button",
    { type: "button", class: "help-button", title: "Keys (?)", "aria-label": "Keys", onclick: open },
    "?",
  );
  return { element: el("div", {}, button, box), open };
}
