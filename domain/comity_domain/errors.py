"""What can go wrong in planning."""

from __future__ import annotations

from comity_fis.errors import ComityError


class PlanningFailed(ComityError):  # noqa: N818 - it says what happened; the family's base carries the suffix
    """There is no plan, or none was found in time.

    Args:
        reason: One sentence without a full stop.
        remedy: What to do now: one whole sentence.
    """

    def __init__(self, reason: str, *, remedy: str) -> None:
        self.reason = reason
        self.remedy = remedy
        super().__init__(f"{reason}. {remedy}")


class NoEngine(PlanningFailed):
    """No engine that is installed takes the problem."""


class NoPlan(PlanningFailed):
    """It is shown that no plan reaches the goals."""


class OutOfTime(PlanningFailed):
    """A limit was reached before a plan was found, or shown that there is none."""
