"""Simulated time: it advances in control ticks and depends on no other clock."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(slots=True)
class Clock:
    """Counts ticks, so that rounding errors do not accumulate."""

    hz: int
    tick: int = 0

    @property
    def now_s(self) -> float:
        """Time since the start [s]."""
        return self.tick / self.hz

    @property
    def step_s(self) -> float:
        """Length of a tick [s]."""
        return 1.0 / self.hz
