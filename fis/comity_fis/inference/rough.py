"""Imprecise inputs: an interval, a fuzzy set of numbers, or categories with degrees.

Such an input is a fuzzy set A, and a term holds to its possibility given A: the maximum of min(term, A) over
the domain (Zadeh 1978). An undisclosed value is the case in which A is 1 everywhere.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise

from comity_fis.listing import listed
from comity_fis.membership.function import Categories, Membership
from comity_fis.membership.interval import Interval
from comity_fis.membership.turns import Function, extreme, turning_places
from comity_fis.rules.antecedent import Literal, hedged


@dataclass(frozen=True, slots=True)
class RoughNumber:
    """A fuzzy set of numbers, restricted to its variable's domain."""

    given: Interval | Membership
    low: float
    high: float

    def possibility(self, term: Membership, literal: Literal) -> float:
        """Degree of a literal on the variable, given the membership function of its term."""

        def degree(x: float) -> float:
            return hedged(term(x), literal)

        if isinstance(self.given, Interval):
            return largest_of_smallest([degree], term.knots, self.low, self.high)
        knots = (*term.knots, *self.given.knots)
        return largest_of_smallest([degree, self.given], knots, self.low, self.high)

    def as_json(self) -> object:
        """An interval as its two ends; any other fuzzy set in words."""
        return list(self.given.ends) if isinstance(self.given, Interval) else str(self.given)

    def __str__(self) -> str:
        return str(self.given)


@dataclass(frozen=True, slots=True)
class RoughWord:
    """Categories with their degrees of possibility."""

    given: Mapping[str, float]

    def possibility(self, term: Categories, literal: Literal) -> float:
        """Degree of a literal on the variable, given the categories of its term."""
        return max(min(hedged(term(category), literal), degree) for category, degree in self.given.items())

    def as_json(self) -> object:
        """Categories with their degrees."""
        return dict(self.given)

    def __str__(self) -> str:
        return listed((f"{category} ({degree:g})" for category, degree in self.given.items()), "or")


Rough = RoughNumber | RoughWord
Stated = float | str | RoughNumber | RoughWord
"""The kinds of input of a variable."""


def largest_of_smallest(
    functions: Sequence[Function], knots: Sequence[float], low: float, high: float
) -> float:
    """The largest value over [low, high] of the smallest of the functions, to 1e-12 of a gap between knots.

    Between its extremes each function is monotone, and the minimum of monotone functions has one peak.
    """
    # The possibility of a term is sup min(term, A) (Zadeh 1978). A grid would miss the peak of a narrow
    # set, and the error would reach the parameter, so the domain is cut where any function has a knot or
    # turns. On each piece every function is monotone; the smallest of rising functions rises, that of
    # falling ones falls, and so the minimum rises, then falls: it has one peak, which a search for one
    # extreme finds to rounding. The supremum is the largest of these peaks. An undisclosed input needs no
    # search: A is 1 everywhere, and every term holds to degree 1.
    places: Sequence[float] = sorted({low, *(x for x in knots if low < x < high), high})
    for function in functions:
        places = turning_places(function, places)

    def smallest(x: float) -> float:
        return min(function(x) for function in functions)

    peaks = (extreme(smallest, 1, left, right) for left, right in pairwise(places))
    return max(smallest(x) for x in (*places, *peaks))
