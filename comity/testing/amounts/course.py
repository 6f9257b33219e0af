"""The course of an episode behind its metrics: plans, their parameters, durations, path lengths, failures."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from itertools import groupby
from typing import TYPE_CHECKING

import numpy as np

from comity.monitoring.lateness import late_s
from comity.testing.amounts.amount import told
from comity.testing.amounts.happened import happened
from comity.testing.amounts.met import met
from comity.testing.amounts.planned import Planned, last_for, plans
from comity.testing.amounts.shaping import shaping
from comity.testing.trials.visits import spoken_to
from comity_domain.problem.bound_parameters import BEARING

if TYPE_CHECKING:
    from comity.episode import Episode
    from comity_domain import PlanStep
    from comity_executor import Cause, Node, TraceEvent, Visit
    from comity_fis import Inference
    from comity_sim2d import Frames

LEAST_S = 0.5
"""Actions shorter than this [s] are left out (our choice)."""
STOOD_M = 0.005
"""Path lengths from this on [m] are shown; shorter ones would read 0.00 m."""
MOST = 8
"""Maximum number of actions listed, the longest ones."""
_PAUSE = "another plan is asked for in "
"""Beginning of the text of a pause of the executor."""
MOST_TIMES = 3
"""Up to this many failures of one action for one reason are listed singly (our choice)."""
MOTIONS = ("Navigate_to_user", "Dock_to_user", "Face_user", "Go_to", "Step_away", "Await_way")
"""Actions whose failure affects where the robot goes."""


def of_course(
    episode: Episode,
    person: str | None = None,
    *,
    until: tuple[str, float] | None = None,
    moving: bool = False,
) -> Iterator[str]:
    """The plans and their parameters, the longest actions and the failures; of the whole run or of one visit.

    Args:
        episode: What happened.
        person: Whose visit; None for the whole run.
        until: A person and the time when the robot stood before them [s]; later events are left out.
        moving: Whether to list failed motions only: an interrupted utterance does not change the route.
    """
    until_s = until[1] if until else math.inf
    for since_s, because, steps in _steps(plans(episode), person, until[0] if until else None):
        if since_s >= until_s:
            break
        if because:
            yield f"replanned at t={since_s:.2f} s: {because}"
        yield from (_planned(step, episode.prepared.values) for step in steps)
    yield from shaping(episode, person)
    yield from of_time(episode, person, until_s=until_s, moving=moving)


def of_plan(episode: Episode) -> Iterator[str]:
    """The steps of the first plan, and the parameters behind them."""
    yield from (_planned(step, episode.prepared.values) for step in episode.prepared.plan.steps)
    yield from shaping(episode)


def _steps(
    made: Sequence[Planned], person: str | None, to: str | None
) -> Iterator[tuple[float, str, Sequence[PlanStep]]]:
    """Start [s], steps and reason to replan; of all plans, or of the plan by which a person was visited.

    Args:
        made: All plans, in order.
        person: Whose visit; None for all.
        to: The last person before whom the robot is to stand; None for all.
    """
    last = None if person is None else last_for(made, person)
    for each in made if person is None else [last] if last else []:
        steps = [step for step in each.plan.steps if person in (None, *step.people)]
        arrives = [step.action == "Reach_user" and step.person == to for step in steps]
        end = len(steps) - arrives[::-1].index(True) if any(arrives) else len(steps)
        yield each.since_s, each.because[0].text if each.because else "", steps[:end]


def of_time(
    episode: Episode, person: str | None = None, *, until_s: float = math.inf, moving: bool = False
) -> Iterator[str]:
    """Scheduled events, encounters, the longest actions, waiting times and failures."""
    yield from happened(episode, person, until_s=until_s, moving=moving)
    yield from met(episode, until_s)
    theirs = [*_of_actions(episode.events, episode.visits, person)]
    yield from _done(theirs, episode.frames, until_s)
    yield from _waited(episode.events, until_s)
    yield from _failed(theirs, until_s, moving=moving)


def of_lateness(episode: Episode, visit: Visit) -> Iterator[str]:
    """How late a greeting ended, and what took the time until then; nothing if it was in time."""
    if (late := late_s(episode.prepared.visitees, visit)) and visit.greeted_s is not None:
        yield f"visit     greeted at t={visit.greeted_s:.2f} s, {late:.2f} s later than its by_s"
        yield from of_time(episode, until_s=visit.greeted_s)


def runs(events: Iterable[TraceEvent]) -> Iterator[tuple[float, float, Node]]:
    """Duration [s], start [s] and node of each run, from RUNNING to its result or halt."""
    begun: dict[int, float] = {}
    for event in events:
        if event.status == "running":
            begun[event.path] = event.t
        elif event.path in begun:
            start = begun.pop(event.path)
            yield event.t - start, start, event.of


def _planned(step: PlanStep, inferred: Mapping[str, Inference]) -> str:
    parts = [f"{name.replace('_', ' ')} {cost}" for name, cost in step.cost_parts.items() if cost]
    values = [
        f"{name.replace('_', ' ')} {told(value, unit)}"
        for name, value, unit in _other_than_theirs(step, inferred)
        if not isinstance(value, str) and (name != BEARING or value)  # the side says front
    ]
    details = "; ".join(filter(None, (", ".join(parts), ", ".join(values))))
    head = f"step      {step.action}({', '.join(step.arguments)}), cost {step.cost}"
    return f"{head}: {details}" if details else head


def _other_than_theirs(
    step: PlanStep, inferred: Mapping[str, Inference]
) -> Iterator[tuple[str, float | str, str | None]]:
    """Values of a step that are no parameters of the person or differ from theirs, with their units."""
    known = inferred[step.person].parameters if step.person in inferred else {}
    for name, value in step.parameters.items():
        if name not in known:
            yield name, value, "deg" if name == BEARING else None
        elif known[name].value != value:
            yield name, value, known[name].unit


def _done(actions: Iterable[TraceEvent], frames: Frames, until_s: float) -> Iterator[str]:
    ran = [
        (start, took, node.name) for took, start, node in runs(actions) if took >= LEAST_S and start < until_s
    ]
    longest = sorted(sorted(ran, key=lambda one: -one[1])[:MOST])
    for start, together in groupby(longest, key=lambda one: round(one[0], 2)):
        did = ", ".join(f"{node} for {_amount(frames, began, took)}" for began, took, node in together)
        yield f"did       {did}, from t={start:.2f} s"


def _amount(frames: Frames, start_s: float, took_s: float) -> str:
    """Duration, and path length unless the robot stood."""
    way_m = _way_m(frames, start_s, start_s + took_s)
    return f"{took_s:.2f} s" + (f" and {way_m:.2f} m" if way_m >= STOOD_M else "")


def _way_m(frames: Frames, start_s: float, end_s: float) -> float:
    during = (frames.time_s >= start_s - 1e-9) & (frames.time_s <= end_s + 1e-9)
    return float(np.hypot(*np.diff(frames.poses[during, 0, :2], axis=0).T).sum())


def _of_actions(
    events: Iterable[TraceEvent], visits: Sequence[Visit], person: str | None
) -> Iterator[TraceEvent]:
    """Events of all actions, or of those for a person or for the approached member of their company."""
    whose = (person, spoken_to(visits, person)) if person else ()
    return (event for event in events if event.of.kind == "action" and (not whose or event.person in whose))


def _waited(events: Sequence[TraceEvent], until_s: float) -> Iterator[str]:
    """How long no plan was being executed, and why."""
    since = None
    for event in events:
        if event.t > until_s:
            break
        if event.status == "not_replanned" and event.because:
            since = since or event
        elif since is not None:
            yield from _wait(since, event.t)
            since = None
    if since is not None:
        yield from _wait(since, min(until_s, events[-1].t))


def _wait(since: TraceEvent, end_s: float) -> Iterator[str]:
    if end_s - since.t >= LEAST_S:
        yield f"waited    {end_s - since.t:.2f} s from t={since.t:.2f} s: {_why(since.because)}"


def _why(because: Sequence[Cause]) -> str:
    """The last link of the causes that is not the pause: one wait may have many pauses."""
    links = [cause.text for cause in because if not cause.text.startswith(_PAUSE)]
    return (links or [because[-1].text])[-1]


def _failed(actions: Iterable[TraceEvent], until_s: float, *, moving: bool) -> Iterator[str]:
    """Failed actions, each with its nearest cause; those with the same reason are grouped."""
    alike: dict[tuple[str, str], list[float]] = {}
    for event in actions:
        failed = event.status == "failure" and event.t < until_s
        if failed and (not moving or event.action in MOTIONS):
            because = f": {event.because[0].text}" if event.because else ""
            alike.setdefault((event.node, because), []).append(event.t)
    for (node, because), times in alike.items():
        until = f" and {len(times) - 1} more times until t={times[-1]:.2f} s"
        more = until if len(times) > MOST_TIMES else ""
        for t in times[: 1 if more else None]:
            yield f"failed    {node} at t={t:.2f} s{more}{because}"
