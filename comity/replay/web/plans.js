// The plan in force at each time: the first one, and what took over from it, each with its steps and values.

import { together } from "./names.js";
import { countUntil } from "./order.js";

const TAKES_OVER = ["rebound", "replanned"];
const REVISES = [...TAKES_OVER, "not_replanned"];

/** Whether an event is about the plan itself. */
export const revises = (event) => REVISES.includes(event.status);

/**
 * The plans of a run, in order; the first holds from the start.
 *
 * Each has `t`, `kind`, `because`, `steps`, `values` by person, `changed` (values that are others than before),
 * `unserved`, and the `event` of the trace in which it took over.
 */
export function plansOf({ plans, values, nodes, events }) {
  const revisions = events.filter(revises);
  const rounds = [];
  for (const node of nodes) {
    if (node.parent === null) rounds.push([]);
    rounds.at(-1).push(node);
  }
  const all = [];
  let round = 0;
  for (const [index, plan] of plans.entries()) {
    const before = all.at(-1);
    if (plan.kind === "replanned") round = Math.min(round + 1, rounds.length - 1);
    const people = together(before?.values, values.people[index]);
    const took = { ...plan, index, event: revisions[index - 1] ?? null, values: people };
    took.changed = before ? changes(before.values, values.people[index]) : [];
    if (index > 0 && (plan.cost === null || plan.kind === "not_replanned")) took.steps = before.steps;
    else took.steps = following(before, placed(plan.steps, rounds[round] ?? []), took);
    if (plan.kind === "not_replanned") took.unserved = before.unserved;
    all.push(took);
  }
  return all;
}

/** The plan in force at a time. */
export const planAt = (plans, t) => plans[Math.max(countUntil(plans, t) - 1, 0)];

/** The plan in force when an event came about. */
export const planOf = (plans, event) =>
  plans.findLast(({ event: took, t }) => (took ? took.index <= event.index : t <= event.t)) ?? plans[0];

/** Steps of earlier plans that were begun for people of whom this plan says nothing more, and then its own. */
function following(before, own, plan) {
  if (!before) return own;
  const left = new Set(own.map(({ person }) => person));
  const begun = before.steps.filter(
    (step) => !left.has(step.person) && step.start !== null && step.start < plan.t,
  );
  const was = (step) => before.steps.find((one) => one.action === step.action && one.person === step.person);
  return [...begun, ...own.map((step) => ({ ...step, was: differing(was(step), step) }))];
}

/** What a step was before, if it was otherwise; undefined where nothing changed, null where there was none. */
function differing(before, now) {
  if (!before) return null;
  const same = (one) => JSON.stringify([one.arguments, one.parameters]);
  return same(before) === same(now) ? undefined : before;
}

/** Steps with the nodes that carry them out, and when these were at work. */
function placed(steps, nodes) {
  const whose = (step) => `${step.action} ${step.arguments[1]}`;
  return steps.map((step, i) => {
    const person = step.arguments[1] ?? null;
    const all = nodes.filter((node) => node.person === person && node.action === step.action);
    const alike = steps.filter((one) => whose(one) === whose(step));
    const nth = steps.slice(0, i).filter((one) => whose(one) === whose(step)).length;
    const mine = alike.length > 1 && alike.length === all.length ? [all[nth]] : all;
    const worked = mine.find(({ events }) => events.length > 0);
    return {
      ...step,
      person,
      nodes: mine,
      start: worked?.events[0].t ?? null,
      end: worked?.events.at(-1).t ?? null,
    };
  });
}

function changes(before, after) {
  return Object.entries(after).flatMap(([person, { parameters }]) =>
    Object.entries(parameters)
      .filter(([name, { value }]) => value !== before[person]?.parameters[name]?.value)
      .map(([name, value]) => ({ person, name, value, before: before[person]?.parameters[name] ?? null })),
  );
}
