// Fuzzy sets, drawn: terms, each fired one cut at its rule's strength, their union, and where the value stands.

import { el, svg } from "./dom.js";
import { fact, measured, plain } from "./words.js";

const WIDE = 320;
const HIGH = 84;
const FLOOR = HIGH + 14;
const CEILING = 16;
const NEAR = 72;
const BESIDE = 48;

/** The colour of a rule: by its place among those that fired. */
export const colourOf = (fired, number) =>
  `rule-${
    Math.max(
      fired.findIndex(([one]) => one === number),
      0,
    ) % 6
  }`;

/** The output set of a number: what every rule that fired gave, and the union of it all. */
export function outputSet(parameter, name, value, rules) {
  const [low, high] = reach(parameter, value);
  const plot = frame(
    low,
    high,
    parameter.unit,
    `${plain(name)}: output set with the value ${measured(value.value, value.unit)}`,
  );
  for (const [term, outline] of Object.entries(parameter.terms)) {
    plot.add(
      svg("polyline", { class: "term", points: plot.points(outline) }),
      plot.name(term, peak(outline)),
    );
  }
  for (const [number, strength] of [...value.fired].reverse()) {
    for (const [about, term] of rules[number]?.gives ?? []) {
      if (about !== name || !parameter.terms[term]) continue;
      const outline = cut(parameter.terms[term], strength);
      plot.add(
        svg(
          "polygon",
          { class: `fired ${colourOf(value.fired, number)}`, points: plot.area(outline) },
          svg("title", {}, `rule ${number} gives ${plain(term)}, cut at ${strength.toFixed(2)}`),
        ),
      );
    }
  }
  if (value.curve) plot.add(svg("polyline", { class: "union", points: plot.points(value.curve) }));
  plot.add(plot.mark(value.value, measured(value.value, value.unit)));
  return plot.element;
}

/** How suitable each word is, as bars. */
export function suitability(value, rules, name) {
  const rows = Object.entries(value.desirability ?? {}).filter(
    ([word, degree]) => degree > 0 || word === value.value,
  );
  return el(
    "div",
    { class: "bars" },
    rows.map(([word, degree]) => {
      const rule = value.fired.find(([number]) =>
        rules[number]?.gives.some(([about, term]) => about === name && term === word),
      );
      const bar = el("span", { class: `fill ${rule ? colourOf(value.fired, rule[0]) : "rule-none"}` });
      bar.style.width = `${100 * degree}%`;
      return el(
        "div",
        { class: word === value.value ? "bar-row chosen" : "bar-row" },
        el("span", { class: "word" }, plain(word)),
        el("span", { class: "well" }, bar),
        el("span", { class: "degree" }, degree.toFixed(2)),
      );
    }),
  );
}

/** The terms of a variable, with what was known of it and how far each term holds there. */
export function termsOf(variable, name, known) {
  if (!variable.terms) return null;
  const [low, high] = variable.domain;
  const plot = frame(
    low,
    high,
    variable.unit,
    `${plain(name)}: membership functions, ${fact(known, variable.unit)}`,
  );
  Object.entries(variable.terms).forEach(([term, outline], i) => {
    plot.add(
      svg("polyline", { class: `input input-${i % 4}`, points: plot.points(outline) }),
      plot.name(term, peak(outline)),
    );
    if (typeof known !== "number") return;
    const degree = height(outline, known);
    plot.add(plot.dot(known, degree, `${plain(term)} holds to ${degree.toFixed(2)}`));
  });
  if (typeof known === "number") plot.add(plot.mark(known, fact(known, variable.unit)));
  if (Array.isArray(known)) plot.add(plot.span(known));
  return plot.element;
}

/** How far a term holds at a number. */
export function height(outline, x) {
  const after = outline.findIndex(([place]) => place >= x);
  if (after < 0) return outline.at(-1)[1];
  if (after === 0) return outline[0][1];
  const [[x1, y1], [x2, y2]] = [outline[after - 1], outline[after]];
  return x2 > x1 ? y1 + ((x - x1) / (x2 - x1)) * (y2 - y1) : Math.max(y1, y2);
}

/** An outline cut at a height; where a line crosses the cut there is a corner. */
export function cut(outline, strength) {
  const corners = [];
  outline.forEach(([x, y], i) => {
    const [before, high] = outline[i - 1] ?? [x, y];
    if ((high - strength) * (y - strength) < 0)
      corners.push([before + ((strength - high) / (y - high)) * (x - before), strength]);
    corners.push([x, Math.min(y, strength)]);
  });
  return corners;
}

function reach({ domain }, { value, curve }) {
  const xs = [...domain, value, ...(curve ?? []).map(([x]) => x)];
  return [Math.min(...xs), Math.max(...xs)];
}

function peak(outline) {
  const top = Math.max(...outline.map(([, y]) => y));
  const flat = outline.filter(([, y]) => y >= 0.999 * top).map(([x]) => x);
  return (flat[0] + flat.at(-1)) / 2;
}

function frame(low, high, unit, title) {
  const px = (x) => 8 + ((x - low) / (high - low)) * (WIDE - 16);
  const py = (y) => FLOOR - y * (FLOOR - CEILING);
  const anchor = (x) => (px(x) < 30 ? "start" : px(x) > WIDE - 30 ? "end" : "middle");
  const points = (outline) => outline.map(([x, y]) => `${px(x).toFixed(1)},${py(y).toFixed(1)}`).join(" ");
  const text = (x, y, words, look, at = anchor(x)) =>
    svg("text", { class: look, x: px(x).toFixed(1), y, "text-anchor": at }, words);
  const element = svg(
    "svg",
    { class: "sets", viewBox: `0 0 ${WIDE} ${FLOOR + 16}`, role: "img", "aria-label": title },
    svg("line", { class: "axis", x1: 8, x2: WIDE - 8, y1: FLOOR, y2: FLOOR }),
    text(low, FLOOR + 13, fact(short(low)), "tick", "start"),
    text(high, FLOOR + 13, fact(short(high), unit), "tick", "end"),
  );
  const names = [];
  return {
    element,
    points,
    add: (...parts) => element.append(...parts),
    area: (outline) => `${px(outline[0][0])},${FLOOR} ${points(outline)} ${px(outline.at(-1)[0])},${FLOOR}`,
    name: (term, x) => {
      const free = names.every((other) => Math.abs(px(x) - other) > BESIDE); // names never overlap
      if (free) names.push(px(x));
      return free ? text(x, CEILING - 5, plain(term), "term-name") : "";
    },
    dot: (x, y, words) =>
      svg("circle", { class: "dot", cx: px(x), cy: py(y), r: 3.5 }, svg("title", {}, words)),
    span: ([a, b]) =>
      svg("rect", { class: "known", x: px(a), width: px(b) - px(a), y: CEILING, height: FLOOR - CEILING }),
    mark: (x, words) => {
      const ticks = element.querySelectorAll(".tick"); // an end gives way to a value beside it
      ticks[0].toggleAttribute("hidden", px(x) < NEAR);
      ticks[1].toggleAttribute("hidden", px(x) > WIDE - NEAR);
      return svg(
        "g",
        { class: "value" },
        svg("line", { x1: px(x), x2: px(x), y1: CEILING, y2: FLOOR }),
        text(x, FLOOR + 13, words, "value-text"),
      );
    },
  };
}

const short = (x) => Math.round(x * 100) / 100;
