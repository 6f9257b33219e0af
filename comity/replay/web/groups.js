// What groups keep open between them, as it is at a time: on the floor, below furniture and walls.

import { put, svg } from "./dom.js";
import { countUntil } from "./order.js";
import { SCALE } from "./projection.js";

let floors = 0; // two runs on one page clip to a floor of their own each

export class Groups {
  /**
   * @param {object[]} turns the spaces from a time on, by time: each with its middle, radius [m] and members
   * @param {string} floor the outline that nothing sticks out of
   */
  constructor(turns, floor, projection) {
    const id = `floor-${floors++}`;
    this.turns = turns;
    this.drawn = turns.map(({ spaces }) =>
      svg(
        "g",
        { visibility: "hidden" },
        spaces.map((space) => disc(space, projection)),
      ),
    );
    this.element = svg(
      "g",
      { class: "groups", "clip-path": `url(#${id})` },
      svg("clipPath", { id }, svg("path", { d: floor, "clip-rule": "evenodd" })),
      this.drawn,
    );
  }

  show(t) {
    const now = countUntil(this.turns, t) - 1;
    this.drawn.forEach((drawn, i) => put(drawn, "visibility", i === now ? "inherit" : "hidden"));
  }
}

function disc({ x, y, radius, members }, projection) {
  const [cx, cy] = projection.at(x, y).map((n) => n.toFixed(1));
  const words = `space that ${members.slice(0, -1).join(", ")} and ${members.at(-1)} keep open`;
  return svg("circle", { class: "o-space", cx, cy, r: (radius * SCALE).toFixed(1) }, svg("title", {}, words));
}
