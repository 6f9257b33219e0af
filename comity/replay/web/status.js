// States: each has a sign beside its colour, so that nobody needs the colour.

export const SIGNS = {
  running: "▶",
  success: "✓",
  failure: "✕",
  halted: "■",
  rebound: "↻",
  replanned: "↺",
  not_replanned: "✕",
  idle: "·",
};

/** What becomes of a plan, as it stands behind "was". */
export const PLANS = {
  rebound: "bound to new numbers",
  replanned: "replanned",
  not_replanned: "not replanned",
};

const HALTS = {
  preempted: "something with precedence took over",
  timed_out: "its time was over",
  achieved_early: "what it worked for had come true",
  parent_ended: "the branch above it had ended",
  emergency: "everything was stopped",
};

/** Whether a node is a question about the world. */
export const asks = (node) => node.kind === "condition";

/** What a node did, in words. */
export function did(event) {
  if (event.status === "halted") return `was stopped: ${HALTS[event.halt] ?? event.halt}`;
  if (event.status === "running") return "began";
  if (event.status in PLANS) return `was ${PLANS[event.status]}`;
  if (asks(event.node)) return event.status === "success" ? "came out true" : "came out false";
  return event.status === "success" ? "succeeded" : "failed";
}

/** The state after an event, in a word or two. */
export function stateWord(event) {
  if (!event) return "not yet asked";
  if (event.status === "running") return "running";
  if (event.status === "halted") return `halted (${event.halt.replaceAll("_", " ")})`;
  if (event.status in PLANS) return PLANS[event.status];
  if (asks(event.node)) return event.status === "success" ? "true" : "false";
  return event.status === "success" ? "succeeded" : "failed";
}

/** The reading behind an event, and the condition that it turned. */
export function reading(event) {
  const near = event.because.filter(({ kind }) => kind === "reading" || kind === "condition");
  return near.map(({ text }) => inWords(text));
}

/** A cause as people say it. */
export const inWords = (text) =>
  text.replace(" -> success", " came out true").replace(" -> failure", " came out false");

