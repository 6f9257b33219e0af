// Play, speed, scrub, and stepping from event to event.

import { choice, el, put, say, svg } from "./dom.js";
import { seconds } from "./words.js";

const SPEEDS = [0.25, 0.5, 1, 2, 4, 8];

export class Transport {
  /** @param {function(number)} onstep called with -1 or 1: to the event before, or the next */
  constructor(clock, onstep) {
    this.clock = clock;
    const button = (look, label, text, act) =>
      el("button", { type: "button", class: look, "aria-label": label, title: label, onclick: act }, text);
    this.play = button("play", "Play", "▶", () => clock.toggle());
    this.scrubber = el("input", {
      type: "range",
      min: 0,
      max: clock.end,
      step: 0.01,
      value: 0,
      class: "scrubber",
      "aria-label": "Time",
      oninput: () => {
        clock.pause();
        clock.seek(Number(this.scrubber.value));
      },
    });
    this.time = el("output", { class: "moment" });
    this.speed = choice(
      "Speed",
      SPEEDS.map((one) => [String(one), `${one}×`]),
      "1",
      (value) => {
        clock.speed = Number(value);
      },
    );
    this.marks = svg("svg", {
      class: "marks",
      viewBox: "0 0 1000 10",
      preserveAspectRatio: "none",
      "aria-hidden": "true",
    });
    this.element = el(
      "footer",
      { class: "transport" },
      button("step", "Event before (left arrow)", "|◂", () => onstep(-1)),
      this.play,
      button("step", "Next event (right arrow)", "▸|", () => onstep(1)),
      el("div", { class: "rail" }, this.marks, this.scrubber),
      this.time,
      this.speed,
    );
  }

  /** Mark moments on the rail: what each is like, and when. */
  mark(moments) {
    const x = (t) => (this.clock.end > 0 ? ((1000 * t) / this.clock.end).toFixed(2) : 0);
    this.marks.replaceChildren(
      ...moments.map(({ t, look }) => svg("line", { class: look, x1: x(t), x2: x(t), y1: 0, y2: 10 })),
    );
  }

  show() {
    const { t, end, playing } = this.clock;
    put(this.scrubber, "max", end);
    this.scrubber.value = t;
    put(this.scrubber, "aria-valuetext", seconds(t));
    say(this.time, `${t.toFixed(2)} / ${seconds(end)}`);
    say(this.play, playing ? "❚❚" : "▶");
    put(this.play, "aria-label", playing ? "Pause" : "Play");
    put(this.play, "title", playing ? "Pause (space)" : "Play (space)");
  }
}
