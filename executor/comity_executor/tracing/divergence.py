"""Divergence of two runs: the first event in which they differ, and why."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import zip_longest

from comity_executor.nodes.cause import Cause
from comity_executor.tracing.history import History
from comity_executor.tracing.trace import TraceEvent

_TICK_SHARE = 1e-6
"""Times are rounded to a millionth."""


@dataclass(frozen=True, slots=True)
class Divergence:
    """The first difference between two traces."""

    t: float
    """Time of divergence: that of the earlier event [s]."""
    one: TraceEvent | None
    """Event of the first run; None if it had ended."""
    other: TraceEvent | None
    causes: tuple[tuple[Cause | None, Cause | None], ...]
    """The links in which the two chains of causes differ, nearest first, side by side."""

    @property
    def in_behaviour(self) -> bool:
        """Whether the runs did other things or at another time; else only the numbers behind them differ."""
        return _done(self.one) != _done(self.other)


def first_divergence(one: History, other: History, *, in_behaviour: bool = False) -> Divergence | None:
    """The first event in which two runs differ; None where there is none.

    Args:
        one: A run.
        other: Another one.
        in_behaviour: Look for a difference in what was done, and when; numbers behind it may differ before.
    """
    for place, (mine, theirs) in enumerate(zip_longest(one.events, other.events)):
        if (_done(mine) != _done(theirs)) if in_behaviour else (mine != theirs):
            t = min(event.t for event in (mine, theirs) if event)
            return Divergence(t, mine, theirs, _differing(one, other, place))
    return None


def _done(event: TraceEvent | None) -> tuple[object, ...] | None:
    return (round(event.t / _TICK_SHARE), event.node, event.status, event.halt) if event else None


def _differing(one: History, other: History, place: int) -> tuple[tuple[Cause | None, Cause | None], ...]:
    """Links that differ in the chains behind an event, or, where it has none, behind the last before it."""
    for i in range(place, -1, -1):
        mine, theirs = (h.events[i].because if i < len(h.events) else () for h in (one, other))
        pairs = tuple((a, b) for a, b in zip_longest(mine, theirs) if a != b)
        if pairs:
            return pairs
    return ()
