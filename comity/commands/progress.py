"""How far something is, on standard error: a line that moves where a person looks at a terminal."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from itertools import count as count_from
from time import monotonic
from typing import TYPE_CHECKING

from comity.report.text import console, duration_text

if TYPE_CHECKING:
    from comity.live_episode import EpisodeProgress


@contextmanager
def waiting(text: str, *, quiet: bool = False) -> Iterator[None]:
    """Show on standard error that something goes on.

    Args:
        text: What.
        quiet: Say nothing, wherever the output goes.
    """
    out = console(to_errors=True)
    if quiet or not out.is_terminal:
        yield
        return
    with out.status(text):
        yield


@contextmanager
def watching(start: str, *, quiet: bool) -> Iterator[Callable[[EpisodeProgress], None] | None]:
    """Show how far an episode is, on standard error.

    Args:
        start: What to say before the world moves.
        quiet: Say nothing, wherever the output goes.
    """
    out = console(to_errors=True)
    if quiet or not out.is_terminal:
        yield None
        return
    with out.status(start) as status:
        yield lambda progress: status.update(
            f"{progress.doing}, {progress.simulated_s:.0f} simulated seconds"
        )


@contextmanager
def counting(*, quiet: bool) -> Iterator[Callable[[str, int], None]]:
    """Count tests as they end; without a terminal, as in the log of a build, with a line for each.

    Args:
        quiet: Say nothing, wherever the output goes.

    Yields:
        What takes the line of a test that ended, and how many tests there are.
    """
    out = console(to_errors=True)
    if quiet:
        yield lambda _text, _count: None
    elif not out.is_terminal:
        yield lambda text, _count: _line(text)
    else:
        ended = count_from(1)
        with out.status("looking for tests") as status:
            yield lambda _text, count: status.update(f"{next(ended)} of {count} tests")


@contextmanager
def rating(missing: int, total: int, *, quiet: bool) -> Iterator[Callable[[int], None]]:
    """Tell how many episodes of a study have ended, how many a second, and how long the others will take.

    Without a terminal, as in the log of a cluster, with a line at the start, at each tenth of what is missing
    and each half a minute.

    Args:
        missing: Episodes that are to be carried out.
        total: All episodes of the study.
        quiet: Say nothing, wherever the output goes.
    """
    out, rate = console(to_errors=True), EpisodeRate(missing, total)
    if quiet:
        yield lambda _more: None
    elif out.is_terminal:
        with out.status(rate.text()) as status:

            def update(more: int) -> None:
                rate.count(more, monotonic())
                status.update(rate.text())

            yield update
    else:
        _line(rate.text())
        yield lambda more: _line(rate.text()) if rate.count(more, monotonic()) else None


EVERY_S = 30.0
"""Between two lines in a log."""
PARTS = 10
"""Of what is missing; a line in a log after each."""


@dataclass(slots=True)
class EpisodeRate:
    """How fast episodes of this run end; the time until the first, when processes start, does not count."""

    missing: int
    """Episodes that this run is to carry out."""
    total: int
    ended: int = 0
    first: tuple[int, float] | None = None
    """Episodes that ended at first, and when [s]."""
    now_s: float = 0.0
    told_s: float = 0.0

    def count(self, more: int, now_s: float) -> bool:
        """Count episodes that ended; whether that is to be told in a log."""
        part = PARTS * self.ended // max(self.missing, 1)
        self.ended, self.now_s = self.ended + more, now_s
        if self.first is None and more:
            self.first, self.told_s = (self.ended, now_s), now_s
        if PARTS * self.ended // max(self.missing, 1) == part and now_s - self.told_s < EVERY_S:
            return False
        self.told_s = now_s
        return True

    def text(self) -> str:
        """`40 of 3600 episodes, 11.2 a second, 5 min left`."""
        text = f"{self.total - self.missing + self.ended} of {self.total} episodes"
        if (rate := self.per_s) is None:
            return text
        left_s = (self.missing - self.ended) / rate
        return f"{text}, {rate:.1f} a second" + (f", {duration_text(left_s)} left" if left_s else "")

    @property
    def per_s(self) -> float | None:
        """Episodes a second since the first; None before there is another."""
        if self.first is None or self.ended == self.first[0] or self.now_s <= self.first[1]:
            return None
        return (self.ended - self.first[0]) / (self.now_s - self.first[1])


def _line(text: str) -> None:
    """Write a line in one piece: what `print` does, the line and then its end, Ctrl-C may part."""
    sys.stderr.write(f"{text}\n")
    sys.stderr.flush()
