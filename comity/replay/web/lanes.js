// Lanes: what one node did over time, as bars; a bar is high while the node runs, and low while a result stands.

import { svg } from "./dom.js";
import { seconds } from "./words.js";
import { stateWord } from "./status.js";

const WIDE = 1000;

/** The lane of one node in a run that ends at `end`, on an axis of `span` seconds. */
export function lane(node, end, span) {
  const x = (t) => (span > 0 ? (t / span) * WIDE : 0);
  const high = node.children.length > 0 ? 5 : 9;
  const bars = node.events.map((event, i) => {
    const until = node.events[i + 1]?.t ?? end;
    const running = event.status === "running";
    return svg(
      "rect",
      {
        class: "bar",
        "data-status": event.status,
        x: x(event.t).toFixed(2),
        width: Math.max(x(until) - x(event.t), running ? 2 : 1).toFixed(2),
        y: running ? 8 - high / 2 : 7,
        height: running ? high : 2,
      },
      svg("title", {}, `${stateWord(event)} from ${seconds(event.t)}`),
    );
  });
  const marks = node.events
    .filter((event) => event.status !== "running")
    .map((event) =>
      svg("line", {
        class: "mark",
        "data-status": event.status,
        x1: x(event.t).toFixed(2),
        x2: x(event.t).toFixed(2),
        y1: 3,
        y2: 13,
      }),
    );
  return svg(
    "svg",
    { class: "lane", viewBox: `0 0 ${WIDE} 16`, preserveAspectRatio: "none", "aria-hidden": "true" },
    bars,
    marks,
  );
}
