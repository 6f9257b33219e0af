"""Numbers with units, and how often something happens, as a sentence says them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from comity_fis import InputError
from comity_fis.unit import factor

_SHOWN = {"m": ("cm", 100.0), "deg": ("deg", 1.0), "s": ("s", 1.0), "m/s": ("m/s", 1.0)}


@dataclass(frozen=True, slots=True)
class Amount:
    """A number as it is written."""

    number: float
    unit: str | None

    def to(self, unit: str | None) -> float:
        """The number in another unit of the same quantity; one without a unit is a plain number.

        Raises:
            InputError: if they measure different things.
        """
        wanted = unit or "1"
        if wanted == "1" and self.unit is None:
            return self.number
        if wanted == "1":
            raise InputError(
                expected="a plain number", got=f"a number of {self.unit}", remedy="Leave the unit out."
            )
        return self.number * factor(self.unit or "", wanted)


@dataclass(frozen=True, slots=True)
class Times:
    """How often something may happen."""

    limit: Literal["at_least", "at_most", "exactly"]
    count: int

    def holds(self, count: int) -> bool:
        """Whether so often is right."""
        if self.limit == "at_least":
            return count >= self.count
        return count <= self.count if self.limit == "at_most" else count == self.count

    def __str__(self) -> str:
        return f"{self.limit.replace('_', ' ')} {times(self.count)}"


AT_LEAST_ONCE = Times("at_least", 1)
NEVER = Times("exactly", 0)


def times(count: int) -> str:
    """`once`, `twice`, `3 times`."""
    return {0: "never", 1: "once", 2: "twice"}.get(count, f"{count} times")


def told(value: float | str, unit: str | None) -> str:
    """A value with its unit, as findings say it: metres to the millimetre."""
    if isinstance(value, str):
        return value
    if unit in (None, "1"):
        return f"{value:g}"
    digits = {"m": 3, "s": 2, "deg": 1}.get(unit or "", 3)
    return f"{round(value, digits) + 0.0:.{digits}f} {unit}"


def apart(difference: float, unit: str | None) -> str:
    """How far two values are apart: metres in centimetres."""
    shown, scale = _SHOWN.get(unit or "", (unit or "", 1.0))
    size = abs(difference) * scale
    number = f"{size:.0f}" if size >= 100 else f"{size:.3g}"
    return f"{number} {shown}".strip()
