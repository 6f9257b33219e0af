// One run as it was recorded: who was where, what every node did, and what was said.

import { Track } from "./track.js";

const INSTANT = 1e-6; // as in the trace: an event at t has happened when somebody asks about t

export class Episode {
  constructor(data) {
    Object.assign(this, data);
    this.nodes = data.tree.nodes.map(([name, kind, parent, person], path) => ({
      path,
      name,
      kind,
      parent,
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
    this.acts = data.account.visits.flatMap((visit) =>
      visit.acts.map((act) => ({ ...act, person: visit.person })),
    );
    this.steps = data.plan.steps.map((step, index) => this.step(step, index));
  }

  /** A plan step with the node that carries it out, and when that was at work. */
  step(step, index) {
    const person = this.people.map((one) => one.name).find((name) => step.arguments.includes(name)) ?? null;
    const node = this.nodes.findLast((one) => one.name === `${step.action}(${person})`) ?? null;
    const times = node ? node.events.map((event) => event.t) : [];
    return { ...step, index, person, node, start: times[0] ?? null, end: times.at(-1) ?? null };
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
    return this.steps.findLast((step) => step.start !== null && step.start <= t + INSTANT) ?? null;
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
  const people = episodes.flatMap((episode) => episode.people);
  for (const episode of episodes) {
    episode.span = span;
    for (const person of episode.people) {
      person.farthest = Math.max(
        ...people.filter(({ name }) => name === person.name).map(({ band }) => band[1]),
      );
    }
  }
}

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
