"""Whose the aggregated output set is: its outline in pieces, each with the rules that attain the maximum."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from itertools import combinations, pairwise

from comity_fis.explanation.owned import Group, Owner, Piece
from comity_fis.membership.function import Trapezoid


def pieces_of(groups: Sequence[Group], low: float, high: float) -> tuple[Piece, ...]:
    """The outline of the largest of several cut terms over [low, high], in ascending order without gaps.

    Exact where every term is a trapezoid; by quadrature to 1e-11 of the range where one is curved.
    """
    if all(isinstance(group.term, Trapezoid) for group in groups):
        return tuple(_straight(groups, low, high))
    return tuple(_curved(groups, low, high))


def _places(corners: set[float], low: float, high: float) -> list[float]:
    return [low, *sorted([x for x in corners if low < x < high]), high]


# Straight terms: everything happens at corners, where two lines cross, or where one passes a weaker strength.

_Outline = tuple[int, float, float, float, float, float]
"""A group's number, and of its term, cut off: where it starts to rise, is up, starts to fall and is down, and
its height."""

_Line = tuple[int, float, float]
"""A group's number, and its degrees at both ends of a stretch over which it is straight."""


def _straight(groups: Sequence[Group], low: float, high: float) -> Iterator[Piece]:
    outlines: list[_Outline] = []
    corners: set[float] = set()
    for number, group in enumerate(groups):
        (a, b, c, d), height = group.term.knots, group.height
        bends = (a, a + height * (b - a), d - height * (d - c), d)
        outlines.append((number, *bends, height))
        corners.update(bends)
    for x0, x1 in pairwise(_places(corners, low, high)):
        lines = [line for outline in outlines if (line := _line(outline, x0, x1))]
        if not lines:
            yield Piece(x0, x1, (0.0, 0.0), 0.0, 0.0, (), True)
        elif len(lines) == 1 and len(groups[lines[0][0]].levels) == 1:
            number, y0, y1 = lines[0]
            yield _straight_piece(x0, x1, y0, y1, ((number, len(groups[number].strengths)),))
        else:
            yield from _envelope(groups, lines, x0, x1)


def _line(outline: _Outline, x0: float, x1: float) -> _Line | None:
    """The degrees just inside both ends of [x0, x1], which has no corner inside; None where they are 0."""
    number, start, up, fall, down, height = outline
    middle = (x0 + x1) / 2
    if not start < middle < down:
        return None
    if middle < up:
        slope = height / (up - start)
        return number, slope * (x0 - start), slope * (x1 - start)
    if middle > fall:
        slope = height / (down - fall)
        return number, slope * (down - x0), slope * (down - x1)
    return number, height, height


def _envelope(groups: Sequence[Group], lines: Sequence[_Line], x0: float, x1: float) -> Iterator[Piece]:
    """The highest of several straight lines over [x0, x1]."""
    places = [1.0]
    for (_, p0, p1), (_, q0, q1) in combinations(lines, 2):
        if (p0 - q0) * (p1 - q1) < 0:
            places.append((p0 - q0) / (p0 - q0 - p1 + q1))
    for number, y0, y1 in lines:
        places += [(h - y0) / (y1 - y0) for h in groups[number].between(min(y0, y1), max(y0, y1))]
    start = 0.0
    for end in sorted(places):
        left, right, middle = x0 + start * (x1 - x0), x0 + end * (x1 - x0), (start + end) / 2
        heights = [y0 + middle * (y1 - y0) for _, y0, y1 in lines]
        best = max(heights)
        _, y0, y1 = lines[heights.index(best)]
        if left < right:
            owners = [
                (line[0], groups[line[0]].reaching(best))
                for line, height in zip(lines, heights, strict=True)
                if height == best
            ]
            yield _straight_piece(left, right, y0 + start * (y1 - y0), y0 + end * (y1 - y0), tuple(owners))
        start = end


def _straight_piece(x0: float, x1: float, y0: float, y1: float, owners: tuple[Owner, ...]) -> Piece:
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

_State = tuple[tuple[Owner, ...], bool]
"""Owners, and whether it is flat."""


def _curved(groups: Sequence[Group], low: float, high: float) -> Iterator[Piece]:
    def degree(x: float) -> float:
        return max(min(group.height, group.term(x)) for group in groups)

    def state(x: float) -> _State:
        best = degree(x)
        if best <= 0:
            return (), True
        top = [i for i, group in enumerate(groups) if min(group.height, group.term(x)) == best]
        flat = any(groups[i].height == best for i in top)
        return tuple([(i, groups[i].reaching(best)) for i in top]), flat

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
