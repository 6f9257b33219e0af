// The chain behind a result: from what was read over the plan and the value to the rules and what they rest on.

import { el } from "./dom.js";
import { colourOf, outputSet, suitability, termsOf } from "./sets.js";
import { inWords } from "./status.js";
import { fact, measured, plain } from "./words.js";

/** The links of a chain of causes, nearest first; a value can be opened down to its sources. */
export function chain(episode, event) {
  const { person } = event.node;
  const plan = episode.planOf(event);
  const links = event.because.filter(({ kind }) => kind !== "rule" && kind !== "variable");
  return el(
    "ol",
    { class: "chain" },
    links.map((cause) => link(episode, plan, person, cause)),
    plan.event === event && plan.changed.map((change) => changed(episode, plan, change)),
  );
}

/** A value that a revision of the plan brought, down to its rules. */
function changed(episode, plan, { person, name, value, before }) {
  const was = before && el("p", { class: "faint" }, `${person}: before it was ${told(before)}`);
  return el(
    "li",
    { class: "link parameter" },
    el("span", { class: "tag" }, "new value"),
    el("div", {}, parameter(episode, plan, person, name, value), was),
  );
}

const told = ({ value, unit, origin }) => `${measured(value, unit)} from ${origin}`;

function link(episode, plan, person, cause) {
  const text = inWords(cause.text);
  const line = (rest) =>
    el("li", { class: `link ${cause.kind}` }, el("span", { class: "tag" }, plain(cause.kind)), rest);
  if (cause.kind === "step") return line(step(plan, text));
  const name = cause.kind === "parameter" ? cause.text.split(" ")[0] : null;
  const value = plan.values[person]?.parameters[name];
  return line(value ? parameter(episode, plan, person, name, value) : el("span", {}, text));
}

function step(plan, text) {
  const found = plan.steps.find((one) => `${one.action}(${one.arguments.join(", ")})` === text);
  if (!found) return el("span", {}, text);
  const others = found.why.alternatives.slice(0, 4).map((other) => {
    const words = other.arguments
      .filter((one) => !found.arguments.slice(0, 2).includes(one))
      .map(plain)
      .join(", ");
    return el("li", {}, `${words}: ${(other.extra_cost / 100).toFixed(2)} m of way more`);
  });
  return el(
    "details",
    {},
    el("summary", {}, text),
    el("p", {}, found.why.text),
    others.length > 0 && el("p", { class: "faint" }, "What else was possible, with the rest of the plan as it is"),
    el("ul", {}, others),
  );
}

function parameter(episode, plan, person, name, value) {
  const { parameters, rules } = episode.values;
  const about = parameters[name];
  const numeric = typeof value.value === "number";
  return el(
    "details",
    { class: "parameter", open: true },
    el(
      "summary",
      {},
      el("b", {}, `${plain(name)} ${measured(value.value, value.unit)}`),
      ` from ${value.origin}`,
      value.outvoted && `; ${value.outvoted}`,
    ),
    numeric && about?.domain ? outputSet(about, name, value, rules) : suitability(value, rules, name),
    contributions(value),
    value.note && el("p", { class: "faint" }, plain(value.note)),
    value.fired.length > 0 &&
      el(
        "ul",
        { class: "rules" },
        value.fired.map((firing) => rule(episode, plan, person, value, firing)),
      ),
    value.moved.length > 0 && el("p", { class: "faint" }, "Moved by the situation"),
    value.moved.length > 0 &&
      el(
        "ul",
        { class: "rules" },
        value.moved.map((firing) => rule(episode, plan, person, value, firing)),
      ),
  );
}

function contributions(value) {
  const numeric = typeof value.value === "number";
  const spread =
    numeric && value.spread > 0 ? `; people vary by ± ${measured(value.spread, value.unit, 2)}` : "";
  const parts = value.contributions.map((one, i) => {
    const sign = i > 0 && typeof one.value === "number" && one.value > 0 ? "+" : "";
    return el(
      "li",
      {},
      el("b", {}, `${sign}${measured(one.value, value.unit)}`),
      ` ${one.origin}: ${plain(one.text)}`,
    );
  });
  const cultures = value.parts.map((part) =>
    el(
      "li",
      {},
      `${part.name} (${Math.round(100 * part.share)} %) alone: ${measured(part.value, value.unit)}`,
    ),
  );
  return el(
    "ul",
    { class: "contributions" },
    parts,
    cultures,
    spread && el("li", { class: "faint" }, spread.slice(2)),
  );
}

function rule(episode, plan, person, value, [number, strength]) {
  const one = episode.values.rules[number];
  const inputs = one.reads.filter((name) => episode.values.variables[name]);
  return el(
    "li",
    { class: "rule" },
    el(
      "details",
      {},
      el(
        "summary",
        {},
        el("span", { class: `swatch ${colourOf(value.fired, number)}`, "aria-hidden": "true" }),
        el("span", { class: "rule-text" }, `${number}. ${plain(one.text)}`),
        el("span", { class: "strength" }, strength.toFixed(2)),
      ),
      el(
        "dl",
        {},
        el("dt", {}, "evidence"),
        el("dd", {}, one.evidence),
        el("dt", {}, "source"),
        el("dd", {}, one.source),
        one.against && [el("dt", {}, "against it"), el("dd", {}, one.against)],
        one.note && [el("dt", {}, "note"), el("dd", {}, one.note)],
      ),
      inputs.map((name) => variable(episode, plan, person, name)),
    ),
  );
}

function variable(episode, plan, person, name) {
  const about = episode.values.variables[name];
  const known = plan.values[person]?.inputs[name];
  return el(
    "div",
    { class: "variable" },
    el(
      "p",
      {},
      el("span", { class: "tag" }, about.kind),
      el("b", {}, plain(name)),
      ` ${fact(known, about.unit)}`,
      el("span", { class: "faint" }, ` · ${about.level}`),
    ),
    termsOf(about, name, known),
    known === null && el("p", { class: "faint" }, "Not disclosed: every term holds to degree 1."),
    about.reason && el("p", { class: "faint" }, about.reason),
  );
}
