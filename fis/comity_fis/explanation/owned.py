"""Who owns what of an aggregated output set: rules by their terms, and what belongs to them.

A rule's output set is its term cut off at its strength. Where several rules attain the same degree they own
what is there together: two terms cut at one height, or two rules for one term below the weaker one's
strength.
"""

from __future__ import annotations

from bisect import bisect_left, bisect_right
from dataclasses import dataclass, field
from operator import neg
from typing import NamedTuple

from comity_fis.membership.function import NumericMembership

Owner = tuple[int, int]
"""The number of a group, and how many of its rules, the strongest first."""

Part = tuple[tuple[Owner, ...], float, float, tuple[float, float] | None]
"""Something that the same rules own, in one stretch or several: its owners, its area, its moment about 0; and
from where to where, where their strength is the height."""


class Piece(NamedTuple):
    """A stretch of the output's range over which the same rules attain the maximum."""

    left: float
    right: float
    degrees: tuple[float, float]
    """Just inside both ends."""
    area: float
    moment: float
    """About 0: the integral of `x mu(x)`."""
    owners: tuple[Owner, ...]
    """One, or several groups that share it; none where the aggregated set is 0."""
    flat: bool
    """Whether the owners' strength is the height here, and not the slope of their term."""

    @property
    def part(self) -> Part:
        """The piece without its outline."""
        return self.owners, self.area, self.moment, (self.left, self.right) if self.flat else None


@dataclass(frozen=True, slots=True)
class Group:
    """The strengths above 0 of all rules that give one term."""

    term: NumericMembership
    strengths: tuple[float, ...]
    """The largest first."""
    levels: tuple[float, ...] = field(init=False)
    """The different ones, ascending."""

    def __post_init__(self) -> None:
        levels = tuple(sorted(set(self.strengths))) if len(self.strengths) > 1 else self.strengths
        object.__setattr__(self, "levels", levels)

    @property
    def height(self) -> float:
        """Where the term is cut off."""
        return self.strengths[0]

    def reaching(self, degree: float) -> int:
        """How many of the rules reach a degree that the term itself allows."""
        if degree <= self.levels[0]:
            return len(self.strengths)
        return bisect_right(self.strengths, -degree, key=neg)

    def between(self, low: float, high: float) -> tuple[float, ...]:
        """The strengths that lie between two degrees."""
        return self.levels[bisect_right(self.levels, low) : bisect_left(self.levels, high)]
