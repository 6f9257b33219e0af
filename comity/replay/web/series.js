// Series: how far the robot was from each person, against what the person likes, and how fast it went.

import { el, say, svg } from "./dom.js";
import { Follower } from "./follow.js";
import { lookOf, withClass } from "./look.js";
import { measured } from "./words.js";

const WIDE = 1000;
const HIGH = 100;
const AIR = 1.12; // of the largest number: the curve does not touch the ceiling
const NEAR = 2.2; // of the band: farther distances are above the chart, so that what people like can be seen

export class Series {
  constructor(episode, id, filter, ontime) {
    Object.assign(this, { episode, id, ontime });
    this.charts = [this.speed(), ...episode.people.map((person, i) => this.distance(person, i))];
    this.cursor = el("div", { class: "cursor" });
    this.plots = el(
      "div",
      { class: "plots" },
      this.charts.map((chart) => chart.element),
    );
    this.element = el(
      "section",
      { class: "panel series", "aria-label": "Distances and speed over time" },
      el(
        "header",
        {},
        el("h2", {}, "Distance and speed"),
        el("span", { class: "count" }, "shade: how suitable; dashed: wanted"),
      ),
      (this.scroll = el("div", { class: "scroll" }, this.plots)),
    );
    this.follower = new Follower(this.scroll, () => this.charts[0].element.offsetHeight);
    filter.follow(() => this.narrow(filter));
  }

  /** With a filter only the distance to that person, and the speed. */
  narrow({ person }) {
    for (const chart of this.charts)
      chart.element.hidden = Boolean(person && chart.person && chart.person !== person);
  }

  distance(person, i) {
    const { track, robot } = this.episode;
    const [a, b] = [track.bodies.get(robot), track.bodies.get(person.name)];
    const values = Array.from(
      track.t,
      (_, k) => Math.hypot(a.x[k] - b.x[k], a.y[k] - b.y[k]) - a.radius - b.radius,
    );
    const top = person.farthest * NEAR;
    const y = (d) => HIGH - (Math.max(d, 0) / top) * HIGH;
    const under = this.spells(person.name).map((spell, k) => [
      this.suitability(spell, top, `${i}-${k}`),
      person.visited && band(spell, y),
      wanted(spell, y),
    ]);
    return this.chart({
      person: person.name,
      look: lookOf(person),
      name: person.name,
      unit: "m",
      top,
      values,
      under,
      noted: (t) =>
        `wants ${measured(wantedOf(this.episode.planAt(t).values[person.name]), "m", 2)}${this.approach(person.name)}`,
      now: (t) => this.episode.distance(person.name, t),
    });
  }

  /** The approach speed of a visit, with its target. */
  approach(person) {
    const visit = this.episode.visitTo(person);
    if (visit?.approach_speed_actual_m_s == null) return "";
    const [target, actual] = [visit.approach_speed_target_m_s, visit.approach_speed_actual_m_s];
    return `, approached at ${measured(actual, "m/s", 2)} (target ${measured(target, "m/s", 2)})`;
  }

  /** What a person wants, and from where to where on the axis of time it holds. */
  spells(person) {
    const x = (t) => (this.episode.span > 0 ? (t / this.episode.span) * WIDE : 0);
    const spells = [];
    for (const { t, values } of this.episode.plans) {
      const last = spells.at(-1);
      if (last?.values === values[person]) continue;
      if (last) last.until = x(t);
      spells.push({ values: values[person], from: x(t), until: WIDE });
    }
    return spells;
  }

  /** The desirability of each distance, as a shade over the whole height of the chart. */
  suitability({ values, from, until }, top, name) {
    const value = values.parameters.conversational_distance;
    if (!value?.curve) return null;
    const id = `suitable-${this.id}-${name}`;
    const inside = value.curve.filter(([x]) => x <= top);
    const stops = inside.map(([x, degree]) =>
      svg("stop", { offset: x / top, class: "suitable", "stop-opacity": (0.42 * degree).toFixed(3) }),
    );
    const [low, high] = [value.curve[0][0] / top, Math.min(value.curve.at(-1)[0] / top, 1)];
    const gradient = svg(
      "linearGradient",
      { id, x1: 0, x2: 0, y1: HIGH, y2: 0, gradientUnits: "userSpaceOnUse" },
      stops,
    );
    const rect = svg("rect", {
      x: from,
      width: until - from,
      y: HIGH * (1 - high),
      height: HIGH * (high - low),
      fill: `url(#${id})`,
    });
    return [svg("defs", {}, gradient), rect];
  }

  speed() {
    const values = this.episode.track.speeds(this.episode.robot);
    const top = Math.max(...values, 0.1) * AIR;
    const { track, robot } = this.episode;
    return this.chart({
      look: { class: "speed" },
      name: "speed",
      unit: "m/s",
      top,
      values,
      under: [],
      noted: () => this.episode.robot,
      now: (t) => values[Math.min(track.between(t)[0] + 1, values.length - 1)],
    });
  }

  chart({ name, person, unit, top, values, under, noted, now, look }) {
    const { t } = this.episode.track;
    const x = (at) => (this.episode.span > 0 ? (at / this.episode.span) * WIDE : 0);
    const points = values
      .map((value, k) => `${x(t[k]).toFixed(1)},${(HIGH - (Math.max(value, 0) / top) * HIGH).toFixed(1)}`)
      .join(" ");
    const number = el("b", { class: "number" });
    const note = el("span", { class: "note" });
    const cursor = el("div", { class: "cursor" });
    const plot = el(
      "div",
      { class: "plot", onclick: (event) => this.clicked(event, plot) },
      svg(
        "svg",
        { viewBox: `0 0 ${WIDE} ${HIGH}`, preserveAspectRatio: "none", "aria-hidden": "true" },
        under,
        svg("polyline", { class: "curve", points }),
      ),
      el("span", { class: "ceiling" }, ceiling(values, top, unit)),
      cursor,
    );
    const element = el(
      "div",
      withClass("chart", look),
      el(
        "div",
        { class: "legend" },
        el("span", { class: "name", title: name }, name),
        number,
        note,
      ),
      plot,
    );
    return { element, person, number, note, noted, cursor, now, unit };
  }

  /** The chart of somebody, if it is shown. */
  chartOf(person) {
    const element = this.charts.find((chart) => person && chart.person === person)?.element;
    return element?.hidden ? null : element;
  }

  clicked(event, plot) {
    const box = plot.getBoundingClientRect();
    this.ontime(((event.clientX - box.left) / box.width) * this.episode.span);
  }

  show(t) {
    const share = `${this.episode.span > 0 ? (100 * t) / this.episode.span : 0}%`;
    for (const { number, note, noted, cursor, now, unit } of this.charts) {
      cursor.style.left = share;
      say(note, noted(t));
      say(number, measured(now(t), unit, 2));
    }
    this.follower.follow(this.chartOf(this.episode.stepAt(t)?.person));
  }
}

const wantedOf = ({ parameters }) => parameters.conversational_distance.value;

/** Within which distances a greeting goes on, as long as somebody wants the same. */
function band({ values, from, until }, y) {
  const [near, far] = values.band;
  const words = `A greeting goes on while the distance stays from ${measured(near, "m", 2)} to ${measured(far, "m", 2)}`;
  return svg(
    "rect",
    { class: "band", x: from, width: until - from, y: y(far), height: y(near) - y(far) },
    svg("title", {}, words),
  );
}

function wanted({ values, from, until }, y) {
  const high = y(wantedOf(values));
  return svg("line", { class: "wanted", x1: from, x2: until, y1: high, y2: high });
}

/** What the top of a chart stands for, and whether the curve goes on above it. */
function ceiling(values, top, unit) {
  const most = Math.max(...values);
  const here = measured(top, unit, 1);
  return most > top ? `${here} ↑ up to ${measured(most, unit, 1)}` : here;
}
