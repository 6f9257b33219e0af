"""Order between two values: whether what a rulebook says goes the way that was measured.

Where a study reports only which of two groups was larger, order is all that a rulebook can be held to.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from comity_fis.record import Record
from comity_fis.variables.parameter import NumericParameter

Verdict = Literal["agreeing", "contradicting", "equal"]
"""equal: a difference was found, and the rulebook makes none."""

BAND_M = 0.01
"""Two distances that differ by no more count as equal (our choice): about what a robot can hold."""
BAND_SHARE = 0.01
"""The same of any other parameter, as a share of what its rules can give (our choice)."""
ROUNDING = 1e-9
"""Of the band: 0.66 - 0.65 is not above 0.01."""


@dataclass(frozen=True, slots=True)
class OrderCounts(Record):
    """How many pairs went which way."""

    agreeing: int
    contradicting: int
    equal: int
    """Pairs of which a difference was found, and the rulebook makes none."""

    @property
    def pairs(self) -> int:
        """All of them."""
        return self.agreeing + self.contradicting + self.equal

    def __add__(self, other: OrderCounts) -> OrderCounts:
        return OrderCounts(
            self.agreeing + other.agreeing,
            self.contradicting + other.contradicting,
            self.equal + other.equal,
        )


def counted(verdicts: Iterable[Verdict]) -> OrderCounts:
    """How often each verdict came."""
    said = list(verdicts)
    return OrderCounts(said.count("agreeing"), said.count("contradicting"), said.count("equal"))


def equality_band(parameter: NumericParameter) -> float:
    """The largest difference, in the parameter's unit, that counts as none."""
    return BAND_M if parameter.unit == "m" else BAND_SHARE * (parameter.rules.high - parameter.rules.low)


def direction(difference: float, band: float) -> int:
    """1 or -1 for a difference beyond the band, 0 within it."""
    if abs(difference) <= band * (1 + ROUNDING):
        return 0
    return 1 if difference > 0 else -1


def directions(differences: NDArray[np.float64], band: float) -> NDArray[np.float64]:
    """The same of many."""
    return np.sign(differences) * (np.abs(differences) > band * (1 + ROUNDING))


def verdict(found: int, predicted: float, band: float) -> Verdict:
    """How a predicted difference stands to the direction that was found.

    Args:
        found: 1, -1, or 0 where the study found both alike.
        predicted: The rulebook's difference, in the same sense.
        band: In the same unit, what counts as no difference.
    """
    said = direction(predicted, band)
    if said == found:
        return "agreeing"
    return "equal" if said == 0 else "contradicting"
