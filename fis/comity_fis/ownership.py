"""Whose the aggregated output set is: its outline in pieces, each with the rules that attain the maximum.

A rule's output set is its term cut off at its strength. Where several rules attain the same degree they own
the piece together: two terms cut at one height, or two rules for one term below the weaker one's strength.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from itertools import combinations, pairwise
from typing import NamedTuple

from comity_fis.centroid import Cut
from comity_fis.membership import NumericMembership, Trapezoid

DIGITS = 12
"""Strengths that agree in so many decimals are equal: what is a tie on paper is one in floating point too."""


class Piece(NamedTuple):
    """A stretch of the output's range over which the same rules attain the maximum."""

    left: float
    right: float
    degrees: tuple[float, float]
    """Just inside both ends."""
    area: float
    moment: float
    """About 0: the integral of `x mu(x)`."""
    owners: tuple[int, ...]
    """Indices of the cuts; empty where the aggregated set is 0."""
    flat: bool
    """Whether the owners' strength is the height here, and not the slope of their term."""


class _Group(NamedTuple):
    """The cuts of one term, strongest first."""

    term: NumericMembership
    strengths: tuple[float, ...]
    indices: tuple[int, ...]

    def owners(self, degree: float) -> tuple[int, ...]:
        """Who reaches a degree that the term itself allows."""
        if len(self.indices) == 1:
            return self.indices
        return tuple(i for h, i in zip(self.strengths, self.indices, strict=True) if h >= degree)


def pieces_of(cuts: Sequence[Cut], low: float, high: float) -> tuple[Piece, ...]:
    """The outline of the largest of several cuts over [low, high], in ascending order without gaps.

    Exact where every term is a trapezoid; by quadrature to 1e-11 of the range where one is curved.
    """
    groups = _grouped(cuts)
    if all(isinstance(group.term, Trapezoid) for group in groups):
        return tuple(_straight(groups, low, high))
    return tuple(_curved(groups, low, high))


def _grouped(cuts: Sequence[Cut]) -> list[_Group]:
    by_term: dict[NumericMembership, list[tuple[float, int]]] = {}
    for i, cut in enumerate(cuts):
        if (strength := round(cut.strength, DIGITS)) > 0:
            by_term.setdefault(cut.term, []).append((-strength, i))
    return [
        _Group(term, tuple(-h for h, _ in sorted(rules)), tuple(i for _, i in sorted(rules)))
        for term, rules in by_term.items()
    ]


def _places(corners: set[float], low: float, high: float) -> list[float]:
    return [low, *sorted(x for x in corners if low < x < high), high]


# Straight terms: everything happens at corners, where two lines cross, or where one passes a weaker strength.


class _Outline(NamedTuple):
    """A term's tallest cut: where it starts to rise, is up, starts to fall and is down, and its height."""

    group: _Group
    start: float
    up: float
    fall: float
    down: float
    height: float

    def line(self, x0: float, x1: float) -> _Line | None:
        """Its degrees just inside both ends of [x0, x1], which has none of its corners inside."""
        group, start, up, fall, down, height = self
        middle = (x0 + x1) / 2
        if not start < middle < down:
            return None
        if middle < up:
            slope = height / (up - start)
            return group, slope * (x0 - start), slope * (x1 - start)
        if middle > fall:
            slope = height / (down - fall)
            return group, slope * (down - x0), slope * (down - x1)
        return group, height, height


_Line = tuple[_Group, float, float]
"""The degrees at both ends of a stretch over which a cut is straight."""


def _straight(groups: Sequence[_Group], low: float, high: float) -> Iterator[Piece]:
    outlines = []
    corners: set[float] = set()
    for group in groups:
        (a, b, c, d), height = group.term.knots, group.strengths[0]
        outline = _Outline(group, a, a + height * (b - a), d - height * (d - c), d, height)
        outlines.append(outline)
        corners.update(outline[1:5])
    for x0, x1 in pairwise(_places(corners, low, high)):
        lines = [line for outline in outlines if (line := outline.line(x0, x1))]
        if not lines:
            yield Piece(x0, x1, (0.0, 0.0), 0.0, 0.0, (), True)
        elif len(lines) == 1 and len(lines[0][0].strengths) == 1:
            group, y0, y1 = lines[0]
            yield _straight_piece(x0, x1, y0, y1, group.indices)
        else:
            yield from _envelope(lines, x0, x1)


def _envelope(lines: Sequence[_Line], x0: float, x1: float) -> Iterator[Piece]:
    """The highest of several straight lines over [x0, x1]."""
    places = []
    for (_, p0, p1), (_, q0, q1) in combinations(lines, 2):
        if (p0 - q0) * (p1 - q1) < 0:
            places.append((p0 - q0) / (p0 - q0 - p1 + q1))
    for group, y0, y1 in lines:
        places += [(h - y0) / (y1 - y0) for h in group.strengths[1:] if (h - y0) * (h - y1) < 0]
    start = 0.0
    for end in (*sorted(places), 1.0):
        left, right, middle = x0 + start * (x1 - x0), x0 + end * (x1 - x0), (start + end) / 2
        heights = [y0 + middle * (y1 - y0) for _, y0, y1 in lines]
        best = max(heights)
        top = [line for line, height in zip(lines, heights, strict=True) if height == best]
        group, y0, y1 = top[0]
        owners = group.owners(best)
        if len(top) > 1:
            owners = tuple(sorted(i for group, _, _ in top for i in group.owners(best)))
        if left < right:
            yield _straight_piece(left, right, y0 + start * (y1 - y0), y0 + end * (y1 - y0), owners)
        start = end


def _straight_piece(x0: float, x1: float, y0: float, y1: float, owners: tuple[int, ...]) -> Piece:
    half_width = (x1 - x0) / 2
    area = half_width * (y0 + y1)
    moment = half_width / 3 * (y0 * (2 * x0 + x1) + y1 * (x0 + 2 * x1))
    return Piece(x0, x1, (y0, y1), area, moment, owners, y0 == y1)


# Curved terms: follow who owns what along the range, and find by bisection where that changes.

PANELS = 8
"""Between two neighbouring knots: an owner who comes and goes within one of them may be missed."""

MOST_STRETCHES = 50
"""In one panel: two curves that differ by rounding alone could take turns for ever."""

NODES = (
    (0.0, 0.5688888888888889),
    (-0.5384693101056831, 0.47862867049936647),
    (0.5384693101056831, 0.47862867049936647),
    (-0.9061798459386640, 0.23692688505618908),
    (0.9061798459386640, 0.23692688505618908),
)
"""Gauss and Legendre's five places in [-1, 1], with their weights."""

_State = tuple[tuple[int, ...], bool]
"""Owners, and whether it is flat."""


def _curved(groups: Sequence[_Group], low: float, high: float) -> Iterator[Piece]:
    def degree(x: float) -> float:
        return max(min(group.strengths[0], group.term(x)) for group in groups)

    def state(x: float) -> _State:
        best = degree(x)
        if best <= 0:
            return (), True
        top = [group for group in groups if min(group.strengths[0], group.term(x)) == best]
        flat = any(group.strengths[0] == best for group in top)
        return tuple(sorted(i for group in top for i in group.owners(best))), flat

    tolerance = 1e-12 * (high - low)
    for x0, x1 in pairwise(_places({x for group in groups for x in group.term.knots}, low, high)):
        for k in range(PANELS):
            left, right = x0 + (x1 - x0) * k / PANELS, x0 + (x1 - x0) * (k + 1) / PANELS
            for start, end, (owners, flat) in _stretches(state, left, right):
                area, moment = _integral(degree, start, end, tolerance) if owners else (0.0, 0.0)
                inside = 1e-9 * (end - start)
                ends = degree(start + inside), degree(end - inside)
                yield Piece(start, end, ends, area, moment, owners, flat)


def _stretches(
    state: Callable[[float], _State], left: float, right: float
) -> Iterator[tuple[float, float, _State]]:
    """Cut [left, right] where the state changes; what it is just at an end does not count."""
    smallest = 1e-14 * (abs(left) + abs(right)) + 1e-300
    last = state(right - 1e-9 * (right - left))
    for _ in range(MOST_STRETCHES):
        here = state(left + 1e-9 * (right - left))
        if here == last or right - left <= smallest:
            break
        same, other = left, right
        while other - same > smallest and same < (middle := (same + other) / 2) < other:
            same, other = (middle, other) if state(middle) == here else (same, middle)
        yield left, other, here
        left = other
    yield left, right, last


def _integral(
    degree: Callable[[float], float], x0: float, x1: float, tolerance: float, depth: int = 0
) -> tuple[float, float]:
    """Area and moment of a smooth stretch."""
    middle = (x0 + x1) / 2
    whole, left, right = (_gauss(degree, *ends) for ends in ((x0, x1), (x0, middle), (middle, x1)))
    if depth > 40 or abs(left[0] + right[0] - whole[0]) <= tolerance * max(x1 - x0, 1e-12):
        return left[0] + right[0], left[1] + right[1]
    left = _integral(degree, x0, middle, tolerance, depth + 1)
    right = _integral(degree, middle, x1, tolerance, depth + 1)
    return left[0] + right[0], left[1] + right[1]


def _gauss(degree: Callable[[float], float], x0: float, x1: float) -> tuple[float, float]:
    centre, half = (x0 + x1) / 2, (x1 - x0) / 2
    area = moment = 0.0
    for node, weight in NODES:
        x = centre + half * node
        height = weight * half * degree(x)
        area += height
        moment += height * x
    return area, moment
