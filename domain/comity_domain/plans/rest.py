"""What is left of a plan, and its numbers without its price."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from types import MappingProxyType

from comity_domain.choices.side import sides
from comity_domain.plans.actions import FETCH, GREETINGS, REACH, RETURN, TASKS
from comity_domain.plans.plan import Plan, PlanStep
from comity_domain.problem.bound_parameters import BEARING
from comity_fis.inference.value import Inference


@dataclass(frozen=True, slots=True)
class VisitProgress:
    """How far a visit is that is not over."""

    greeted: bool
    tasks_left: int
    """How much of the agenda is left, counted from its end."""
    taken: bool = False
    """Whether the robot holds what comes next of what is to be handed over, or has just handed it over."""


NOTHING_BEGUN: Mapping[str, VisitProgress] = MappingProxyType({})


def rest_of(plan: Plan, done: Collection[str], progress: Mapping[str, VisitProgress] = NOTHING_BEGUN) -> Plan:
    """The plan without the stops at which everybody has been served, and without what else was done.

    A visit under way goes on with the way to where the next act is to be, however short.

    Args:
        plan: A plan for some people.
        done: Who was served.
        progress: How far the visits of others are.
    """
    steps = tuple(
        step
        for stop in _stops(plan)
        if not _is_over(stop, done)
        for step in (_left_of(stop, progress[stop[0].person]) if stop[0].person in progress else stop)
    )
    cost = sum(step.cost for step in steps)
    return replace(plan, steps=steps, cost=cost, bound=min(plan.bound, cost))


def _left_of(stop: Sequence[PlanStep], progress: VisitProgress) -> list[PlanStep]:
    """What is left of one stop."""
    greetings = [i for i, step in enumerate(stop) if step.action in GREETINGS and not progress.greeted]
    tasks = [i for i, step in enumerate(stop) if step.action in TASKS]
    left = [*greetings, *tasks[max(0, len(tasks) - progress.tasks_left) :]]
    if not left:
        return []
    first = left[0]
    done = [i for i, step in enumerate(stop[:first]) if step.action in (*GREETINGS, *TASKS)]
    begin = done[-1] + 1 if done else 0
    moves = [step for step in stop[begin:first] if not (step.action == FETCH and progress.taken)]
    if not moves:
        moves = [step for step in stop[:begin] if step.action in (REACH, RETURN)][-1:]
    return [*(_reached(step) for step in moves), *stop[first:]]


def _reached(step: PlanStep) -> PlanStep:
    """Coming back to a person is reaching them, where that is how the rest begins."""
    return replace(step, action=REACH) if step.action == RETURN else step


def renumbered(plan: Plan, values: Mapping[str, Inference]) -> Plan:
    """The same choices with the behaviour parameters of other values; costs and reasons stay as they were.

    Action parameters (a side, a modality, a gesture) stay as planned: whether they are still the cheapest is
    for `rebind` to say.

    Args:
        plan: A plan.
        values: Everyone's parameters, by name.
    """
    return replace(plan, steps=tuple(_renumbered(step, values[step.person]) for step in plan.steps))


def _renumbered(step: PlanStep, values: Inference) -> PlanStep:
    known = (name for name in step.parameters if name in values.parameters)
    numbers = {name: number for name in known if not isinstance(number := values[name].value, str)}
    side = sides(values).get(step.arguments[2]) if step.action in (REACH, RETURN) else None
    bearing = {} if side is None else {BEARING: side.bearing_deg}
    return replace(step, parameters={**step.parameters, **numbers, **bearing})


def _stops(plan: Plan) -> Iterator[list[PlanStep]]:
    """The steps by stop: everything before one person."""
    stop: list[PlanStep] = []
    for step in plan.steps:
        if stop and step.person != stop[0].person:
            yield stop
            stop = []
        stop.append(step)
    if stop:
        yield stop


def _is_over(stop: list[PlanStep], done: Collection[str]) -> bool:
    return all(person in done for step in stop for person in step.people)
