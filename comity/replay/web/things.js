// Things that are carried, picked up and handed over, where they are at a time.

import { put, svg } from "./dom.js";
import { middle, SCALE } from "./projection.js";
import { plain, short } from "./words.js";

const AHEAD = 1.25; // of the body's radius: what is held is held before the body
const HALF_M = 0.09;

export class Things {
  constructor(episode, projection) {
    Object.assign(this, { episode, projection });
    this.all = histories(episode).map((history) => ({ history, element: thing(history.name) }));
    this.element = svg(
      "g",
      {},
      this.all.map(({ element }) => element),
    );
  }

  show(t) {
    for (const { history, element } of this.all) {
      const { from, to, share } = whereabouts(history, t);
      const [a, b] = [this.place(from, t), this.place(to, t)];
      put(element, "visibility", a || b ? "visible" : "hidden");
      put(element, "data-holder", (share < 1 ? from : to)?.holder ?? "");
      if (!a && !b) continue;
      const [[x1, y1], [x2, y2]] = [a ?? b, b ?? a];
      const [x, y] = this.projection.at(x1 + share * (x2 - x1), y1 + share * (y2 - y1));
      put(element, "transform", `translate(${x.toFixed(1)} ${y.toFixed(1)})`);
    }
  }

  /** Before whoever holds it, or on the piece of furniture; null where that is not known. */
  place(where, t) {
    if (!where) return null;
    if (!where.holder) return where.xy;
    const { x, y, heading, radius } = this.episode.track.pose(where.holder, t);
    return [x + AHEAD * radius * Math.cos(heading), y + AHEAD * radius * Math.sin(heading)];
  }
}

/** Each thing with its moves in order: from when to when it goes where. */
function histories({ robot, carrying, people, acts, plans, place }) {
  const held = [[robot, carrying], ...people.map((one) => [one.name, one.carrying])]
    .filter(([, name]) => name)
    .map(([holder, name]) => ({ name, start: { holder }, moves: [] }));
  const moved = acts.filter((act) => act.thing && !act.stopped).sort((a, b) => a.start_s - b.start_s);
  const fetched = [...new Set(moved.map((act) => act.thing))].map((name) => ({
    name,
    start: source(name, plans, place),
    moves: moved
      .filter((act) => act.thing === name)
      .map((act) => ({
        from_s: act.start_s,
        until_s: act.end_s,
        to: { holder: act.act === "pick_up" ? robot : act.person },
      })),
  }));
  return [...held, ...fetched];
}

/** The piece of furniture or the room from which a plan fetches a thing. */
function source(thing, plans, { furniture, areas }) {
  const steps = plans.flatMap((plan) => plan.steps);
  const from = steps.find(({ action, parameters }) => action === "Fetch" && parameters.thing === thing);
  const found = [...furniture, ...areas].find(([name]) => name === from?.parameters.place);
  return found ? { xy: middle(found[1]) } : null;
}

function whereabouts({ start, moves }, t) {
  let at = start;
  for (const { from_s, until_s, to } of moves) {
    if (t < from_s) break;
    if (t < until_s) return { from: at, to, share: (t - from_s) / (until_s - from_s) };
    at = to;
  }
  return { from: at, to: at, share: 1 };
}

function thing(name) {
  const half = HALF_M * SCALE;
  return svg(
    "g",
    { class: "thing", "data-thing": name },
    svg("rect", { x: -half, y: -half, width: 2 * half, height: 2 * half, rx: half / 2 }),
    svg("circle", { r: half * 0.45 }),
    svg("text", { class: "thing-name", y: half, dy: "1em" }, short(plain(name), 14)),
    svg("title", {}, name),
  );
}
