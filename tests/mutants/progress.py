"""How far a run is: lines on standard error, also from the processes that it starts."""

from __future__ import annotations

import sys
from collections.abc import Iterator, Sequence
from typing import TypeVar

T = TypeVar("T")


def say(text: str) -> None:
    """What is done now."""
    print(text, file=sys.stderr, flush=True)


def counted(what: str, things: Sequence[T], every: int = 1) -> Iterator[T]:
    """The things one by one, each n-th with a line before it that says which it is, of how many."""
    for i, thing in enumerate(things):
        if i % every == 0:
            say(f"{what} {i + 1} of {len(things)}: {thing}")
        yield thing
