"""The centre of area of clipped trapezoids in closed form, as polynomials of the clipping heights.

If only neighbouring terms overlap, their maximum is their sum minus the overlaps of neighbours. Each term and
each overlap is a stack of alpha-cuts [left, right] whose ends are linear in the height, so area and moment
are polynomials: no search for corners, no branches, and the same code serves scalars and columns. Singletons
have no area: each counts by its height, like a stack of alpha-cuts of width 1.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from itertools import pairwise
from operator import itemgetter
from typing import TYPE_CHECKING, Literal, TypeVar

from comity_fis.membership.function import NumericMembership, Singleton, Trapezoid
from comity_fis.membership.interval import Interval
from comity_fis.rules.methods import MAMDANI, Methods

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Height = TypeVar("Height", float, NDArray[np.float64])
else:
    Height = TypeVar("Height")


# Plain tuples: every inference unpacks them, and named tuples take twice as long.

Stack = tuple[float, float, float, float, float]
"""Coefficients a1, a2, m1, m2, m3 of the alpha-cuts from 0 to a height h: area h (a1 + a2 h) and moment h (m1
+ h (m2 + h m3))."""

Overlap = tuple[str, str, float, Stack]
"""Overlap of two neighbouring terms: alpha-cuts up to the lower of their heights, at most up to the peak.

The left term and the right one; the peak, where their edges cross, in (0, 1]; the alpha-cuts.
"""


@dataclass(frozen=True, slots=True)
class ClosedForm:
    """The terms of one parameter in closed form."""

    low: float
    """Start of the range, about which moments are taken."""
    high: float
    stacks: tuple[tuple[str, Stack], ...]
    """Alpha-cut stacks by term, from left to right."""
    overlaps: tuple[Overlap, ...]

    def centre(self, strengths: Mapping[str, float]) -> float | None:
        """Centre of area of the terms, clipped at their strengths; None if there is no area."""
        area, moment = self.area_and_moment(strengths, min)
        if not area > 0:
            return None
        centre = self.low + moment / area
        return centre if self.low <= centre <= self.high else min(max(centre, self.low), self.high)

    def area_and_moment(
        self,
        heights: Mapping[str, Height],
        smallest: Callable[[tuple[Height, Height, float]], Height],
    ) -> tuple[Height | float, Height | float]:
        """Area, and moment about `low`.

        Args:
            heights: Clipping heights by term: numbers in [0, 1] or columns; missing terms are concluded by no
                rule.
            smallest: The minimum of several heights.
        """
        # Inclusion and exclusion: where only neighbours overlap, max(A, B) = A + B - min(A, B), and no
        # point is in three terms. A term cut at height h is the stack of its alpha-cuts up to h, and the
        # overlap of two neighbours is the stack up to the lower of both heights, at most up to where their
        # edges cross. The ends of a cut are linear in its height, so area and moment are integrals of
        # polynomials: Mamdani's centre of area (Mamdani and Assilian 1975) is exact, without samples, and
        # the same lines serve a column.
        area: Height | float = 0.0
        moment: Height | float = 0.0
        for name, (a1, a2, m1, m2, m3) in self.stacks:
            if name in heights:
                h = heights[name]
                area += h * (a1 + a2 * h)
                moment += h * (m1 + h * (m2 + h * m3))
        for left, right, peak, (a1, a2, m1, m2, m3) in self.overlaps:
            if left in heights and right in heights:
                h = smallest((heights[left], heights[right], peak))
                area -= h * (a1 + a2 * h)
                moment -= h * (m1 + h * (m2 + h * m3))
        return area, moment


def closed_form(
    terms: Mapping[str, NumericMembership], domain: Interval, methods: Methods = MAMDANI
) -> ClosedForm | None:
    """The closed form of a parameter's terms.

    None for methods other than min, max and centroid (singletons: other than centroid), for curved terms, and
    if more than neighbours overlap. Terms that are 0 everywhere in the domain are ignored.
    """
    if methods.defuzzification != "centroid":
        return None
    inside = {name: term for name, term in terms.items() if _part(term, domain) != "nothing"}
    if inside and all(_part(term, domain) == "place" for term in inside.values()):
        return _of_singletons({name: domain.clamp(term.knots[0]) for name, term in inside.items()}, domain)
    if (methods.implication, methods.aggregation) != ("min", "max"):
        return None
    return _of_trapezoids(inside, domain)


def _of_trapezoids(terms: Mapping[str, NumericMembership], domain: Interval) -> ClosedForm | None:
    """None where one is no trapezoid, an end of the domain cuts through an edge, or more overlap."""
    shapes: list[tuple[Trapezoid, str]] = []
    for name, term in terms.items():
        shape = _within(term, domain) if isinstance(term, Trapezoid) else None
        if shape is None:
            return None
        shapes.append((shape, name))
    shapes.sort(key=lambda shape: shape[0].knots)
    ordered, names = [shape for shape, _ in shapes], [name for _, name in shapes]
    if any(far.a < near.d for near, far in zip(ordered, ordered[2:], strict=False)):
        return None
    overlaps: list[Overlap] = []
    for i, (left, right) in enumerate(pairwise(ordered)):
        if right.a < left.d:
            if any(x > y for x, y in zip(left.knots, right.knots, strict=True)):
                return None  # one inside the other
            overlaps.append((names[i], names[i + 1], *_overlap(left, right, domain.low)))
    return ClosedForm(
        low=domain.low,
        high=domain.high,
        stacks=tuple((name, _stack(s.a, s.b - s.a, s.d, s.d - s.c, domain.low)) for s, name in shapes),
        overlaps=tuple(overlaps),
    )


def _part(term: NumericMembership, domain: Interval) -> Literal["nothing", "place", "area"]:
    """What of a term lies inside the domain; of curves always an area."""
    if not isinstance(term, Trapezoid | Singleton):
        return "area"
    first, last = term.knots[0], term.knots[-1]
    if first < domain.high and last > domain.low and first < last:
        return "area"
    return "place" if term.height(*domain.ends) > 0 else "nothing"


def _of_singletons(places: Mapping[str, float], domain: Interval) -> ClosedForm | None:
    """None where two stand at one place: which of them counts depends on the aggregation."""
    if len(set(places.values())) < len(places):
        return None
    ordered = sorted(places.items(), key=itemgetter(1))
    return ClosedForm(
        low=domain.low,
        high=domain.high,
        stacks=tuple((name, (1.0, 0.0, x - domain.low, 0.0, 0.0)) for name, x in ordered),
        overlaps=(),
    )


def _within(term: Trapezoid, domain: Interval) -> Trapezoid | None:
    """The term without what lies outside the domain; None where an end of it cuts through an edge.

    An end may cut through the top, or pass through a peak: a triangle is then half of one.
    """
    a, b, c, d = term.knots
    if a < domain.low:
        if not b <= domain.low <= c:
            return None
        a = b = domain.low
    if d > domain.high:
        if not b <= domain.high <= c:
            return None
        c = d = domain.high
    return Trapezoid(a, b, c, d) if a < d else None


def _stack(left: float, rise: float, right: float, fall: float, origin: float) -> Stack:
    """Alpha-cuts [left + rise h, right - fall h], their moment about the origin."""
    left, right = left - origin, right - origin
    a1, a2 = right - left, -(rise + fall) / 2
    m1, m2 = (right * right - left * left) / 2, -(right * fall + left * rise) / 2
    return a1, a2, m1, m2, (fall * fall - rise * rise) / 6


def _overlap(left: Trapezoid, right: Trapezoid, origin: float) -> tuple[float, Stack]:
    """The peak, and alpha-cuts from the right one's rising edge to the left one's falling edge."""
    rise, fall = right.b - right.a, left.d - left.c
    shared = left.d - right.a
    peak = 1.0 if shared >= rise + fall else shared / (rise + fall)
    return peak, _stack(right.a, rise, left.d, fall, origin)
