// Folding finished branches away: one box for one tree, or for the trees of two runs.

import { el } from "./dom.js";

/** A box that folds and unfolds what is finished in all of some trees. */
export function foldingBox(trees) {
  const box = el("input", {
    type: "checkbox",
    checked: trees.some((tree) => tree.foldFinished),
    onchange: () => {
      for (const tree of trees) tree.setFolding(box.checked);
    },
  });
  for (const tree of trees) tree.setFolding(box.checked);
  return el("label", { class: "check" }, box, "Fold finished branches");
}
