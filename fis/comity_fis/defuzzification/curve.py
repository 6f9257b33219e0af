"""Desirability: how suitable each value of a parameter is for one person.

It is the aggregated output set of the inference, the paper's third reason for fuzzy logic (Bruno et al.
2017). A numeric parameter has a `Curve` over its domain, a nominal one a `Choice` over its categories.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Protocol

Point = tuple[float, float]
"""A value, in the parameter's unit, and its desirability."""


class Curve(Protocol):
    """Desirability over an interval; memberships are in [0, 1], and 0 outside the domain."""

    @property
    def domain(self) -> tuple[float, float]:
        """The interval, in the parameter's unit."""
        ...

    def __call__(self, x: float) -> float:
        """The desirability of one value."""
        ...

    def height(self, low: float, high: float) -> float:
        """The largest desirability in [low, high]; 0 where that lies outside the domain."""
        ...

    def centroid(self, low: float, high: float) -> float | None:
        """The centre of area over [low, high]; None where there is no area."""
        ...

    def sample(self, n: int = 101) -> tuple[Point, ...]:
        """The curve at `n` evenly spaced values, both ends of the domain among them."""
        ...

    @property
    def outline(self) -> tuple[Point, ...]:
        """Points that straight lines join to the curve: its corners where it is made of straight lines.

        A jump has two points at the same value. A curved set is given by 101 points.
        """
        ...


@dataclass(frozen=True, slots=True)
class Choice:
    """Desirability over categories."""

    memberships: Mapping[str, float]
    """Every permitted category with its desirability in [0, 1]."""

    def __call__(self, category: str) -> float:
        """The desirability of one category; 0 where it is unknown or not permitted."""
        return self.memberships.get(category, 0.0)
