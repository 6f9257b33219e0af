// The world from above: the room, people with the distance that they like, the robot, its route and path, its gaze.

import { Bubble } from "./bubble.js";
import { el, put, say, svg } from "./dom.js";
import { lookOf, withClass } from "./look.js";
import { labelBox, labelPlaces, leastCovering, nameBox, nameLines, overlap } from "./name_place.js";
import { Place } from "./place.js";
import { MARGIN_M, Projection, SCALE } from "./projection.js";
import { Things } from "./things.js";
import { measured, short } from "./words.js";

const GAZE_M = 1.1;
const GAZE_RAD = 0.42;
const EDGE_PX = 6;
const FOOT_PX = 18; // below the room, at least: a metre stands there
const LEGIBLE_PX = 45; // to a metre; in a smaller drawing what is carried goes without its name

export class World {
  constructor(episode) {
    this.episode = episode;
    this.projection = new Projection(episode.place.room);
    this.place = new Place(episode, this.projection);
    this.things = new Things(episode, this.projection);
    this.moving = new Map();
    this.names = new Map();
    this.bubble = new Bubble();
    this.drawing = svg(
      "svg",
      { role: "img", "aria-label": "The world from above" },
      this.place.element,
      this.scaleBar(),
      this.rings(),
      this.gaze(),
      this.place.labels,
      this.planned(),
      this.driven(),
      this.gap(),
      this.passersBy(),
      episode.people.map((person) => this.person(person)),
      this.robot(),
      this.things.element,
    );
    this.element = el("div", { class: "world" }, this.drawing, this.bubble.element);
    new ResizeObserver(() => this.fit()).observe(this.element);
  }

  /** Letters have the same size on the screen, however large the room is. */
  fit() {
    const { width, height } = this.projection;
    const { clientWidth: wide, clientHeight: high } = this.element;
    const room = height - MARGIN_M * SCALE; // down to its lower wall
    const shown = Math.min(wide / width, high / height, (high - FOOT_PX) / room);
    this.perUnit = shown > 0 ? shown : 1;
    this.height = Math.max(height, room + FOOT_PX / this.perUnit);
    this.drawing.setAttribute("viewBox", `0 0 ${width} ${this.height}`);
    this.metre.setAttribute("transform", `translate(0 ${(room + this.height) / 2})`);
    this.drawing.style.setProperty("--px", `${1 / this.perUnit}px`);
    this.drawing.classList.toggle("small", this.perUnit * SCALE < LEGIBLE_PX);
    this.place.fit(this.perUnit);
    for (const name of this.names.values()) name.half = name.text.getComputedTextLength() / 2;
    if (this.t !== undefined) this.show(this.t);
  }

  /** A metre, below the room. */
  scaleBar() {
    const left = MARGIN_M * SCALE;
    const bar = svg("line", { x1: left, x2: left + SCALE });
    this.metre = svg("g", { class: "scale-bar" }, bar, svg("text", { x: left + SCALE * 1.08 }, "1 m"));
    return this.metre;
  }

  rings() {
    this.wishes = this.episode.people.map((person) => {
      const { name } = person;
      const title = svg("title", {});
      const ring = svg("circle", withClass("ring", lookOf(person)), title);
      const { radius } = this.episode.track.bodies.get(name);
      return { name, radius, ring, title };
    });
    return this.wishes.map(({ name, ring }) => this.follow(name, svg("g", {}, ring), false));
  }

  person(person) {
    const { name, posture } = person;
    const radius = this.episode.track.bodies.get(name).radius * SCALE;
    const nose = `M ${radius * 1.45} 0 L ${radius * 0.72} ${-radius * 0.55} L ${radius * 0.72} ${radius * 0.55} Z`;
    const seat =
      posture === "seated" &&
      svg("rect", {
        class: "seat",
        x: -radius * 1.35,
        y: -radius * 1.35,
        width: radius * 2.7,
        height: radius * 2.7,
        rx: radius * 0.4,
      });
    const body = svg(
      "g",
      {},
      seat,
      svg("path", { d: nose, class: "nose" }),
      svg("circle", { class: "body", r: radius }),
    );
    const name_ = svg("text", { class: "person-name" }, short(name));
    const heading = this.episode.track.pose(name, 0).heading;
    const above = Math.sin(heading) < 0; // the name stands where the person does not look
    this.names.set(name, { text: name_, above, body: radius });
    const group = svg(
      "g",
      { ...withClass("person", lookOf(person)), "data-person": name },
      this.follow(name, body, true),
      this.follow(name, svg("g", {}, name_), false),
    );
    group.append(svg("title", {}, `${name}, ${posture}`));
    return group;
  }

  /** Those whom nobody planned for: bodies that are neither the robot nor somebody of the scenario. */
  passersBy() {
    const known = new Set([this.episode.robot, ...this.episode.people.map(({ name }) => name)]);
    const others = [...this.episode.track.bodies].filter(([name]) => !known.has(name));
    return others.map(([name, { radius }]) => {
      const body = svg("circle", { class: "passer-by", r: radius * SCALE }, svg("title", {}, name));
      return this.follow(name, svg("g", {}, body), false);
    });
  }

  /** The route of the plan in force: what came afterwards is not in it. */
  planned() {
    this.route = svg("polyline", { class: "planned" }, svg("title", {}, "route as planned"));
    return this.route;
  }

  /** The path up to now. */
  driven() {
    const { x, y } = this.episode.track.bodies.get(this.episode.robot);
    const corners = Array.from(x, (one, i) => [one, y[i]]);
    const points = this.projection.points(corners);
    this.length = [0];
    for (let i = 1; i < corners.length; i++) {
      this.length.push(this.length[i - 1] + Math.hypot(x[i] - x[i - 1], y[i] - y[i - 1]) * SCALE);
    }
    this.travelled = svg("polyline", { class: "travelled", points }, svg("title", {}, "path that was driven"));
    return this.travelled;
  }

  gap() {
    this.line = svg("line", { class: "gap" });
    this.label = svg("text", { class: "gap-label" });
    this.gapGroup = svg("g", { visibility: "hidden" }, this.line, this.label);
    return this.gapGroup;
  }

  gaze() {
    const [dx, dy] = [Math.cos(GAZE_RAD) * GAZE_M * SCALE, Math.sin(GAZE_RAD) * GAZE_M * SCALE];
    const gaze = svg("path", {
      class: "gaze",
      d: `M 0 0 L ${dx} ${-dy} A ${GAZE_M * SCALE} ${GAZE_M * SCALE} 0 0 1 ${dx} ${dy} Z`,
    });
    return this.follow(this.episode.robot, svg("g", {}, gaze), true);
  }

  robot() {
    const radius = this.episode.track.bodies.get(this.episode.robot).radius * SCALE;
    const eyes = [-1, 1].map((side) =>
      svg("circle", { class: "eye", cx: radius * 0.55, cy: side * radius * 0.34, r: radius * 0.15 }),
    );
    const body = svg(
      "g",
      { class: "robot", "data-robot": this.episode.robot },
      svg("circle", { class: "body", r: radius }),
      eyes,
    );
    return this.follow(this.episode.robot, body, true);
  }

  /** Remember that a group goes where a body goes. */
  follow(name, group, turns) {
    this.moving.set(group, { name, turns });
    return group;
  }

  show(t) {
    this.t = t;
    const { track, robot } = this.episode;
    for (const [group, { name, turns }] of this.moving) {
      const pose = track.pose(name, t);
      const [x, y] = this.projection.at(pose.x, pose.y);
      const turn = turns ? ` rotate(${((-pose.heading * 180) / Math.PI).toFixed(2)})` : "";
      put(group, "transform", `translate(${x.toFixed(2)} ${y.toFixed(2)})${turn}`);
    }
    const [i, share] = track.between(t);
    const gone = this.length[i] + share * ((this.length[i + 1] ?? this.length[i]) - this.length[i]);
    this.travelled.style.strokeDasharray = `${gone} ${this.length.at(-1) + 1}`;
    const route = this.episode.routes.findLast(([since]) => since <= t + 1e-9);
    put(this.route, "points", this.projection.points(route?.[1] ?? []));
    this.place.show(t);
    this.things.show(t);
    this.showWishes(this.episode.planAt(t));
    this.showGap(t);
    this.showActs(t, track.pose(robot, t));
  }

  /** The rings are as large as what people want by the plan in force. */
  showWishes({ values }) {
    for (const { name, radius, ring, title } of this.wishes) {
      const { value } = values[name].parameters.conversational_distance;
      put(ring, "r", ((radius + value) * SCALE).toFixed(1));
      say(title, `${name} would like ${measured(value, "m")}`);
    }
    const [names, bodies] = [[], new Map(this.wishes.map(({ name, radius }) => [name, this.bodyBox(name, radius)]))];
    for (const { name, radius } of this.wishes) {
      const { value } = values[name].parameters.conversational_distance;
      const others = [...bodies].filter(([other]) => other !== name).map(([, box]) => box);
      this.placeName(name, (radius + value) * SCALE, names, others);
    }
    const everybody = [...this.episode.track.bodies].map(([name, { radius }]) => this.bodyBox(name, radius));
    this.taken = { names, bodies: everybody };
  }

  bodyBox(name, radius) {
    const pose = this.episode.track.pose(name, this.t);
    const [x, y] = this.projection.at(pose.x, pose.y);
    const half = radius * SCALE;
    return { left: x - half, right: x + half, top: y - half, bottom: y + half };
  }

  /**
   * Move a name to where it is on the panel, covers no other name and, if possible, no person; otherwise hide it.
   *
   * @param {string} name of the person
   * @param {number} ring radius of the wanted distance
   * @param {object[]} names boxes of the names before it; its own is added
   * @param {object[]} bodies boxes of the others
   */
  placeName(name, ring, names, bodies) {
    const { text, ...about } = this.names.get(name);
    if (about.half === undefined) return;
    const pose = this.episode.track.pose(name, this.t);
    const [x, y] = this.projection.at(pose.x, pose.y);
    const [px, margin, { width, height }] = [1 / this.perUnit, MARGIN_M * SCALE, this.projection];
    const half = Math.max(width, this.element.clientWidth * px) / 2 - about.half - EDGE_PX * px;
    const inside = Math.max(width / 2 - half, Math.min(x, width / 2 + half));
    const lines = nameLines({ ...about, ring, px }, { over: y - margin, under: height - y - margin });
    const apart = lines
      .map((line) => ({ line, box: nameBox(inside, y + line, about.half, px) }))
      .filter(({ box }) => box.top >= 0 && box.bottom <= height && !names.some((other) => overlap(box, other)));
    const best = apart.find(({ box }) => !bodies.some((other) => overlap(box, other))) ?? apart[0];
    put(text, "visibility", best ? "inherit" : "hidden");
    if (!best) return;
    names.push(best.box);
    put(text, "x", (inside - x).toFixed(1));
    put(text, "y", best.line.toFixed(1));
  }

  /** A line between robot and person as long as their visit lasts. */
  showGap(t) {
    const step = this.episode.stepAt(t);
    put(this.gapGroup, "visibility", step?.person ? "visible" : "hidden");
    if (!step?.person) return;
    const [a, b] = [this.episode.track.pose(step.person, t), this.episode.track.pose(this.episode.robot, t)];
    const angle = Math.atan2(b.y - a.y, b.x - a.x);
    const [x1, y1] = this.projection.at(a.x + a.radius * Math.cos(angle), a.y + a.radius * Math.sin(angle));
    const [x2, y2] = this.projection.at(b.x - b.radius * Math.cos(angle), b.y - b.radius * Math.sin(angle));
    for (const [name, value] of Object.entries({ x1, y1, x2, y2 })) put(this.line, name, value.toFixed(2));
    const words = measured(this.episode.distance(step.person, t), "m", 2);
    this.placeLabel(words, [x1, y1], [x2, y2]);
    say(this.label, words);
  }

  /** Move the label beside the line, to where it covers no name and least of anybody; otherwise hide it. */
  placeLabel(words, from, to) {
    const px = 1 / (this.perUnit ?? 1);
    const places = labelPlaces(from, to, px).map(([x, y]) => ({ x, y, box: labelBox(x, y, words, px) }));
    const best = leastCovering(places, this.taken, this.projection);
    put(this.label, "visibility", best ? "inherit" : "hidden");
    if (!best) return;
    put(this.label, "x", best.x.toFixed(2));
    put(this.label, "y", best.y.toFixed(2));
  }

  showActs(t, pose) {
    const acts = this.episode.actsAt(t);
    this.bubble.tell(acts);
    if (acts.length === 0) return;
    const { clientWidth: wide, clientHeight: high } = this.element;
    const [x, y] = this.projection.at(pose.x, pose.y).map((units) => units * this.perUnit);
    const [across, down] = [this.projection.width, this.height].map((units) => units * this.perUnit);
    const below = this.episode.track.pose(acts[0].person, t).y > pose.y; // where the person does not stand
    this.bubble.place((wide - across) / 2 + x, (high - down) / 2 + y, pose.radius * SCALE * this.perUnit, wide, below);
  }
}
