"""What a program finds at its start at a terminal, wherever the tests run."""

from __future__ import annotations

import signal
from collections.abc import Iterator
from contextlib import contextmanager

from comity.system.stopping import STOPS


@contextmanager
def signals_of_a_terminal() -> Iterator[None]:
    """Also where the tests run in the background of a shell, which has its children ignore Ctrl-C."""
    before = [signal.getsignal(number) for number in STOPS]
    for number, handler in zip(STOPS, (signal.default_int_handler, signal.SIG_DFL), strict=True):
        signal.signal(number, handler)
    try:
        yield
    finally:
        for number, handler in zip(STOPS, before, strict=True):
            signal.signal(number, handler)
