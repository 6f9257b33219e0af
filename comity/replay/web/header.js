// The head of the page: what episode it is, how it ended, and what of it is shown.

import { choice, el } from "./dom.js";
import { LEVELS } from "./filter.js";
import { themeChoice } from "./theme.js";
import { plain, seconds } from "./words.js";

/** Title, outcome and facts of a run. */
export function title(episode) {
  const { account } = episode;
  const outcome = account.outcome ?? became(account);
  const profiles = Object.entries(account.profiles).map(
    ([person, profile]) => `${person} as ${plain(profile)}`,
  );
  const carriedOut = account.robot ? `with ${account.robot}` : `seed ${account.seed}`;
  const facts = [seconds(episode.end), plain(account.rulebook), carriedOut, ...profiles];
  return el(
    "div",
    { class: "title" },
    el("h1", {}, account.scenario),
    el("span", { class: "outcome", "data-outcome": outcome }, plain(outcome)),
    el("p", { class: "facts", title: episode.about || facts.join(" · ") }, facts.join(" · ")),
  );
}

/** What became of a run that did not come to its own end. */
function became({ status, error }) {
  if (status === "running") return "unfinished";
  return error === "interrupted" ? error : status;
}

/** A line for every run that did not come to its own end. */
export function notices(episodes) {
  return episodes
    .filter(({ ending }) => ending)
    .map(({ ending, name }) =>
      el("p", { class: "notice", role: "status" }, episodes.length > 1 ? `${name}: ${ending}` : ending),
    );
}

/** Title of two runs. */
export function sidesTitle(episodes) {
  const names = [...new Set(episodes.map(({ account }) => account.scenario))];
  return el(
    "div",
    { class: "title" },
    el("h1", {}, names.join(" and ")),
    el(
      "p",
      { class: "facts" },
      episodes.map(({ name }, i) => [
        i ? " beside " : "",
        el("span", { class: "letter" }, "AB"[i]),
        ` ${name}`,
      ]),
    ),
  );
}

/** Filters and theme, and what else there is to choose. */
export function controls(episodes, filter, others) {
  const names = new Set(episodes.flatMap(({ people }) => people.map(({ name }) => name)));
  const people = [...names].map((name) => [name, name]);
  const search = el("input", {
    type: "search",
    placeholder: "Search nodes  /",
    "aria-label": "Search nodes",
    oninput: () => filter.set({ text: search.value }),
  });
  const level = choice("Events", LEVELS, filter.level, (value) => filter.set({ level: value }));
  filter.follow(() => {
    level.value = filter.level;
  });
  const element = el(
    "div",
    { class: "controls", role: "search" },
    others,
    level,
    people.length > 1 &&
      choice("Person", [["", "Everybody"], ...people], "", (person) => filter.set({ person })),
    search,
    themeChoice(),
  );
  return { element, search };
}
