"""A planner that can be made to break down; else it is the one behind it."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from comity.monitoring.replanning import WorldPlanner
    from comity_executor import ExecutionState, FaultError, NoPlanUpdate, PlanUpdate
    from comity_fis import Inference


class FalliblePlanner:
    """The executor's `Planner`, and who is told what changed.

    Args:
        planner: Who plans while nothing is wrong.
    """

    def __init__(self, planner: WorldPlanner) -> None:
        self._planner = planner
        self._due: list[FaultError] = []

    def break_down(self, error: FaultError, calls: int) -> None:
        """Raise an exception in the next calls."""
        self._due += [error] * calls

    def note(self, about: str, text: str, fault: str | None) -> None:
        """To the planner, broken or not."""
        self._planner.note(about, text, fault)

    def tell(self, person: str, values: Inference, text: str) -> None:
        """A person's parameters are others from now on, and why."""
        self._planner.tell(person, values, text)

    def has_news(self, t: float) -> bool:
        """As the planner says."""
        return self._planner.has_news(t)

    def review(self, course: ExecutionState) -> PlanUpdate | None:
        """As the planner says.

        Raises:
            FaultError: where it breaks down.
        """
        self._fail()
        return self._planner.review(course)

    def permitted(self, course: ExecutionState) -> PlanUpdate | None:
        """As the planner says: it takes no planning, and so does not break down with it."""
        return self._planner.permitted(course)

    def replan(self, course: ExecutionState) -> PlanUpdate | NoPlanUpdate:
        """As the planner says.

        Raises:
            FaultError: where it breaks down.
        """
        self._fail()
        return self._planner.replan(course)

    def _fail(self) -> None:
        if self._due:
            raise self._due.pop(0)
