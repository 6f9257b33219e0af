"""Optimality of a plan, in words."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from comity.answers.plan import PlanAnswer


def quality(answer: PlanAnswer, *, proven: str = "no plan costs less") -> str:
    """What is known about cheaper plans, in words.

    Args:
        answer: The plan.
        proven: Wording for an optimal plan.
    """
    if answer.optimal:
        return proven
    known = "not proven optimal"
    if answer.bound and answer.gap is not None:
        known += f": none costs less than {answer.bound}, {100 * answer.gap:.0f} % below"
    return f"{known}; {answer.engine} was killed from outside, so plan again" if answer.killed else known
