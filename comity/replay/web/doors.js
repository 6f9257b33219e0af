// Doors, open or shut as they are at a time: a leaf that turns or slides, and the way it swings.

import { put, svg } from "./dom.js";
import { countUntil } from "./order.js";

const TURNS_S = 0.4; // in the world a door is open or shut at once; in the drawing its leaf takes so long

export class Doors {
  /**
   * @param {object[]} doors with their leaves, open and shut
   * @param {object[]} turns when which door was opened or shut, by time
   */
  constructor(doors, turns, projection) {
    this.projection = projection;
    this.drawn = doors.map((door) =>
      this.door(
        door,
        turns.filter((turn) => turn.door === door.name),
      ),
    );
    this.element = svg(
      "g",
      {},
      this.drawn.map(({ element }) => element),
    );
  }

  door(door, turns) {
    if (door.kind === "opening") {
      const line = svg("polyline", { class: "swing", points: this.projection.points(door.line) });
      return { door, turns, element: svg("g", { class: "door opening" }, line, title(`${door.name}`)) };
    }
    const leaf = svg("polyline", { class: "leaf" });
    const swing = svg("polyline", { class: "swing", points: this.projection.points(door.swing) });
    const told = title("");
    const element = svg("g", { class: "door", "data-door": door.name }, swing, leaf, told);
    return { door, turns, element, leaf, told };
  }

  show(t) {
    for (const { door, turns, element, leaf, told } of this.drawn) {
      if (!leaf) continue;
      const last = turns[countUntil(turns, t) - 1];
      const open = last ? last.open : door.open;
      const turned = last ? Math.min((t - last.t) / TURNS_S, 1) : 1;
      put(element, "data-state", open ? "open" : "closed");
      put(leaf, "points", this.projection.points(leafAt(door, open ? turned : 1 - turned)));
      const text = `door ${door.name}, ${open ? "open" : "closed"}`;
      if (told.textContent !== text) told.textContent = text;
    }
  }
}

/** The leaf of a door that is open to a share. */
function leafAt({ shut_leaf: shut, open_leaf: open, swing }, share) {
  if (swing.length > 0) return [shut[0], swing[Math.round(share * (swing.length - 1))]];
  return shut.map(([x, y], i) => [x + share * (open[i][0] - x), y + share * (open[i][1] - y)]);
}

const title = (text) => svg("title", {}, text);
