"""Order agreement: whether predicted differences have the measured sign.

If a study reports only which of two groups was larger, order is all that can be tested.
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
"""equal: a difference was measured, but the rulebook predicts none."""

BAND_M = 0.01
"""Distances that differ by no more than this count as equal [m] (our choice): about a robot's precision."""
BAND_SHARE = 0.01
"""The same for other parameters, as a share of the range that their rules can give (our choice)."""
ROUNDING = 1e-9
"""Rounding tolerance of the band: 0.66 - 0.65 is not above 0.01."""


@dataclass(frozen=True, slots=True)
class OrderCounts(Record):
    """Number of pairs by verdict."""

    agreeing: int
    contradicting: int
    equal: int
    """Pairs with a measured difference for which the rulebook predicts none."""

    @property
    def pairs(self) -> int:
        """Total number of pairs."""
        return self.agreeing + self.contradicting + self.equal

    def __add__(self, other: OrderCounts) -> OrderCounts:
        return OrderCounts(
            self.agreeing + other.agreeing,
            self.contradicting + other.contradicting,
            self.equal + other.equal,
        )


def counted(verdicts: Iterable[Verdict]) -> OrderCounts:
    """Count the verdicts."""
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
    """`direction` for an array."""
    return np.sign(differences) * (np.abs(differences) > band * (1 + ROUNDING))


def verdict(found: int, predicted: float, band: float) -> Verdict:
    """Compare a predicted difference with the measured direction.

    Args:
        found: 1, -1, or 0 if the study found no difference.
        predicted: The rulebook's difference, with the same sign convention.
        band: Largest difference that counts as none, in the same unit.
    """
    said = direction(predicted, band)
    if said == found:
        return "agreeing"
    return "equal" if said == 0 else "contradicting"
