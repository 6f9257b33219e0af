"""How far something is, on standard error: a line that moves where a person looks at a terminal."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
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

    Without a terminal, as in the log of a cluster, with a line each half a minute.

    Args:
        missing: Episodes that are to be carried out.
        total: All episodes of the study.
        quiet: Say nothing, wherever the output goes.
    """
    out, begin_s = console(to_errors=True), monotonic()
    ended, told_s = 0, begin_s

    def text() -> str:
        took_s = max(monotonic() - begin_s, 1e-3)
        rate = ended / took_s
        left = f", {duration_text((missing - ended) / rate)} left" if ended else ""
        return f"{total - missing + ended} of {total} episodes, {rate:.1f} a second{left}"

    def count(more: int) -> None:
        nonlocal ended, told_s
        ended += more
        if status is not None:
            status.update(text())
        elif not quiet and monotonic() - told_s >= EVERY_S:
            told_s = monotonic()
            _line(text())

    if quiet or not out.is_terminal:
        status = None
        yield count
        return
    with out.status(text()) as status:
        yield count


EVERY_S = 30.0
"""Between two lines in a log."""


def _line(text: str) -> None:
    """Write a line in one piece: what `print` does, the line and then its end, Ctrl-C may part."""
    sys.stderr.write(f"{text}\n")
    sys.stderr.flush()
