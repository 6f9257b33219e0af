"""A time after which a block of code is left, whatever it does: unified-planning's reader knows no limit."""

from __future__ import annotations

import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType

AGAIN_S = 0.5
"""So long after the first time it is said again, where an exception got lost, as in a finalizer."""


class Overdue(BaseException):
    """The time is over; no `except Exception` of a library holds it up."""


@contextmanager
def overdue_after(seconds: float) -> Iterator[None]:
    """Raise `Overdue` inside the block when its time is over.

    Only in the main thread, and only where the system has timers: on Windows the block goes on.

    Args:
        seconds: Wall-clock time, > 0.
    """
    if not hasattr(signal, "setitimer") or threading.current_thread() is not threading.main_thread():
        yield
        return

    def leave(_: int, __: FrameType | None) -> None:
        raise Overdue

    before = signal.signal(signal.SIGALRM, leave)
    try:
        signal.setitimer(signal.ITIMER_REAL, seconds, AGAIN_S)
        yield
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0.0)
        signal.signal(signal.SIGALRM, before)
