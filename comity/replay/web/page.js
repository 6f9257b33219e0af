// The page: puts the parts together, and gives all of them the one clock.

import { Clock, linkToAddress, timeInAddress } from "./clock.js";
import { el } from "./dom.js";
import { Episode } from "./episode.js";
import { Filter } from "./filter.js";
import { controls, title } from "./header.js";
import { listen } from "./keys.js";
import { Transport } from "./transport.js";
import { View } from "./view.js";

const data = JSON.parse(document.getElementById("data").textContent);
const episodes = data.runs.map((run) => new Episode(run));
const filter = new Filter();
const clock = new Clock(Math.max(...episodes.map(({ end }) => end)));
const seek = (view, t) => { clock.pause(); clock.seek(t); };
const views = episodes.map((episode, i) => new View(episode, i, filter, seek));
const [view] = views;
const transport = new Transport(clock, (direction) => view.why.step(direction));
const { element: tools, search } = controls(episodes[0], filter);

document.title = `${episodes[0].account.scenario} – Comity replay`;
document.getElementById("page").append(
  el("header", { class: "head" }, title(episodes[0]), tools),
  view.plan.element,
  el("main", { class: "single" }, view.worldPanel, view.series.element, view.tree.element, view.why.element),
  transport.element,
);

filter.follow(() => transport.mark(view.why.events.map(({ t, status }) => ({ t, look: status === "halted" ? "halt" : "event" }))));
clock.follow(() => {
  for (const one of views) one.show(clock.t);
  transport.show();
});
listen({
  ArrowLeft: () => view.why.step(-1),
  ArrowRight: () => view.why.step(1),
  ",": () => view.why.step(-1),
  ".": () => view.why.step(1),
  " ": () => clock.toggle(),
  Home: () => seek(view, 0),
  End: () => seek(view, clock.end),
  "/": () => search.focus(),
  h: () => filter.set({ level: filter.level === "halts" ? "deeds" : "halts" }),
  Escape: () => { search.value = ""; search.blur(); filter.set({ text: "", node: null }); },
});
clock.seek(timeInAddress() ?? 0);
linkToAddress(clock);
document.documentElement.dataset.ready = "true";
