"""Bounds on a metric of the run or of a visit, or on a parameter of a person."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar

from comity.testing.amounts.amount import Bounds
from comity.testing.amounts.quantity import NoQuantity, quantities, require_sensible
from comity.testing.expectation import Expectation, Finding

if TYPE_CHECKING:
    from comity.episode import Episode


@dataclass(frozen=True, slots=True)
class MetricBounds(Expectation):
    """A closed interval for a metric or parameter."""

    RULE: ClassVar[str] = "NAME [_OF NAME] _IS? bounds"
    EXAMPLE: ClassVar[str] = "min_clearance at least 45 cm"

    quantity: str
    person: str | None
    """None for every person to visit, or for a metric of the run."""
    bounds: Bounds

    def __post_init__(self) -> None:
        require_sensible(self.quantity, self.person, self.bounds)

    def judge(self, episode: Episode) -> Iterator[Finding]:
        """Every number outside the bounds, and every person without a number."""
        for found in quantities(episode, self.quantity, self.person):
            if isinstance(found, NoQuantity):
                yield Finding(f"{found.name} {self.bounds.told(found.unit)}", found.got, found.because)
            elif not self.bounds.holds(found.number, found.unit):
                note = f" {found.at}" if found.at else ""
                yield Finding(
                    f"{found.name} {self.bounds.told(found.unit, found.number)}",
                    self.bounds.missed_by(found.number, found.unit, note),
                    tuple(found.because()),
                )
