"""Ticks an execution on a real robot, in real time or by the robot's simulated clock."""

from __future__ import annotations

import time
from collections.abc import Callable
from contextlib import nullcontext
from typing import TYPE_CHECKING

from comity_executor import Heartbeat, Loop
from comity_executor.robots.raised import raised

if TYPE_CHECKING:
    from comity_executor import Execution, LoopReport, MapRobot


def stop_of(base: MapRobot) -> Heartbeat | None:
    """Polls the robot's stop in a separate thread, so that silence is noticed.

    None if the robot's clock is simulated, as it stands still while a call does not return.
    """
    return None if sleep_of(base) else Heartbeat(base.emergency)


def sleep_of(base: MapRobot) -> Callable[[float], None] | None:
    """The sleep function of a robot with a simulated clock; None in real time."""
    return getattr(base, "sleep", None)


def drive(
    execution: Execution, base: MapRobot, heartbeat: Heartbeat | None, each: Callable[[], None]
) -> LoopReport:
    """Tick until the execution ends, and leave the base at rest.

    Args:
        execution: It reads the stop from the heartbeat, if there is one.
        base: The robot; its clock may be simulated.
        heartbeat: From `stop_of`.
        each: Called after every tick.
    """
    sleep = sleep_of(base)
    if sleep is None:
        with heartbeat or nullcontext():
            return Loop(execution, clock=time.monotonic).run(_ending(execution, each))
    clock = _Clock(base, sleep, execution)
    return Loop(execution, clock=clock.now_s, sleep=clock.sleep).run(_ending(execution, each))


class _Clock:
    """A simulated clock; if it fails, the execution ends on real time.

    Args:
        base: The robot with the clock.
        sleep: Advances the clock.
        execution: The execution to end.
    """

    def __init__(self, base: MapRobot, sleep: Callable[[float], None], execution: Execution) -> None:
        self._base = base
        self._sleep = sleep
        self._execution = execution
        self._is_broken = False

    def now_s(self) -> float:
        """The time [s]."""
        if not self._is_broken:
            try:
                return float(self._base.now_s())
            except Exception as error:
                self._break(error)
        return time.monotonic()

    def sleep(self, seconds: float) -> None:
        """Advance time."""
        if not self._is_broken:
            try:
                self._sleep(seconds)
                return
            except Exception as error:
                self._break(error)
        time.sleep(seconds)

    def _break(self, error: Exception) -> None:
        self._is_broken = True
        self._execution.stop(f"the clock: {raised(error)}")


def _ending(execution: Execution, each: Callable[[], None]) -> Callable[[], None]:
    """The callback, made to end the execution if it raises."""

    def safely() -> None:
        try:
            each()
        except Exception as error:
            execution.stop(raised(error))

    return safely
