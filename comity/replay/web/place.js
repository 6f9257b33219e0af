// The place: room, walls and furniture with their names, and the doors.

import { Doors } from "./doors.js";
import { svg } from "./dom.js";
import { SCALE, middle } from "./projection.js";
import { plain, short } from "./words.js";

const MUCH = 30; // pieces of furniture: with more, only the names that fit into their pieces are shown
const LETTER_PX = 7;

export class Place {
  constructor({ place, account }, projection) {
    const { room, holes, walls, areas, furniture } = place;
    this.projection = projection;
    this.doors = new Doors(place.doors, account.doors, projection);
    this.names = furniture.map((piece) => this.named(piece, "furniture-name"));
    this.areas = areas.map((area) => this.named(area, "area-name"));
    const floor = [room, ...holes].map((outline) => `M ${projection.points(outline)} Z`).join(" ");
    this.element = svg(
      "g",
      {},
      svg("path", { class: "room", d: floor, "fill-rule": "evenodd" }),
      furniture.map(([name, corners], i) => this.piece(name, corners, this.names[i].text)),
      this.areas.map(({ text }) => text),
      walls.map((wall) => this.wall(wall)),
      this.doors.element,
    );
  }

  piece(name, corners, text) {
    const shape = svg("polygon", { class: "furniture", points: this.projection.points(corners) });
    return svg("g", {}, shape, svg("title", {}, plain(name)), text);
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
    return { wide, text: svg("text", { class: kind, x, y }, short(plain(name))) };
  }

  /** Hide the names for which there is no room. */
  fit(perUnit) {
    for (const { wide, text } of [...(this.names.length > MUCH ? this.names : []), ...this.areas]) {
      text.style.display = wide * perUnit < text.textContent.length * LETTER_PX ? "none" : "";
    }
  }

  show(t) {
    this.doors.show(t);
  }
}
