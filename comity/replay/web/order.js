// Order in time: what has happened by a moment.

export const INSTANT = 1e-6; // as in the trace: an event at t has happened when somebody asks about t

/** How many events of a list in order have happened at a time. */
export function countUntil(events, t) {
  let low = 0;
  let high = events.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (events[middle].t <= t + INSTANT) low = middle + 1;
    else high = middle;
  }
  return low;
}
