"""The loop that ticks an execution in real time: rate, overruns, and a clean shutdown.

Whatever ends it (completion, an error, Ctrl-C, SIGTERM), the base is commanded to stop, and the loop
continues until the base confirms rest or the time for that is over.
"""

from __future__ import annotations

import signal
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass

from comity_executor.execution import Execution, ExecutionStatus

RATE_HZ = 20.0
"""A goal holds for 0.3 s (`LONGEST_LEASE_S`): at this rate five ticks may be late before the base stops."""
HANGS_S = 1.0
"""Maximum duration of a call once the loop is to end [s] (our choice)."""
WAY_OUT_S = 60.0
"""Time for which the stop is repeated after the loop's end if the base does not confirm it [s] (our
choice)."""


class HungError(TimeoutError):
    """A call of the robot that has not returned, and was broken off."""


@dataclass(frozen=True, slots=True)
class Overrun:
    """A tick that took longer than its share of time."""

    tick: int
    """Number of the tick, from 0."""
    took_s: float


@dataclass(frozen=True, slots=True)
class LoopReport:
    """The result of a loop."""

    status: ExecutionStatus
    ticks: int
    overruns: tuple[Overrun, ...]
    interrupted_by: str | None
    """`SIGINT` or `SIGTERM`; None if it ended by itself."""

    def __str__(self) -> str:
        longest = max((one.took_s for one in self.overruns), default=0.0)
        late = f", the longest took {longest:.2f} s" if self.overruns else ""
        ended = f", ended by {self.interrupted_by}" if self.interrupted_by else ""
        return f"{self.status} after {self.ticks} ticks{ended}; {len(self.overruns)} ticks were late{late}"


class Loop:
    """Ticks one execution.

    Args:
        execution: Its robot's time is real, or that of a simulator that runs by itself.
        rate_hz: How often.
        clock: Real seconds that never run backwards, and
        sleep: what lets some of them pass; both for tests.
    """

    def __init__(
        self,
        execution: Execution,
        *,
        rate_hz: float = RATE_HZ,
        clock: Callable[[], float] = time.monotonic,
        sleep: Callable[[float], None] = time.sleep,
    ) -> None:
        if not rate_hz > 0.0:
            raise ValueError(f"rate_hz: expected a number above 0, got {rate_hz!r}")
        self._execution = execution
        self._period_s = 1.0 / rate_hz
        self._clock = clock
        self._sleep = sleep
        self._ticks = 0
        self._overruns: list[Overrun] = []
        self._signal: signal.Signals | None = None
        self._since_s: float | None = None
        """When what may hang was called, by the real clock; None while nothing was."""

    def run(self, each: Callable[[], None] = lambda: None) -> LoopReport:
        """Tick until the execution is over, or a signal comes, and leave the base at rest.

        A first Ctrl-C or SIGTERM ends the loop as it should end; a second one while the base is made to stop
        is as it always is. A call of the robot that does not return is broken off then, with a `HungError`,
        where the system can do that.

        Args:
            each: Called after every tick, such as to show how it goes, or to `resume` after a stop.
        """
        with self._signals():
            try:
                while self._signal is None and self._tick() == "running":
                    self._watched(each)
                    self._pause()
            finally:
                self._stop()
        name = self._signal.name if self._signal else None
        return LoopReport(self._execution.status, self._ticks, tuple(self._overruns), name)

    def _tick(self) -> ExecutionStatus:
        self._began_s = self._clock()
        self._watched(self._execution.tick)
        status = self._execution.status
        took_s = self._clock() - self._began_s
        if took_s > self._period_s:
            self._overruns.append(Overrun(self._ticks, took_s))
        self._ticks += 1
        return status

    def _watched(self, call: Callable[[], object]) -> None:
        """Call what may hang; once a signal has come it is broken off after a while."""
        self._since_s = time.monotonic()
        try:
            call()
        except HungError as error:
            self._execution.stop(str(error))
        finally:
            self._since_s = None

    def _break_off(self, number: int, _: object) -> None:
        """What a timer calls again and again, once a signal has come."""
        since_s = self._since_s
        if since_s is not None and time.monotonic() - since_s > HANGS_S:
            self._since_s = time.monotonic()
            raise HungError(f"a call of the robot has not returned within {HANGS_S:g} s")

    def _pause(self) -> None:
        """Until the next tick is due; what a late one has missed is not made up for."""
        rest_s = self._period_s - (self._clock() - self._began_s)
        if rest_s > 0.0:
            self._sleep(rest_s)

    def _stop(self) -> None:
        """The way out: stop, and hear of it."""
        self._execution.stop(self._signal.name if self._signal else "the loop was left")
        ends_s = self._clock() + WAY_OUT_S
        while True:
            self._watched(self._execution.tick)
            if self._execution.is_at_rest or self._execution.status == "stop_unconfirmed":
                return
            if self._clock() >= ends_s:  # the robot's own clock stands still
                return
            self._sleep(self._period_s)

    @contextmanager
    def _signals(self) -> Iterator[None]:
        """Note a signal instead of raising in the middle of a command; only the main thread may."""
        if threading.current_thread() is not threading.main_thread():
            yield
            return
        before = {one: signal.getsignal(one) for one in (signal.SIGINT, signal.SIGTERM)}

        def note(number: int, _: object) -> None:
            self._signal = signal.Signals(number)
            signal.signal(number, before[self._signal] or signal.SIG_DFL)
            if hasattr(signal, "setitimer"):
                signal.signal(signal.SIGALRM, self._break_off)
                signal.setitimer(signal.ITIMER_REAL, HANGS_S, HANGS_S)

        for number, handler in before.items():
            if handler is not signal.SIG_IGN:
                signal.signal(number, note)
        alarm = signal.getsignal(signal.SIGALRM) if hasattr(signal, "SIGALRM") else None
        try:
            yield
        finally:
            for number, handler in before.items():
                signal.signal(number, handler or signal.SIG_DFL)
            if hasattr(signal, "setitimer"):
                signal.setitimer(signal.ITIMER_REAL, 0.0)
                signal.signal(signal.SIGALRM, alarm or signal.SIG_DFL)
