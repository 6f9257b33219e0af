"""Ctrl-C and SIGTERM as an exception, so that everything is cleaned up on the way out.

It imports very little, so that it is active before other modules are imported.
"""

from __future__ import annotations

import signal
import sys
from collections.abc import Iterator
from contextlib import contextmanager

STOPS = (signal.SIGINT, signal.SIGTERM)


class Stopped(SystemExit):
    """The user stopped the program; the exit code is 128 plus the signal's number, as in shells.

    A `SystemExit`, because code that converts `KeyboardInterrupt`, such as the command line's library, lets
    it through.
    """


def is_stop(error: BaseException | None) -> bool:
    """Whether an exception is `Stopped`, or was converted from it on the way."""
    return error is not None and (isinstance(error, Stopped) or is_stop(error.__cause__))


@contextmanager
def stoppable() -> Iterator[None]:
    """Make both signals raise `Stopped`, for a whole program; further signals do not disturb the cleanup.

    If a signal came, any exception that leaves the program becomes `Stopped`: Python 3.11 converts exceptions
    in `__set_name__` to `RuntimeError`. A signal ignored by the caller stays ignored.
    """
    raised: list[Stopped] = []

    def stop(number: int, _: object) -> None:
        """Raise once only: `timeout` sends SIGTERM to a process and then to its group."""
        if number == signal.SIGTERM:
            signal.signal(number, signal.SIG_IGN)
        raised.append(Stopped(128 + number))
        raise raised[-1]

    for number in STOPS:
        if signal.getsignal(number) != signal.SIG_IGN:
            signal.signal(number, stop)
    try:
        yield
    except BaseException:
        if not raised:
            raise
        print("comity: interrupted", file=sys.stderr)
        raise raised[0] from None
    finally:
        for number in STOPS:
            signal.signal(number, signal.SIG_IGN)
