"""Ctrl-C and SIGTERM as an exception: whatever was begun is ended properly on its way out.

It imports next to nothing, so that it is there before everything else is imported.
"""

from __future__ import annotations

import signal
import sys
from collections.abc import Iterator
from contextlib import contextmanager

STOPS = (signal.SIGINT, signal.SIGTERM)


class Stopped(SystemExit):
    """A person ends the program: it leaves with 128 and the signal's number, as shells have it.

    A `SystemExit`, because what makes of `KeyboardInterrupt` something else, such as the command line's
    library, lets that through.
    """


def is_stop(error: BaseException | None) -> bool:
    """Whether it is `Stopped`, or what something on its way has made of it."""
    return error is not None and (isinstance(error, Stopped) or is_stop(error.__cause__))


@contextmanager
def stoppable() -> Iterator[None]:
    """For a whole program: both signals raise `Stopped` inside, and nothing disturbs its last moments.

    What leaves the program after that is `Stopped`, whatever became of it on its way: Python 3.11 makes a
    `RuntimeError` of all that comes up while a class is told the names of its attributes. A signal that
    the caller had it ignore stays ignored.
    """
    raised: list[Stopped] = []

    def stop(number: int, _: object) -> None:
        """Only once for SIGTERM: `timeout` sends it to a process and to its group, one after the other."""
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
