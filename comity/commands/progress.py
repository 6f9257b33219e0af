"""A line that moves while a plan is made or an episode runs; only where somebody looks at a terminal."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING

from comity.report.text import console

if TYPE_CHECKING:
    from comity.episode import Progress


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
def watching(start: str, *, quiet: bool) -> Iterator[Callable[[Progress], None] | None]:
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
