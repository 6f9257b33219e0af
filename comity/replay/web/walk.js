// Walking the tree with the arrow keys, as trees are walked everywhere.

/** Do what a key says where the keyboard is in a tree. */
export function walk(tree, event) {
  const row = tree.rows.find((one) => one.element === document.activeElement);
  if (!row || event.shiftKey) return;
  const seen = tree.rows.filter((one) => !one.element.hidden);
  const place = seen.indexOf(row);
  const { node } = row;
  const act = {
    ArrowDown: () => seen[place + 1] && tree.focus(seen[place + 1].node),
    ArrowUp: () => seen[place - 1] && tree.focus(seen[place - 1].node),
    ArrowRight: () =>
      tree.isFolded(node) ? tree.fold(node, false) : node.children[0] && tree.focus(node.children[0]),
    ArrowLeft: () =>
      node.children.length > 0 && !tree.isFolded(node)
        ? tree.fold(node, true)
        : node.parent !== null && tree.focus(tree.episode.nodes[node.parent]),
    Enter: () => tree.onnode(node),
  }[event.key];
  if (!act) return;
  event.preventDefault();
  event.stopPropagation();
  act();
  tree.follower.nudge(document.activeElement);
}
