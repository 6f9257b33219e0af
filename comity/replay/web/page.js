// The page: puts the parts together, and gives all of them the one clock.

import { Clock, linkToAddress, timeInAddress } from "./clock.js";
import { el } from "./dom.js";
import { Episode, alike } from "./episode.js";
import { Filter } from "./filter.js";
import { controls, notices } from "./header.js";
import { help } from "./help.js";
import { listen } from "./keys.js";
import { parsed } from "./names.js";
import { SideBySide } from "./side.js";
import { Single } from "./single.js";
import { PLANS } from "./status.js";
import { Transport } from "./transport.js";

const data = parsed(document.getElementById("data").textContent);
const episodes = data.runs.map((run) => new Episode(run));
alike(episodes);
const filter = new Filter();
const clock = new Clock(0);
const stage =
  episodes.length > 1
    ? new SideBySide(episodes, data.parting, filter, clock)
    : new Single(episodes, filter, clock);
clock.end = stage.end;
const step = (direction) => stage.focus.why.step(direction);
const transport = new Transport(clock, step);
const { element: tools, search } = controls(episodes, filter, stage.controls);
const keys = help();

document.title = `${episodes[0].account.scenario} – Comity replay`;
document
  .getElementById("page")
  .append(
    el("header", { class: "head" }, stage.title, tools, keys.element),
    ...notices(episodes),
    ...stage.parts,
    transport.element,
  );

filter.follow(() => {
  const events = stage.focus.why.events.map(({ t, status }) => ({
    t: stage.onClock(t),
    look: status === "halted" ? "halt" : status in PLANS ? "revision" : "event",
  }));
  const disturbances = stage.focus.episode.account.disturbances.map(({ t }) => ({
    t: stage.onClock(t),
    look: "disturbance",
  }));
  transport.mark([...events, ...disturbances, ...stage.partings().map((t) => ({ t, look: "parting" }))]);
});
clock.follow(() => {
  stage.show(clock.t);
  transport.show();
});
listen({
  ArrowLeft: () => step(-1),
  ArrowRight: () => step(1),
  "Shift+ArrowLeft": () => stage.focus.visitPlan(-1),
  "Shift+ArrowRight": () => stage.focus.visitPlan(1),
  ",": () => step(-1),
  ".": () => step(1),
  " ": () => clock.toggle(),
  Home: () => clock.visit(0),
  End: () => clock.visit(clock.end),
  "/": () => search.focus(),
  "?": () => keys.open(),
  h: () => filter.set({ level: filter.level === "halts" ? "deeds" : "halts" }),
  Escape: () => {
    search.value = "";
    search.blur();
    filter.set({ text: "", node: null });
  },
});
clock.seek(timeInAddress() ?? 0);
linkToAddress(clock);
document.documentElement.dataset.ready = "true";
