"""Simulated time: it advances in control ticks and knows no other clock."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(slots=True)
class Clock:
    """Counts ticks, so that time has no rounding to pile up."""

    hz: int
    tick: int = 0

    @property
    def now_s(self) -> float:
        """Since the start."""
        return self.tick / self.hz

    @property
    def step_s(self) -> float:
        """The length of a tick."""
        return 1.0 / self.hz
