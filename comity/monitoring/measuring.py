"""Computes the metrics of an episode, adding to the frames what trace, scene and visits know."""

from __future__ import annotations

import math
from dataclasses import replace
from itertools import chain, pairwise
from typing import TYPE_CHECKING

from comity.monitoring.parameter_updates import later_distances_m, values_at
from comity_domain.plans.actions import REACH
from comity_domain.problem.bound_parameters import BEARING, DISTANCE
from comity_executor import PROPER_OUTCOMES
from comity_executor.trees.tree import VISITED
from comity_sim2d import Contacts, Known, Metrics, Span, TargetStop, measure

if TYPE_CHECKING:
    from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence

    import numpy as np
    from numpy.typing import NDArray

    from comity.monitoring.parameter_updates import ParameterUpdate
    from comity.preparation import PlannedEpisode
    from comity_domain import Plan
    from comity_executor import PlanUpdate, TraceEvent, Visit
    from comity_fis import Inference
    from comity_sim2d import Frames, RouteMap, Scene, Touch

_DOCKED = "docked?"
"""What the nodes of the tree do that ask whether the robot has docked."""
TAKES_OVER = ("rebound", "replanned")
"""Events from which on another plan, or updated parameters, apply."""


def figures(
    prepared: PlannedEpisode,
    frames: Frames,
    touches: Sequence[Touch],
    visits: Sequence[Visit],
    events: Sequence[TraceEvent],
    *,
    revisions: Sequence[PlanUpdate],
    told: Sequence[ParameterUpdate],
    undisturbed: Mapping[str, NDArray[np.float64]],
) -> Metrics:
    """Measure an episode.

    Args:
        prepared: The scenario with its plan.
        frames: Where everybody was.
        touches: The robot's contacts.
        visits: What came of each.
        events: The trace.
        revisions: One for every event `rebound` or `replanned`, in their order.
        told: What people said on the way, in order.
        undisturbed: Walks without the robot, as `undisturbed_walks` has them.
    """
    plan = prepared.plan
    known = replace(
        known_of(prepared, visits, events, revisions=revisions, told=told),
        contacts=contacts(prepared.scene, frames.entities[1:], touches),
        shortest_m=_shortest_m(prepared.scene, prepared.route_map, frames, visits),
        plan_cost_m=plan.cost / 100.0,
        plan_gap=plan.gap,
        success=all(visit.outcome in PROPER_OUTCOMES for visit in visits),
        undisturbed=undisturbed,
    )
    return measure(frames, known)


def known_of(
    prepared: PlannedEpisode,
    visits: Sequence[Visit],
    events: Sequence[TraceEvent],
    *,
    revisions: Sequence[PlanUpdate],
    told: Sequence[ParameterUpdate],
) -> Known:
    """Whose distance was what, and whom the robot visited when; the arguments are those above."""
    return Known(
        own_m={
            person.name: person.personal_distance_m
            for person in prepared.scene.people
            if person.personal_distance_m is not None
        },
        later_m=later_distances_m(told),
        visits=tuple(_wanted(prepared, visits, events, revisions, told)),
        engaged=_engaged(visits, events),
        groups=tuple(group.members for group in prepared.scene.groups),
    )


def _engaged(visits: Sequence[Visit], events: Sequence[TraceEvent]) -> dict[str, tuple[Span, ...]]:
    """When the robot was on its way to each person or with them; people who are greeted at once share it."""
    found: dict[str, tuple[Span, ...]] = {}
    for person, span in stretches(events):
        found[person] = (*found.get(person, ()), span)
    shared = {visit.person: visit.together_with for visit in visits if visit.together_with}
    return found | {person: found.get(host, ()) for person, host in shared.items()}


def contacts(scene: Scene, people: Collection[str], touches: Iterable[Touch]) -> Contacts:
    """Contacts by what was touched; whatever is neither a person nor furniture is a wall.

    Args:
        scene: With the furniture.
        people: Everybody, passers-by included.
        touches: As they began.
    """
    furniture = {piece.name for piece in scene.furniture}
    touched = [touch.entity for touch in touches]
    of_people = sum(name in people for name in touched)
    of_furniture = sum(name in furniture for name in touched)
    return Contacts(of_people, len(touched) - of_people - of_furniture, of_furniture)


def _wanted(
    prepared: PlannedEpisode,
    visits: Sequence[Visit],
    events: Sequence[TraceEvent],
    revisions: Sequence[PlanUpdate],
    told: Sequence[ParameterUpdate],
) -> Iterator[TargetStop]:
    """The visits that the robot set out for, each with its time and with where it was to stop."""
    asked = _asked(prepared.plan, events, revisions)
    ever = _distances_m(prepared.plan, events, revisions)
    for visit in visits:
        times = [event.t for event in events if is_of(event, VISITED, visit.person)]
        if not times or visit.pose is None or visit.wanted is None:
            continue
        distance_m, bearing_deg = asked.get(visit.person, (visit.wanted.distance_m, visit.wanted.bearing_deg))
        span = Span(times[0], times[-1])
        breaks = _breaks(visit.person, span, events)
        docked = (event for event in events if is_of(event, _DOCKED, visit.person))
        ends = (event.t for event in docked if event.status == "success")
        docked_s = next(ends, None)
        yield TargetStop(
            person=visit.person,
            span=span,
            way=Span(span.start_s, span.end_s if docked_s is None else docked_s),
            distance_m=distance_m,
            bearing_deg=bearing_deg,
            distances_m=ever.get(visit.person, ()),
            arrives=docked_s is not None,
            breaks=breaks,
            docked_s=visit.docked_s,
            own_m=_own_m(prepared.values, told, visit),
            chosen_distance_m=visit.pose.distance_m,
            chosen_bearing_deg=visit.pose.bearing_deg,
        )


def _own_m(own: Mapping[str, Inference], told: Sequence[ParameterUpdate], visit: Visit) -> float | None:
    """Distance of a person when the robot docked last [m]; None where it never did, or none is known."""
    if visit.docked_s is None:
        return None
    values = values_at(own, told, visit.person, visit.docked_s)
    return values[DISTANCE].number if DISTANCE in values.parameters else None


def stretches(events: Sequence[TraceEvent]) -> tuple[tuple[str, Span], ...]:
    """The person that the robot was about, in order: from turning to them until it has done or turns away."""
    found: list[tuple[str, Span]] = []
    about: tuple[str, float] | None = None
    for event in events:
        if event.action != VISITED or (person := event.person) is None:
            continue
        if about and (event.status == "running" or person == about[0]):
            found.append((about[0], Span(about[1], event.t)))
            about = None
        if event.status == "running":
            about = (person, event.t)
    return (*found, (about[0], Span(about[1], events[-1].t))) if about else tuple(found)


def turns(events: Sequence[TraceEvent]) -> Iterator[tuple[str, float, float]]:
    """The same without gaps: to whom it turned, when [s], and when to the next one, inf for the last."""
    about = stretches(events)
    starts = [*(span.start_s for _, span in about), math.inf]
    for (name, _), (start_s, next_s) in zip(about, pairwise(starts), strict=True):
        yield name, start_s, next_s


def _breaks(person: str, visit: Span, events: Sequence[TraceEvent]) -> tuple[Span, ...]:
    """When, between the beginning and the end of a visit, the robot was about another person."""
    others = [span for name, span in stretches(events) if name != person]
    return tuple(span for span in others if visit.start_s <= span.start_s < visit.end_s)


def _asked(
    first: Plan, events: Iterable[TraceEvent], revisions: Iterable[PlanUpdate]
) -> dict[str, tuple[float, float]]:
    """Where the robot was to stop before each person when it first docked there: distance [m], bearing [deg].

    Where it never did, by the last plan that had them.
    """
    asked, docked, following = _stops(first), set[str](), iter(revisions)
    for event in events:
        if event.status in TAKES_OVER:
            stops = _stops(next(following).plan)
            asked |= {person: stop for person, stop in stops.items() if person not in docked}
        elif event.status == "success" and event.action == _DOCKED and event.person is not None:
            docked.add(event.person)
    return asked


def _distances_m(
    first: Plan, events: Iterable[TraceEvent], revisions: Iterable[PlanUpdate]
) -> dict[str, tuple[tuple[float, float], ...]]:
    """Since when [s] which distance [m] was wanted, by person: of the plans that have them."""
    takes_over_s = (event.t for event in events if event.status in TAKES_OVER)
    found: dict[str, tuple[tuple[float, float], ...]] = {}
    for since_s, plan in chain(
        [(0.0, first)], zip(takes_over_s, (each.plan for each in revisions), strict=True)
    ):
        for person, (distance_m, _) in _stops(plan).items():
            found[person] = (*found.get(person, ()), (since_s, distance_m))
    return found


def _stops(plan: Plan) -> dict[str, tuple[float, float]]:
    return {
        step.person: (float(step.parameters[DISTANCE]), float(step.parameters[BEARING]))
        for step in plan.steps
        if step.action == REACH
    }


def is_of(event: TraceEvent, action: str, person: str) -> bool:
    """Whether an event is about a person's node that does this."""
    return (event.action, event.person) == (action, person)


def _shortest_m(scene: Scene, route_map: RouteMap, frames: Frames, visits: Sequence[Visit]) -> float | None:
    """Shortest path through the places where the robot docked, around people at the safety margin [m]."""
    times = [visit.docked_s for visit in visits if visit.docked_s is not None]
    rows = frames.time_s.searchsorted([0.0, *sorted(times)])
    places = [(float(x), float(y)) for x, y in frames.poses[rows.clip(max=len(frames) - 1), 0, :2]]
    nearest = dict.fromkeys((person.name for person in scene.people), 0.0)
    lengths = [route_map.length(here, there, keep=nearest) for here, there in pairwise(places)]
    known = [length for length in lengths if length is not None]
    return sum(known) if len(known) == len(lengths) else None
