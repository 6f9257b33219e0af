"""The time budget of a request, divided between reading and binding, the engine, and further questions."""

from __future__ import annotations

import time
from dataclasses import dataclass, field

from comity_domain.custom.process import LATEST_S
from comity_domain.custom.solving.bound import Bound
from comity_domain.custom.solving.engines import GRACE_S, LEAST_S
from comity_domain.custom.solving.planning import CustomPlan, diagnosed, plan_custom
from comity_domain.errors import PlanningFailed, out_of_time

READING_S = 0.5
"""Time for starting, reading and binding that is not taken from the engine's time [s] (our choice)."""
HANDING_OVER_S = 0.5


@dataclass(frozen=True, slots=True)
class PlanningClock:
    """The time budget of one plan; it keeps running while the request passes to another process."""

    limit_s: float
    started_s: float = field(default_factory=time.time)

    @property
    def engine_s(self) -> float:
        """Time left for the engine [s]."""
        taken = max(time.time() - self.started_s - READING_S, 0.0)
        return max(round(self.limit_s - taken, 1), LEAST_S)

    @property
    def left_s(self) -> float:
        """Time left for diagnosing why there is no plan, so that the answer is in time [s]."""
        return self.started_s + self.limit_s + LATEST_S - GRACE_S - HANDING_OVER_S - time.time()


def planned(bound: Bound, clock: PlanningClock) -> CustomPlan:
    """The plan within the time limit.

    Raises:
        PlanningFailed: None was found within the limit, or none exists; the error then includes the
            diagnosis.
    """
    engine_s = clock.engine_s
    try:
        return plan_custom(bound, time_limit_s=engine_s, diagnose=False)
    except PlanningFailed as failed:
        if failed.reason == out_of_time(engine_s).reason:
            raise out_of_time(clock.limit_s) from None  # reading used up the time
        left_s = clock.left_s
        raise (diagnosed(bound, failed, patience_s=left_s) if left_s > LEAST_S else failed) from None
