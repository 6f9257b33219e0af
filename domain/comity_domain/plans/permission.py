"""Choices of a plan that are no longer permitted, found without planning, so they can always be dropped."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import replace

from comity_domain.choices.greeting import greetings, ruled_out
from comity_domain.choices.side import sides
from comity_domain.plans.actions import ANNOUNCED, GREET, GREET_TOGETHER, LEAVE, REACH, RETURN
from comity_domain.plans.plan import Plan, PlanStep
from comity_domain.problem.request import Visitee


def not_permitted(plan: Plan, visitees: Mapping[str, Visitee]) -> dict[str, str]:
    """Reasons against planned visits: a side or a greeting that is now excluded.

    Args:
        plan: Made before something changed.
        visitees: People with their current facts, by name; nothing is known of others.

    Returns:
        The first reason, by the person in front of whom the robot would stand.
    """
    found: dict[str, str] = {}
    for step in plan.steps:
        for name in step.people:
            reason = _against(step, visitees[name]) if name in visitees else None
            if reason is not None:
                found.setdefault(step.person, reason)
    return found


def without(plan: Plan, people: Collection[str]) -> Plan:
    """The plan without the visits at which the robot would stand before these people."""
    steps = tuple(step for step in plan.steps if step.person not in people)
    cost = sum(step.cost for step in steps)
    return replace(plan, optimal=False, steps=steps, cost=cost, bound=min(plan.bound, cost))


def _against(step: PlanStep, visitee: Visitee) -> str | None:
    if step.action in (REACH, RETURN):
        side = step.arguments[2]
        if not visitee.now.sees and ANNOUNCED not in step.parameters:
            return f"{visitee.name} does not see, and is to be told that the robot comes"
        if side in visitee.not_from:
            return f"the scenario rules out the {side} of {visitee.name}"
        return None if side in sides(visitee.values) else f"{visitee.name} does not accept the {side}"
    if step.action not in (GREET, GREET_TOGETHER, LEAVE):
        return None
    way = step.arguments[-2:]
    if any(greeting.way == way for greeting in greetings(visitee.values, visitee.now)):
        return None
    out = ruled_out(visitee.values, visitee.now).items()
    # Another way that was asked for, and cannot be had, makes no ban of this one.
    against = next((reason for greeting, reason in out if greeting.way == way), None)
    words = " with ".join(word for word in way if word != "none")
    return None if against is None else f"{visitee.name} is not to be greeted {words}: {against}"
