// The place: room, walls and furniture with their names, the doors, and what groups keep open.

import { Doors } from "./doors.js";
import { svg } from "./dom.js";
import { Groups } from "./groups.js";
import { SCALE, middle } from "./projection.js";
import { plain, short } from "./words.js";

const LETTER_PX = 7;
const LINE_PX = 14;

export class Place {
  constructor({ place, account, groups }, projection) {
    const { room, holes, walls, areas, furniture } = place;
    this.projection = projection;
    this.doors = new Doors(place.doors, account.doors, projection);
    this.names = furniture.map((piece) => this.named(piece, "furniture-name"));
    this.areas = areas.map((area) => this.named(area, "area-name"));
    const floor = [room, ...holes].map((outline) => `M ${projection.points(outline)} Z`).join(" ");
    this.groups = new Groups(groups, floor, projection);
    this.element = svg(
      "g",
      {},
      svg("path", { class: "room", d: floor, "fill-rule": "evenodd" }),
      this.groups.element,
      furniture.map(([name, corners]) => this.piece(name, corners)),
      walls.map((wall) => this.wall(wall)),
      this.doors.element,
    );
    this.labels = svg("g", {}, [...this.names, ...this.areas].map(({ text }) => text));
  }

  piece(name, corners) {
    const shape = svg("polygon", { class: "furniture", points: this.projection.points(corners) });
    return svg("g", {}, shape, svg("title", {}, plain(name)));
  }

  wall([ax, ay, bx, by, thick]) {
    const [[x1, y1], [x2, y2]] = [this.projection.at(ax, ay), this.projection.at(bx, by)];
    return svg("line", { class: "wall", x1, y1, x2, y2, "stroke-width": thick * SCALE });
  }

  /** A name in the middle of a shape, with the shape's width. */
  named([name, corners], kind) {
    const [x, y] = this.projection.at(...middle(corners));
    const xs = corners.map(([x]) => x);
    const wide = (Math.max(...xs) - Math.min(...xs)) * SCALE;
    return { wide, x, y, text: svg("text", { class: kind, x, y }, short(plain(name))) };
  }

  /** Hide the names for which there is no room: rooms' outside their rooms, furniture's on other names. */
  fit(perUnit) {
    const taken = [];
    for (const named of [...this.areas, ...this.names.toSorted((a, b) => b.wide - a.wide)]) {
      const box = boxOf(named, perUnit);
      const inside = this.areas.includes(named) ? box.half * 2 <= named.wide * perUnit : this.holds(box, perUnit);
      const shown = inside && !taken.some((other) => overlap(box, other));
      named.text.style.display = shown ? "" : "none";
      if (shown) taken.push(box);
    }
  }

  /** Whether a name does not stick out of the drawing. */
  holds({ x, half }, perUnit) {
    return x - half >= 0 && x + half <= this.projection.width * perUnit;
  }

  show(t) {
    this.doors.show(t);
    this.groups.show(t);
  }
}

/** Where a name stands on the screen [px], about. */
const boxOf = ({ x, y, text }, perUnit) => ({
  x: x * perUnit,
  y: y * perUnit,
  half: (text.textContent.length * LETTER_PX) / 2,
});

const overlap = (a, b) => Math.abs(a.x - b.x) < a.half + b.half && Math.abs(a.y - b.y) < LINE_PX;
