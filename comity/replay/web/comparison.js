// Two runs compared: where they first part, and what each went by and reached.

import { el, put, say } from "./dom.js";
import { did } from "./status.js";
import { measured, plain, seconds } from "./words.js";

/**
 * @param {function(number, number)} ontime called with a run's place (0 or 1) and a time of it
 */
export function comparison([one, other], parting, filter, ontime) {
  const names = [one.name, other.name];
  const people = [...new Set([one, other].flatMap((run) => run.people.map(({ name }) => name)))];
  let shown = [];
  const bodies = people.map((name) => {
    const rows = el("tbody", {});
    filter.follow(() => {
      rows.hidden = Boolean(filter.person && filter.person !== name);
    });
    return rows;
  });
  /** Compare what both went by at their times: it changes where a plan does. */
  const show = (times) => {
    const plans = [one, other].map((run, i) => run.planAt(times[i]));
    if (plans.every((plan, i) => plan === shown[i])) return;
    shown = plans;
    costs.replaceChildren(
      row(
        "plan costs",
        plans.map(({ cost }) => (cost === null ? "–" : String(cost))),
      ),
    );
    people.forEach((name, i) =>
      bodies[i].replaceChildren(...person(name, [one, other], plans).flat(Infinity).filter(Boolean)),
    );
  };
  const costs = el("tbody", {});
  const element = el(
    "section",
    { class: "panel comparison", "aria-label": "Comparison" },
    el("header", {}, el("h2", {}, "Compared"), larger()),
    el(
      "div",
      { class: "scroll" },
      partings([one, other], parting, ontime),
      el(
        "table",
        {},
        el(
          "thead",
          {},
          el(
            "tr",
            {},
            el("th", {}, ""),
            names.map((name, i) =>
              el(
                "th",
                { scope: "col", class: "numeric" },
                el("span", { class: "letter" }, "AB"[i]),
                ` ${name}`,
              ),
            ),
          ),
        ),
        el("tbody", {}, outcome(one, other)),
        costs,
        bodies,
      ),
    ),
  );
  return { element, show };
}

/** A button that lets the comparison have the whole column, and gives the room back. */
function larger() {
  const button = el("button", { type: "button", class: "link-button larger", "aria-pressed": "false" }, "Larger");
  button.addEventListener("click", () => {
    const on = button.closest(".side").classList.toggle("larger");
    put(button, "aria-pressed", String(on));
    say(button, on ? "Smaller" : "Larger");
  });
  return button;
}

function partings(runs, parting, ontime) {
  if (parting.length === 0)
    return el(
      "p",
      { class: "parting-text" },
      "The two runs did the same at the same times, for the same reasons.",
    );
  return [...parting].reverse().map(({ t, in_behaviour: acted, events, causes }) =>
    el(
      "div",
      { class: "parting-text", "data-parting": acted ? "behaviour" : "reasons" },
      el(
        "p",
        {},
        el("b", {}, acted ? "They do different things" : "The reasons differ"),
        " from ",
        el("button", { type: "button", class: "link-button", onclick: () => ontime(0, t) }, seconds(t)),
        " on",
      ),
      acted &&
        el(
          "ul",
          {},
          events.map((place, i) => deed(runs[i], place, i, ontime)),
        ),
      causes.length > 0 &&
        el(
          "details",
          {},
          el("summary", {}, "What differs behind it"),
          el(
            "table",
            { class: "causes" },
            el(
              "tbody",
              {},
              causes
                .slice(0, 6)
                .map(([kind, mine, theirs]) =>
                  el(
                    "tr",
                    {},
                    el("td", {}, plain(kind)),
                    el("td", {}, mine ?? "–"),
                    el("td", {}, theirs ?? "–"),
                  ),
                ),
            ),
          ),
        ),
    ),
  );
}

function deed(run, place, i, ontime) {
  const event = place === null ? null : run.events[place];
  return el(
    "li",
    {},
    el("span", { class: "letter" }, "AB"[i]),
    event
      ? [
          " ",
          el(
            "button",
            { type: "button", class: "link-button", onclick: () => ontime(i, event.t) },
            event.node.name,
          ),
          ` ${did(event)} at ${seconds(event.t)}`,
        ]
      : " had ended",
  );
}

function outcome(one, other) {
  return [
    group("Run"),
    row(
      "outcome",
      [one, other].map((run) => plain(run.account.outcome ?? run.account.status)),
    ),
    row(
      "takes",
      [one, other].map((run) => seconds(run.end)),
    ),
    row(
      "way",
      [one, other].map((run) => measured(run.account.metrics.path_length_m, "m", 2)),
    ),
    row(
      "nearest to anybody",
      [one, other].map((run) => measured(run.account.metrics.min_clearance_m, "m")),
    ),
  ];
}

function person(name, runs, plans) {
  const profiles = runs.map((run) => plain(run.account.profiles[name] ?? "–"));
  const values = plans.map((plan) => plan.values[name]?.parameters ?? {});
  const visits = runs.map((run) => run.account.visits.find((visit) => visit.person === name));
  const parameters = [...new Set(values.flatMap(Object.keys))];
  const reached = (key, unit) => visits.map((visit) => measured(visit?.[key], unit));
  return [
    group(name),
    row("profile", profiles),
    parameters.map((parameter) =>
      row(
        plain(parameter),
        values.map((all) => measured(all[parameter]?.value, all[parameter]?.unit)),
      ),
    ),
    visits.some(Boolean) && [
      row(
        "visit",
        visits.map((visit) => plain(visit?.outcome ?? "–")),
      ),
      row("stops at", reached("distance_actual_m", "m")),
      row("at bearing", reached("bearing_actual_deg", "deg")),
      row("approached at", reached("approach_speed_actual_m_s", "m/s")),
      row("docked after", reached("docked_at_s", "s")),
      visits.some((visit) => visit?.late_s > 0) && row("late by", reached("late_s", "s")),
      row(
        "greets with",
        visits.map((visit) => visit?.greeting.map(plain).join(" + ") || "–"),
      ),
    ],
  ];
}

const group = (name) => el("tr", { class: "group" }, el("th", { colspan: 3, scope: "rowgroup" }, name));

function row(name, [mine, theirs]) {
  const differs = mine !== theirs;
  return el(
    "tr",
    { class: differs ? "differs" : null },
    el("th", { scope: "row" }, name, differs && el("span", { class: "sign", title: "they differ" }, " ≠")),
    el("td", { class: "numeric" }, mine),
    el("td", { class: "numeric" }, theirs),
  );
}
