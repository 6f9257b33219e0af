"""The centre of area of cut trapezoids as polynomials of the heights at which they are cut.

Where only neighbours overlap, the largest of the terms is their sum less the overlaps of neighbours. Each
term and each overlap is a stack of alpha-cuts [left, right] whose ends move linearly with the height, so that
its area and its moment are polynomials: no search for corners, nothing to branch on, and the same lines serve
one number and a whole column of them.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING, NamedTuple, TypeVar

from comity_fis.interval import Interval
from comity_fis.membership import NumericMembership, Trapezoid

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Height = TypeVar("Height", float, NDArray[np.float64])
else:
    Height = TypeVar("Height")


class Stack(NamedTuple):
    """Alpha-cuts from 0 up to a height h: area h (a1 + a2 h), moment h (m1 + h (m2 + h m3))."""

    a1: float
    a2: float
    m1: float
    m2: float
    m3: float


class Overlap(NamedTuple):
    """What two neighbours share: alpha-cuts up to the lower of their heights, at most up to the peak."""

    left: int
    """The number of the left one of the two terms; the right one is the next."""
    peak: float
    """Where their edges cross, in (0, 1]."""
    stack: Stack


@dataclass(frozen=True, slots=True)
class ClosedForm:
    """The terms of one parameter, from left to right."""

    low: float
    """Where the range starts: moments are taken about it."""
    high: float
    names: tuple[str, ...]
    stacks: tuple[Stack, ...]
    overlaps: tuple[Overlap, ...]

    def centre(self, strengths: Mapping[str, float]) -> float | None:
        """The centre of area of the terms, cut at their strengths; None where there is no area."""
        area, moment = self.area_and_moment([strengths.get(name, 0.0) for name in self.names], min)
        return min(max(self.low + moment / area, self.low), self.high) if area > 0 else None

    def area_and_moment(
        self, heights: Sequence[Height], smaller: Callable[[Height, Height | float], Height]
    ) -> tuple[Height, Height]:
        """Area, and moment about `low`.

        Args:
            heights: Of every term in the order of `names`: numbers in [0, 1], or columns of them.
            smaller: The minimum of two heights.
        """
        area = moment = heights[0] * 0.0
        for (a1, a2, m1, m2, m3), h in zip(self.stacks, heights, strict=True):
            area = area + h * (a1 + a2 * h)
            moment = moment + h * (m1 + h * (m2 + h * m3))
        for left, peak, (a1, a2, m1, m2, m3) in self.overlaps:
            h = smaller(smaller(heights[left], heights[left + 1]), peak)
            area = area - h * (a1 + a2 * h)
            moment = moment - h * (m1 + h * (m2 + h * m3))
        return area, moment


def closed_form(terms: Mapping[str, NumericMembership], domain: Interval) -> ClosedForm | None:
    """The closed form of a parameter's terms; None where one is curved or not only neighbours overlap."""
    shapes: list[tuple[Trapezoid, str]] = []
    for name, term in terms.items():
        shape = _within(term, domain) if isinstance(term, Trapezoid) else None
        if shape is None:
            return None
        shapes.append((shape, name))
    shapes.sort(key=lambda shape: shape[0].knots)
    ordered = [shape for shape, _ in shapes]
    if any(far.a < near.d for near, far in zip(ordered, ordered[2:], strict=False)):
        return None
    overlaps: list[Overlap] = []
    for i, (left, right) in enumerate(pairwise(ordered)):
        if right.a < left.d:
            if any(x > y for x, y in zip(left.knots, right.knots, strict=True)):
                return None  # one inside the other
            overlaps.append(_overlap(i, left, right, domain.low))
    return ClosedForm(
        low=domain.low,
        high=domain.high,
        names=tuple(name for _, name in shapes),
        stacks=tuple(_stack(s.a, s.b - s.a, s.d, s.d - s.c, domain.low) for s in ordered),
        overlaps=tuple(overlaps),
    )


def _within(term: Trapezoid, domain: Interval) -> Trapezoid | None:
    """The term without what lies outside the domain; None where its edge would be cut through."""
    a, b, c, d = term.knots
    if a < domain.low:
        if not b <= domain.low < c:
            return None
        a = b = domain.low
    if d > domain.high:
        if not b < domain.high <= c:
            return None
        c = d = domain.high
    return Trapezoid(a, b, c, d)


def _stack(left: float, rise: float, right: float, fall: float, origin: float) -> Stack:
    """Alpha-cuts [left + rise h, right - fall h], their moment about the origin."""
    left, right = left - origin, right - origin
    return Stack(
        a1=right - left,
        a2=-(rise + fall) / 2,
        m1=(right * right - left * left) / 2,
        m2=-(right * fall + left * rise) / 2,
        m3=(fall * fall - rise * rise) / 6,
    )


def _overlap(number: int, left: Trapezoid, right: Trapezoid, origin: float) -> Overlap:
    """Alpha-cuts from the right one's rising edge to the left one's falling edge."""
    rise, fall = right.b - right.a, left.d - left.c
    shared = left.d - right.a
    peak = 1.0 if shared >= rise + fall else shared / (rise + fall)
    return Overlap(number, peak, _stack(right.a, rise, left.d, fall, origin))
