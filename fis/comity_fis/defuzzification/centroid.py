"""The centre of area of an aggregated output set.

The set is the largest of several terms, each cut off at the strength of its rules (Mamdani's min and max).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import combinations, pairwise
from typing import NamedTuple

from comity_fis.membership.curved import Complement
from comity_fis.membership.function import NumericMembership, Trapezoid


class Cut(NamedTuple):
    """A term cut off at a strength in [0, 1]."""

    term: NumericMembership
    strength: float

    def __call__(self, x: float) -> float:
        """The degree of `x`, in [0, 1]."""
        return min(self.strength, self.term(x))


Outline = tuple[float, float, float, float, float]
"""A cut trapezoid: its four corners and its height."""

Sums = tuple[float, float]
"""An area and its moment."""

Panel = tuple[float, float, float, float, float, float]
"""A start, a middle and an end, each with its degree: two more places halve it."""

Piece = tuple[float, float, float, float]
"""A straight piece of a membership function: x0, degree0, x1, degree1."""


def exact_centroid(cuts: Sequence[Cut], low: float, high: float) -> float | None:
    """The centre of area over [low, high]; None where there is no area.

    Closed form where every term is a trapezoid or the opposite of one; to 1e-9 of the range where one is
    curved.
    """
    if not low < high:
        return None
    cuts = [cut for cut in cuts if cut.strength > 0]
    straight = [_outlines(cut, low, high) for cut in cuts]
    outlines = [outline for part in straight for outline in part]
    corners = {x for outline in outlines for x in outline[:4]}
    if all(straight):
        area, moment = _straight_area(outlines, _within(corners, low, high))
    else:
        knots = corners.union(*(cut.term.knots for cut in cuts))
        area, moment = _curved_area(lambda x: max(cut(x) for cut in cuts), _within(knots, low, high))
    return min(max(low + moment / area, low), high) if area > 0 else None


def sampled_centroid(cuts: Sequence[Cut], low: float, high: float, samples: int = 101) -> float | None:
    """MATLAB's rule: `sum(x mu) / sum(mu)` over evenly spaced samples, both ends at full weight."""
    area = moment = 0.0
    for i in range(samples):
        x = low + (high - low) * i / (samples - 1)
        degree = max((cut(x) for cut in cuts), default=0.0)
        area += degree
        moment += x * degree
    return moment / area if area > 0 else None


def _within(places: set[float], low: float, high: float) -> list[float]:
    return [low, *sorted(x for x in places if low < x < high), high]


def _outlines(cut: Cut, low: float, high: float) -> tuple[Outline, ...]:
    """A cut term as trapezoids, the largest of which it is; none where it is curved.

    The opposite of a trapezoid is two shoulders that reach to the ends of the range, or beyond.
    """
    term, height = cut
    if isinstance(term, Trapezoid):
        return (_outline(term.a, term.b, term.c, term.d, height),)
    if isinstance(term, Complement) and isinstance(term.part, Trapezoid):
        start, end = min(term.part.a, low), max(term.part.d, high)
        return (
            _outline(start, start, term.part.a, term.part.b, height),
            _outline(term.part.c, term.part.d, end, end, height),
        )
    return ()


def _outline(a: float, b: float, c: float, d: float, height: float) -> Outline:
    return a, a + height * (b - a), d - height * (d - c), d, height


def _straight_area(outlines: Sequence[Outline], places: Sequence[float]) -> tuple[float, float]:
    """Area and moment about the first place, under the largest of the outlines.

    Between two neighbouring places every outline is straight; the largest has corners only where two cross.
    """
    area = moment = 0.0
    origin = places[0]
    for x0, x1 in pairwise(places):
        lines = [line for outline in outlines if (line := _line(outline, x0, x1)) is not None]
        pieces = [(x0, lines[0][0], x1, lines[0][1])] if len(lines) == 1 else _envelope(lines, x0, x1)
        for left, degree0, right, degree1 in pieces:
            half_width = (right - left) / 2
            area += half_width * (degree0 + degree1)
            near, far = left - origin, right - origin
            moment += half_width / 3 * (degree0 * (2 * near + far) + degree1 * (near + 2 * far))
    return area, moment


def _line(outline: Outline, x0: float, x1: float) -> tuple[float, float] | None:
    """The outline's degrees just inside both ends of [x0, x1], which has none of its corners inside.

    None where it is 0. A vertical edge makes the degree at a corner ambiguous: the side towards the middle
    counts.
    """
    a, b, c, d, height = outline
    middle = (x0 + x1) / 2
    if middle <= a or middle >= d:
        return None
    if middle < b:
        slope = height / (b - a)
        return slope * (x0 - a), slope * (x1 - a)
    if middle > c:
        slope = height / (d - c)
        return slope * (d - x0), slope * (d - x1)
    return height, height


def _envelope(lines: Sequence[tuple[float, float]], x0: float, x1: float) -> list[Piece]:
    """The largest of several straight lines over [x0, x1], piece by piece; nothing where there is no line."""
    if not lines:
        return []
    crossings = {
        (p0 - q0) / (p0 - q0 - p1 + q1)
        for (p0, p1), (q0, q1) in combinations(lines, 2)
        if (p0 - q0) * (p1 - q1) < 0
    }
    places = (0.0, *sorted(crossings), 1.0)
    tops = [(x0 + t * (x1 - x0), max(p0 + t * (p1 - p0) for p0, p1 in lines)) for t in places]
    return [(left, degree0, right, degree1) for (left, degree0), (right, degree1) in pairwise(tops)]


def _curved_area(degree: Callable[[float], float], places: Sequence[float]) -> tuple[float, float]:
    """Area and moment about the first place by Simpson's rule, halving each panel until both are right."""
    origin = places[0]
    span = places[-1] - origin
    # Relative to the area, which a first look estimates: a tail must give as good a centre as a plateau.
    steps = 64
    rough = sum(degree(origin + span * (i + 0.5) / steps) for i in range(steps)) / steps * span
    tolerance = 15e-10 * rough / span

    def simpson(panel: Panel) -> Sums:
        x0, low, middle, centre, x1, high = panel
        weight = (x1 - x0) / 6
        four = 4 * centre
        moment = low * (x0 - origin) + four * (middle - origin) + high * (x1 - origin)
        return weight * (low + four + high), weight * moment

    def halved(panel: Panel, whole: Sums, depth: int) -> Sums:
        x0, low, middle, centre, x1, high = panel
        near, far = (x0 + middle) / 2, (middle + x1) / 2
        first = (x0, low, near, degree(near), middle, centre)
        last = (middle, centre, far, degree(far), x1, high)
        left, right = simpson(first), simpson(last)
        area, moment = left[0] + right[0], left[1] + right[1]
        error = max(abs(area - whole[0]), abs(moment - whole[1]) / span)
        # A panel may err in proportion to its width; 40 halvings leave a jump a millionth of the tolerance.
        if depth > 40 or (depth > 1 and error <= tolerance * (x1 - x0)):
            return area, moment
        left, right = halved(first, left, depth + 1), halved(last, right, depth + 1)
        return left[0] + right[0], left[1] + right[1]

    area = moment = 0.0
    for x0, x1 in pairwise(places):
        middle = (x0 + x1) / 2
        panel = (x0, degree(x0), middle, degree(middle), x1, degree(x1))
        part = halved(panel, simpson(panel), 0)
        area += part[0]
        moment += part[1]
    return area, moment
