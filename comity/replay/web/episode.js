// One run as it was recorded: who was where, what every node did, and what was said.

import { INSTANT, countUntil } from "./order.js";
import { planAt, planOf, plansOf } from "./plans.js";
import { Track } from "./track.js";

export class Episode {
  constructor(data) {
    Object.assign(this, data);
    this.nodes = data.tree.nodes.map(([name, kind, parent, action, person], path) => ({
      path,
      name,
      kind,
      parent,
      action,
      person,
      children: [],
      events: [],
      depth: 0,
    }));
    for (const node of this.nodes) {
      if (node.parent === null) continue;
      this.nodes[node.parent].children.push(node);
      node.depth = this.nodes[node.parent].depth + 1;
    }
    const causes = data.tree.causes.map(([kind, text, value]) => ({ kind, text, value }));
    this.events = data.tree.events.map(([t, path, status, halt, because, grounds], index) => ({
      index,
      t,
      status,
      halt,
      grounds,
      node: this.nodes[path],
      because: because.map((i) => causes[i]),
    }));
    for (const event of this.events) event.node.events.push(event);
    this.track = new Track(data.tracks);
    this.visits = data.account.visits;
    this.acts = this.visits.flatMap((visit) =>
      visit.acts.map((act) => ({ ...act, person: visit.person })),
    );
    this.plans = plansOf(this);
    this.steps = this.plans.at(-1).steps;
  }

  /** What came of the visit to a person; undefined where none was planned. */
  visitTo(person) {
    return this.visits.find((visit) => visit.person === person);
  }

  /** The plan in force at a time, with its steps and everybody's values. */
  planAt(t) {
    return planAt(this.plans, t);
  }

  /** The plan in force when an event came about. */
  planOf(event) {
    return planOf(this.plans, event);
  }

  /** The last event of a node up to a time; null where it did nothing yet. */
  stateOf(node, t) {
    const place = countUntil(node.events, t) - 1;
    return place < 0 ? null : node.events[place];
  }

  /** The last event of all up to a time. */
  lastEvent(t) {
    return this.events[countUntil(this.events, t) - 1] ?? null;
  }

  /** What is said and done to people at a time. */
  actsAt(t) {
    return this.acts.filter((act) => act.start_s <= t + INSTANT && t < act.end_s);
  }

  /** The plan step that is under way, or the last one that began. */
  stepAt(t) {
    const begun = this.planAt(t).steps.filter((step) => step.start !== null && step.start <= t + INSTANT);
    return begun.reduce((last, step) => (last && last.start > step.start ? last : step), null);
  }

  /** The distance between the nearest points of the robot and a person [m]. */
  distance(person, t) {
    const robot = this.track.pose(this.robot, t);
    const other = this.track.pose(person, t);
    return Math.hypot(robot.x - other.x, robot.y - other.y) - robot.radius - other.radius;
  }
}

/** Give runs the same axes: of time, and of each person's distance. */
export function alike(episodes) {
  const span = Math.max(...episodes.map(({ end }) => end));
  const plans = episodes.flatMap((episode) => episode.plans);
  for (const episode of episodes) {
    episode.span = span;
    for (const person of episode.people) {
      const bands = plans.map(({ values }) => values[person.name]?.band[1] ?? 0);
      person.farthest = Math.max(...bands);
    }
  }
}
