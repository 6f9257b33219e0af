"""Causes of the order of visits: costs, deadlines and priorities of a plan, or replanning."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import TYPE_CHECKING

from comity.monitoring.measuring import TAKES_OVER
from comity.report.plans.plan_why import PARTS
from comity.specification.goals import greeted
from comity.testing.amounts import causes
from comity.testing.amounts.shaping import told_of
from comity_domain import in_order
from comity_executor.trees.tree import DOCKED

if TYPE_CHECKING:
    from comity.episode import Episode
    from comity.scenario import ScenarioFile
    from comity_domain import OtherOrder, Plan
    from comity_executor import TraceEvent

_OF_WAYS = {"travel": "conversational_distance", "side": "approach_direction"}
"""Cost terms, with the parameter that each depends on."""


def docked_at(event: TraceEvent) -> str | None:
    """The person at whom the robot docked in this event; None for other events."""
    return event.person if event.status == "success" and event.action == DOCKED else None


def visited(events: Iterable[TraceEvent]) -> tuple[str, ...]:
    """The people at whom the robot docked, in order."""
    docked = (docked_at(event) for event in events)
    return tuple(dict.fromkeys(name for name in docked if name is not None))


def of_order(episode: Episode, people: Sequence[str]) -> Iterator[str]:
    """Why these people are visited in another order: the plan's reason, and those of later plans.

    A decision made before any of them was reached, and revised afterwards, no longer counts as a reason.
    """
    plan, docked = episode.prepared.plan, list[str]()
    served, now = {name for step in plan.steps for name in step.people}, _among(people, _stops(plan))
    as_wanted = now == tuple(name for name in people if name in served)
    reasons = [] if as_wanted else [tuple(_planned(episode, people))]
    following = iter(episode.revisions)
    for event in episode.events:
        if person := docked_at(event):
            docked.append(person)
        if event.status in TAKES_OVER:
            before, now = now, _among(people, (*docked, *_stops(next(following).plan)))
            if now != before:
                begun = not set(docked).isdisjoint(people)
                reasons = [*(reasons if begun else ()), tuple(causes.of_event(event))]
    for reason in reasons:
        yield from reason


def _stops(plan: Plan) -> Iterator[str]:
    return (step.person for step in plan.steps if step.action == "Reach_user")


def _among(people: Sequence[str], stops: Iterable[str]) -> tuple[str, ...]:
    return tuple(name for name in dict.fromkeys(stops) if name in people)


def _planned(episode: Episode, people: Sequence[str]) -> Iterator[str]:
    """How the first plan would look in the other order."""
    plan = episode.prepared.plan
    yield f"plan      {', '.join(_stops(plan)) or 'nobody'}, cost {plan.cost} cm"
    other = in_order(episode.prepared.asked.request, plan, people)
    if other is None:
        yield f"order     no plan is known that visits {' before '.join(people)}"
        return
    told = f"order     {', '.join(other.people)}"
    if other.too_late is not None:
        yield f"{told} would cost {_price(other)}, and break a deadline: {other.too_late}"
        yield from _goals(episode.prepared.file, (other.too_late.person,), "by_s")
        return
    yield f"{told} would cost {_price(other)}{_parts(other)}"
    if "waiting" in other.extra_parts:
        yield from _goals(episode.prepared.file, other.people, "priority")
    names = [name for part, name in _OF_WAYS.items() if part in other.extra_parts]
    pairs = ((person, name) for name in names for person in other.people)
    yield from told_of(episode.prepared.values, episode.told, pairs)


def _price(other: OtherOrder) -> str:
    if not other.extra_cost:
        return "the same"
    return f"{abs(other.extra_cost)} cm {'more' if other.extra_cost > 0 else 'less'}"


def _parts(other: OtherOrder) -> str:
    parts = sorted(other.extra_parts.items(), key=lambda part: -part[1])
    told = ", ".join(f"{extra:+d} {PARTS.get(part, part)}" for part, extra in parts)
    return f": {told}" if told else ""


def _goals(file: ScenarioFile, people: Sequence[str], key: str) -> Iterator[str]:
    """The values under a key of the scenario's goals for these people, where present."""
    for i, person in greeted(file.scenario.goals):
        written = getattr(file.scenario.goals[i], key)
        if person in people and written:
            yield f"goal      {person} has `{key}: {written:g}` ({file.where('goals', i, key)})"
