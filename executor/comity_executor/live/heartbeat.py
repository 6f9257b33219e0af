"""The stop as a robot in real time is asked for it: by a thread of its own, so that silence is noticed.

A call that does not return would hold up the tick that makes it, and the stop would not be seen. Here the
tick reads what was said last, and when that is too long ago the stop counts as pressed.
"""

from __future__ import annotations

import threading
import time
from collections.abc import Callable
from types import TracebackType

from comity_executor.robots.raised import raised

SILENT_S = 0.5
"""A stop of which nothing was heard for so long is pressed (our choice)."""
EVERY_S = 0.02


class Heartbeat:
    """Asks a robot for its stop all the while; give `read` to an `Execution` as its `emergency`.

    Args:
        ask: The robot's `emergency`. It is called in another thread than the robot's other calls.
        clock: Seconds that never run backwards.
    """

    def __init__(self, ask: Callable[[], object], *, clock: Callable[[], float] = time.monotonic) -> None:
        self._ask = ask
        self._clock = clock
        self._said: tuple[float, object] = (clock(), "nothing was heard of the emergency stop yet")
        """What was said last, and when."""
        self._is_over = threading.Event()
        self._thread = threading.Thread(target=self._listen, name="emergency stop", daemon=True)

    def read(self) -> object:
        """What the robot said last; a reason of our own where that is too long ago."""
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
