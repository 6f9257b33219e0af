"""Cost difference of two plans: by step and cost term, with reasons."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable
from functools import partial
from typing import TYPE_CHECKING

from comity.answers.plan import CostPartChangeAnswer, StepCostChangeAnswer
from comity.report.plans.leg_change import why_this_leg
from comity.report.text import number
from comity_domain import visits_of

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from comity.preparation import PlannedEpisode
    from comity_domain import Plan, PlanStep
    from comity_fis import Inference

TRAVEL, NEARNESS, WAITING = "travel", "nearness", "waiting"
Because = Callable[[str, "PlanStep | None", "PlanStep | None"], str]
"""Returns the reason for a change, from the cost term and the step in both plans."""
Key = tuple[str, str, int]
"""Step key: action, person or company, and number of earlier steps with the same two."""


def cost_changes(before: PlannedEpisode, after: PlannedEpisode) -> Iterator[StepCostChangeAnswer]:
    """Steps with different costs in the two plans, in the order of the plans.

    Args:
        before: The scenario as written.
        after: The scenario with other profiles, or another rulebook.
    """
    was, is_ = _by_key(before.plan), _by_key(after.plan)
    for key in dict.fromkeys((*is_, *was)):
        old, new = was.get(key), is_.get(key)
        step = new or old
        if step is not None:
            yield from step_change(old, new, step.people, partial(_because, before=before, after=after))


def step_change(
    old: PlanStep | None, new: PlanStep | None, people: tuple[str, ...], because: Because
) -> Iterator[StepCostChangeAnswer]:
    """Cost changes of a step between two plans; nothing if equal.

    Args:
        old: The step in the first plan; None if missing.
        new: The step in the second plan; None if missing.
        people: People of the step.
        because: Returns the reason for the change of a cost term.
    """
    parts, step = tuple(_parts(old, new, because)), new or old
    if parts and step is not None:
        yield StepCostChangeAnswer(
            action=step.action,
            people=people,
            before=old.arguments if old else None,
            after=new.arguments if new else None,
            cost=(old.cost if old else 0, new.cost if new else 0),
            parts=parts,
        )


def _by_key(plan: Plan) -> dict[Key, PlanStep]:
    found: dict[Key, PlanStep] = {}
    count = Counter[tuple[str, str]]()
    for step in plan.steps:
        name = (step.action, step.arguments[2] if step.companions else step.person)
        found[*name, count[name]] = step
        count[name] += 1
    return found


def _parts(old: PlanStep | None, new: PlanStep | None, because: Because) -> Iterator[CostPartChangeAnswer]:
    costs = [step.cost_parts if step else {} for step in (old, new)]
    for part in dict.fromkeys((*costs[0], *costs[1])):
        was, is_ = (each.get(part, 0) for each in costs)
        if was != is_:
            yield CostPartChangeAnswer(part=part, before=was, after=is_, because=because(part, old, new))


def _because(
    part: str, old: PlanStep | None, new: PlanStep | None, *, before: PlannedEpisode, after: PlannedEpisode
) -> str:
    if old is None and new is not None:
        return (
            "not done before" if part == TRAVEL else f"not done before; now {new.why.chosen or new.why.text}"
        )
    if old is None or new is None:
        return "not done any more"
    if part == TRAVEL:
        return why_this_leg(old, new, before, after)
    if part == WAITING:
        return f"greeted before are {_earlier(old, before.plan)}, and now {_earlier(new, after.plan)}"
    if part == NEARNESS:
        moved = f", and now before {new.person}" if old.person != new.person else ""
        preferred = _preferences(new, before.values, after.values)
        return f"the robot stands before {old.person}{moved}; {preferred}"
    return f"before, {old.why.chosen}; now, {new.why.chosen}"


def _earlier(step: PlanStep, plan: Plan) -> str:
    """People greeted before a person, in words."""
    stops = [visit.spot.place for visit in visits_of(plan)]
    return ", ".join(stops[: stops.index(step.person)]) or "nobody"


def _preferences(step: PlanStep, before: Mapping[str, Inference], after: Mapping[str, Inference]) -> str:
    """Preferred distance [m] of each person of a company, before and after."""
    name, preferred = "conversational_distance", []
    for person in step.people:
        was, is_ = (number(values[person][name].number, "m") for values in (before, after))
        preferred.append(f"{person} likes {was}" + (f", and now {is_}" if was != is_ else ""))
    return "; ".join(preferred)
