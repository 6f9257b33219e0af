"""What is left of a plan, and its numbers without its price."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping
from dataclasses import replace

from comity_domain.plan import Plan, PlanStep
from comity_domain.side import sides
from comity_fis.value import Inference

REACH = "Reach_user"


def rest_of(plan: Plan, done: Collection[str]) -> Plan:
    """The plan without the stops at which everybody has been served.

    Args:
        plan: A plan for some people.
        done: Who was served.
    """
    steps = tuple(step for stop in _stops(plan) if not _is_over(stop, done) for step in stop)
    cost = sum(step.cost for step in steps)
    return replace(plan, steps=steps, cost=cost, bound=min(plan.bound, cost))


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
    if step.action != REACH:
        return step
    names = ("conversational_distance", "approach_direction", "approach_speed")
    numbers: dict[str, float | str] = {name: values[name].number for name in names}
    if (side := sides(values).get(step.arguments[2])) is not None:
        numbers["approach_bearing"] = side.bearing_deg
    return replace(step, parameters={**step.parameters, **numbers})


def _stops(plan: Plan) -> Iterator[list[PlanStep]]:
    """The steps by stop: each begins where the robot goes to somebody; who is skipped stands alone."""
    stop: list[PlanStep] = []
    for step in plan.steps:
        if stop and (step.action == REACH or step.person != stop[0].person):
            yield stop
            stop = []
        stop.append(step)
    if stop:
        yield stop


def _is_over(stop: list[PlanStep], done: Collection[str]) -> bool:
    return all(person in done for step in stop for person in step.people)
