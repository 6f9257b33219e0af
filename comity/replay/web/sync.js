// Two runs on one clock: at the same time, or at the same place of the plan.

/** Functions from the time of the first run to that of the second one and back, by time: they are the same. */
export const BY_TIME = { there: (t) => t, back: (t) => t };

/** The same by plan step: a step that both runs did begins, goes on and ends together. */
export function byStep(one, other) {
  const knots = [[0, 0]];
  for (const step of one.steps) {
    const same = other.steps.find((each) => each.action === step.action && each.person === step.person);
    if (!same || step.start === null || same.start === null) continue;
    for (const knot of [
      [step.start, same.start],
      [step.end, same.end],
    ]) {
      const [t, u] = knots.at(-1);
      if (knot[0] > t && knot[1] > u) knots.push(knot); // another order of visits cannot be told on one clock
    }
  }
  const [t, u] = knots.at(-1);
  if (one.end > t && other.end > u) knots.push([one.end, other.end]);
  return { there: (time) => along(knots, time, 0, 1), back: (time) => along(knots, time, 1, 0) };
}

function along(knots, time, from, to) {
  const after = knots.findIndex((knot) => knot[from] >= time);
  if (after < 0) return knots.at(-1)[to];
  if (after === 0) return knots[0][to];
  const [a, b] = [knots[after - 1], knots[after]];
  return a[to] + ((time - a[from]) / (b[from] - a[from])) * (b[to] - a[to]);
}
