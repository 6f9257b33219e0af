"""The limit of `comity plan --domain`: an answer or a refusal comes in its time, whatever the files hold."""

from __future__ import annotations

import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from comity_domain import PlanningFailed
    from comity_domain.custom import Bound, CustomPlan

READING_S = 1.0
"""So much of reading and writing takes nothing from the engine's time (our choice)."""
LATEST_S = 3.5
"""So long after the limit all is left as it is."""


@dataclass(frozen=True, slots=True)
class Clock:
    """What time is left for one plan, the files' reading included."""

    limit_s: float
    started_s: float = field(default_factory=time.monotonic)

    @contextmanager
    def reading(self) -> Iterator[None]:
        """Read, bind and write within the limit.

        Raises:
            PlanningFailed: The time is over.
        """
        from comity_domain import PlanningFailed
        from comity_domain.custom.engines.deadline import Overdue, overdue_after

        try:
            with overdue_after(self.limit_s + LATEST_S):
                yield
        except Overdue:
            raise PlanningFailed(
                f"the files were not even read within {self.limit_s:g} s",
                remedy="Allow more time, or state a smaller problem.",
                cut_off=True,
            ) from None

    def planned(self, bound: Bound) -> CustomPlan:
        """The plan, or why there is none.

        Raises:
            PlanningFailed: None was found within the limit, or there is none.
        """
        from comity_domain import PlanningFailed
        from comity_domain.custom import plan_custom
        from comity_domain.custom.engines.deadline import Overdue, overdue_after
        from comity_domain.errors import out_of_time

        engine_s = self._engine_s()
        try:
            with overdue_after(self._left_s()):
                return plan_custom(bound, time_limit_s=engine_s, diagnose=False)
        except Overdue:
            raise out_of_time(self.limit_s) from None
        except PlanningFailed as failed:
            if failed.reason == out_of_time(engine_s).reason:
                raise out_of_time(self.limit_s) from None  # reading took the rest
            raise self._diagnosed(bound, failed) from None

    def _diagnosed(self, bound: Bound, failed: PlanningFailed) -> PlanningFailed:
        from comity_domain.custom import diagnosed
        from comity_domain.custom.engines.deadline import Overdue, overdue_after

        try:
            with overdue_after(self._left_s()):
                return diagnosed(bound, failed, patience_s=self._left_s())
        except Overdue:
            return failed

    def _left_s(self) -> float:
        return max(self.started_s + self.limit_s + LATEST_S - time.monotonic(), 0.1)

    def _engine_s(self) -> float:
        taken = max(time.monotonic() - self.started_s - READING_S, 0.0)
        return max(round(self.limit_s - taken, 1), 0.1)
