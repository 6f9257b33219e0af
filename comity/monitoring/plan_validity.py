"""Why the choices of a plan remain valid or not, in the words of the trace."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING

from comity_domain import SKIP
from comity_executor import Cause

if TYPE_CHECKING:
    from comity.planning.request import PlanningRequest
    from comity_domain import Late, Plan

OTHER_M = 0.5
"""Difference in path length above which a path counts as another one [m] (our choice)."""


def known(plan: Plan) -> Cause:
    """How it is known that the choices are the cheapest."""
    text = (
        f"the choices stay: they cost {plan.cost} cm now, and an exact search over all orders, sides and "
        "greetings finds nothing cheaper"
    )
    return Cause("condition", text, float(plan.cost))


def found_again(plan: Plan) -> Cause:
    """A search for another plan found the same choices."""
    text = f"the choices stay: a new search finds the same, which cost {plan.cost} cm now"
    return Cause("condition", text, float(plan.cost))


def verdict(
    rest: Plan, kept: int | None, plan: Plan, unreachable: Mapping[str, str], too_late: Late | None
) -> Cause:
    """Why the choices are no longer valid, in numbers.

    Args:
        rest: The rest of the current plan.
        kept: Current cost of its choices [cm]; None if one is no longer possible.
        plan: The new plan.
        unreachable: People whom no plan can serve now, and why.
        too_late: Who would be greeted too late with these choices, on the world's clock.
    """
    if unreachable:
        reasons = "; ".join(f"{person}: {why}" for person, why in unreachable.items())
        return Cause("condition", f"not everybody can be served as planned: {reasons}", None)
    if kept is None:
        return Cause(
            "condition", f"a choice of the plan is not open any more; the best costs {plan.cost} cm", None
        )
    if too_late is not None:
        text = (
            f"as planned, {too_late}; what keeps every deadline costs {plan.cost} cm now instead of {kept} cm"
        )
    elif _left_out(rest) != _left_out(plan):
        text = (
            "who is left out is decided again, by paths and prices alone; "
            f"the choices would cost {kept} cm now, others {plan.cost} cm"
        )
    else:
        text = f"the choices would cost {kept} cm now, others {plan.cost} cm"
    return Cause("condition", text, float(kept - plan.cost))


def _left_out(plan: Plan) -> set[str]:
    return {step.person for step in plan.steps if step.action == SKIP}


def other_ways(before: PlanningRequest, now: PlanningRequest) -> bool:
    """Whether other people can be reached than before, or ways are longer or shorter by a good deal."""
    old, new = before.request.travel, now.request.travel
    if before.unreachable.keys() != now.unreachable.keys() or old.keys() != new.keys():
        return True
    return any(abs(new[leg] - length_m) > OTHER_M for leg, length_m in old.items())


def choices(rest: Plan, plan: Plan) -> Iterator[Cause]:
    """The steps that differ, before and after, and the order where it is another one."""
    before = [f"{step.action}({', '.join(step.arguments)})" for step in rest.steps]
    after = [f"{step.action}({', '.join(step.arguments)})" for step in plan.steps]
    for old in (step for step in before if step not in after):
        yield Cause("step", f"no longer {old}", None)
    for new in (step for step in after if step not in before):
        yield Cause("step", f"instead {new}", None)
    were, are = (list(dict.fromkeys(step.person for step in each.steps)) for each in (rest, plan))
    stay = set(were) & set(are)
    if [name for name in were if name in stay] != [name for name in are if name in stay]:
        yield Cause("step", f"in the order {', '.join(are)}", None)
