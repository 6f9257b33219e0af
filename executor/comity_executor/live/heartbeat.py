"""Polls a real robot's emergency stop in a separate thread, so that silence is noticed.

A call that does not return would block its tick, and the stop would go unnoticed. Here the tick reads the
last answer; if that is too old, the stop counts as pressed.
"""

from __future__ import annotations

import threading
import time
from collections.abc import Callable
from types import TracebackType

from comity_executor.robots.raised import raised

SILENT_S = 0.5
"""Age of the last answer above which the stop counts as pressed [s] (our choice)."""
EVERY_S = 0.02


class Heartbeat:
    """Polls a robot's stop continuously; pass `read` to an `Execution` as its `emergency`.

    Args:
        ask: The robot's `emergency`. It is called in another thread than the robot's other calls.
        clock: Seconds that never run backwards.
    """

    def __init__(self, ask: Callable[[], object], *, clock: Callable[[], float] = time.monotonic) -> None:
        self._ask = ask
        self._clock = clock
        self._said: tuple[float, object] = (clock(), "nothing was heard of the emergency stop yet")
        """The last answer and its time [s]."""
        self._is_over = threading.Event()
        self._thread = threading.Thread(target=self._listen, name="emergency stop", daemon=True)

    def read(self) -> object:
        """The last answer of the robot; a reason of our own if it is too old."""
        heard_s, said = self._said
        age_s = self._clock() - heard_s
        return said if age_s <= SILENT_S else f"nothing was heard of the emergency stop for {age_s:.1f} s"

    def look(self) -> None:
        """Ask once."""
        try:
            said = self._ask()
        except Exception as error:
            said = f"the emergency stop cannot be read: {raised(error)}"
        self._said = (self._clock(), said)

    def _listen(self) -> None:
        while not self._is_over.wait(EVERY_S):
            self.look()

    def __enter__(self) -> Heartbeat:
        self.look()
        self._thread.start()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._is_over.set()
