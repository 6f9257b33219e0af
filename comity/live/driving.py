"""Ticks an execution around a real robot, in its time."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import TYPE_CHECKING

from comity_executor import Heartbeat, Loop

if TYPE_CHECKING:
    from comity_executor import Execution, LoopReport, MapRobot


def stop_of(base: MapRobot) -> Heartbeat | None:
    """Asks the robot for its stop in a thread of its own, so that silence is noticed.

    None where the robot's clock is simulated: it stands still while a call does not return.
    """
    return None if hasattr(base, "sleep") else Heartbeat(base.emergency)


def drive(
    execution: Execution, base: MapRobot, heartbeat: Heartbeat | None, each: Callable[[], None]
) -> LoopReport:
    """Tick until all is over, and leave the base at rest.

    Args:
        execution: Its stop is read from the heartbeat, where there is one.
        base: The robot, whose clock may be simulated.
        heartbeat: As `stop_of` has made it.
        each: Called after every tick.
    """
    sleep = getattr(base, "sleep", None)
    if heartbeat is None and sleep is not None:
        return Loop(execution, clock=base.now_s, sleep=sleep).run(each)
    assert heartbeat is not None
    with heartbeat:
        return Loop(execution, clock=time.monotonic).run(each)
