"""A closed interval of numbers."""

from __future__ import annotations

from dataclasses import dataclass

from comity_fis.errors import WrongValueError


@dataclass(frozen=True, slots=True)
class Interval:
    """All numbers from `low` to `high`, both included; the ends may be infinite."""

    low: float
    high: float

    def __post_init__(self) -> None:
        if not self.low < self.high:
            raise WrongValueError(expected="a range whose first end is below its second", got=self)

    def __contains__(self, x: float) -> bool:
        return self.low <= x <= self.high

    def __str__(self) -> str:
        return f"{self.low:g}..{self.high:g}"

    @property
    def ends(self) -> tuple[float, float]:
        """Low and high as a tuple."""
        return self.low, self.high

    def clamp(self, x: float) -> float:
        """The nearest number in the interval."""
        return min(max(x, self.low), self.high)

    def covers(self, other: Interval) -> bool:
        """Whether the interval contains `other`."""
        return self.low <= other.low and other.high <= self.high
