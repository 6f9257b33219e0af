"""Errors of planning."""

from __future__ import annotations

from comity_fis.errors import ComityError


class PlanningFailed(ComityError):  # noqa: N818 - it says what happened; the family's base carries the suffix
    """There is no plan, or none was found in time.

    Args:
        reason: One sentence without a full stop.
        remedy: What to do now: one whole sentence.
        cut_off: Whether a limit ended the search, so that another time or machine may find a plan.
    """

    def __init__(self, reason: str, *, remedy: str, cut_off: bool = False) -> None:
        self.reason = reason
        self.remedy = remedy
        self.cut_off = cut_off
        super().__init__(f"{reason}. {remedy}")

    def __reduce__(self) -> tuple[object, ...]:
        return _rebuilt, (type(self), self.reason, self.remedy, self.cut_off)


def _rebuilt(kind: type[PlanningFailed], reason: str, remedy: str, cut_off: bool) -> PlanningFailed:
    """Rebuild an error when unpickling, so that it keeps its parts across processes."""
    failed = kind(reason, remedy=remedy)
    failed.cut_off = cut_off
    return failed


class NoEngine(PlanningFailed):
    """No installed engine supports the problem."""


class NoPlan(PlanningFailed):
    """It is proven that no plan reaches the goals."""


def require_time_limit(time_limit_s: float) -> None:
    """Reject a time limit [s] that is not above zero.

    Raises:
        ValueError: It is not.
    """
    if not time_limit_s > 0.0:
        raise ValueError(f"the time limit must be positive, got {time_limit_s!r} s")


def out_of_time(time_limit_s: float) -> PlanningFailed:
    """The error that no plan was found within a time limit [s]."""
    return PlanningFailed(
        f"no plan was found within {time_limit_s:g} s",
        remedy="Allow more time, or ask for less at once, such as fewer people.",
        cut_off=True,
    )
