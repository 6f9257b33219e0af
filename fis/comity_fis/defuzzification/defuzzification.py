"""From a fuzzy set to one number: MATLAB's five methods, exactly and from samples.

The smallest and the largest of maximum are by magnitude, as MATLAB has them: of the maxima -8 to -2, som is
-2 and lom is -8. Where two lie as far from 0, the lower one counts.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise

from comity_fis.membership.peak import peak
from comity_fis.rules.methods import Defuzzification

Degree = Callable[[float], float]

TOLERANCE = 1e-11
"""Of area and moment, relative to the whole."""

ROUNDING = 2.0**-48
"""No degree is known better: halving on would follow the rounding of 1 - (1 - a) (1 - b)."""

LEVEL = 1e-9
"""Degrees that differ by less from the largest one are as large: curves are cut off to rounding only."""

# Gauss and Legendre's rule with five nodes over [-1, 1]; no node is an end, where an edge may be vertical.
NODES = (
    (-0.9061798459386640, 0.2369268850561891),
    (-0.5384693101056831, 0.4786286704993665),
    (0.0, 0.5688888888888889),
    (0.5384693101056831, 0.4786286704993665),
    (0.9061798459386640, 0.2369268850561891),
)

DEEPEST = 40
"""Halvings of a panel: a jump inside one is then a millionth of the tolerance."""

MOST_HALVINGS = 2000
"""Between two places: where a domain is so far from 0 that its numbers are coarse, more do not help."""


@dataclass(frozen=True, slots=True)
class Surface:
    """A fuzzy set, prepared for exact defuzzification."""

    degree: Degree
    places: Sequence[float]
    """Ascending, from one end of the domain to the other; the set is smooth between neighbours."""
    parts: Sequence[Degree]
    """Whose largest degrees are the set's, each with one peak at most between neighbouring places."""

    @property
    def span(self) -> float:
        """The width of the domain."""
        return self.places[-1] - self.places[0]


def centroid(surface: Surface) -> float | None:
    """The centre of area; None without area."""
    parts = _areas(surface)
    area, moment = (sum(part[i] for part in parts) for i in (0, 1))
    low, high = surface.places[0], surface.places[-1]
    return min(max(low + moment / area, low), high) if area > 0 else None


def bisector(surface: Surface) -> float | None:
    """The lowest place that has half of the area on either side; None without area."""
    areas = [area for area, _ in _areas(surface)]
    missing = sum(areas) / 2
    if not missing > 0:
        return None
    for (left, right), area in zip(pairwise(surface.places), areas, strict=True):
        if area >= missing * (1 - TOLERANCE):
            return _share(surface, left, right, missing)
        missing -= area
    return surface.places[-1]


def mean_of_maximum(surface: Surface) -> float | None:
    """The mean of all places of the largest degree."""
    plateaus = _plateaus(surface)
    width = sum(right - left for left, right in plateaus)
    if width > LEVEL * surface.span:
        return sum((right - left) * (left + right) / 2 for left, right in plateaus) / width
    return sum((left + right) / 2 for left, right in plateaus) / len(plateaus) if plateaus else None


def smallest_of_maximum(surface: Surface) -> float | None:
    """The place of the largest degree that is nearest to 0."""
    nearest = [min(max(0.0, left), right) for left, right in _plateaus(surface)]
    return min(nearest, key=abs, default=None)


def largest_of_maximum(surface: Surface) -> float | None:
    """The place of the largest degree that is farthest from 0."""
    return max((end for plateau in _plateaus(surface) for end in plateau), key=abs, default=None)


EXACT: Mapping[Defuzzification, Callable[[Surface], float | None]] = {
    "centroid": centroid,
    "bisector": bisector,
    "mom": mean_of_maximum,
    "som": smallest_of_maximum,
    "lom": largest_of_maximum,
}


def _areas(surface: Surface) -> list[tuple[float, float]]:
    """Area and moment about the first place, between every two neighbours."""
    whole = sum(_gauss(surface, left, right)[0] for left, right in pairwise(surface.places))
    tolerance = max(TOLERANCE * whole / surface.span, ROUNDING)
    return [_area(surface, left, right, tolerance) for left, right in pairwise(surface.places)]


def _area(surface: Surface, left: float, right: float, tolerance: float) -> tuple[float, float]:
    """Area and moment, halving each panel until both err by less than the tolerance times its width."""
    halvings = 0

    def halved(x0: float, x1: float, whole: tuple[float, float], depth: int) -> tuple[float, float]:
        middle = (x0 + x1) / 2
        one, other = _gauss(surface, x0, middle), _gauss(surface, middle, x1)
        area, moment = one[0] + other[0], one[1] + other[1]
        error = max(abs(area - whole[0]), abs(moment - whole[1]) / surface.span)
        nonlocal halvings
        halvings += 1
        if depth >= DEEPEST or halvings > MOST_HALVINGS or not error > tolerance * (x1 - x0):
            return area, moment
        one, other = halved(x0, middle, one, depth + 1), halved(middle, x1, other, depth + 1)
        return one[0] + other[0], one[1] + other[1]

    return halved(left, right, _gauss(surface, left, right), 0)


def _gauss(surface: Surface, left: float, right: float) -> tuple[float, float]:
    half, middle, origin = (right - left) / 2, (left + right) / 2, surface.places[0]
    xs = [middle + half * node for node, _ in NODES]
    degrees = [weight * surface.degree(x) for x, (_, weight) in zip(xs, NODES, strict=True)]
    moment = sum(degree * (x - origin) for x, degree in zip(xs, degrees, strict=True))
    return half * sum(degrees), half * moment


def _share(surface: Surface, left: float, right: float, share: float) -> float:
    """Where the area that starts at `left` reaches a share."""
    low, high = left, right
    for _ in range(60):
        middle = (low + high) / 2
        area, _moment = _area(surface, left, middle, max(TOLERANCE * share / surface.span, ROUNDING))
        low, high = (middle, high) if area < share else (low, middle)
    return (low + high) / 2


def _plateaus(surface: Surface) -> list[tuple[float, float]]:
    """The intervals, some of them single places, over which the degree is largest; none if it is 0."""
    panels = list(pairwise(surface.places))
    peaks = [
        (part, panel, x)
        for part in surface.parts
        for panel, x in zip(panels, _peaks(part, panels), strict=True)
    ]
    top = max(part(x) for part, _, x in peaks)
    if not top > 0:
        return []
    level = top - LEVEL * min(1.0, top)
    found: list[tuple[float, float]] = []
    for plateau in sorted(
        (left, right) if all(part(inner) >= level for inner in _inside(left, right)) else (x, x)
        for part, (left, right), x in peaks
        if part(x) >= level
    ):
        if found and plateau[0] <= found[-1][1]:
            found[-1] = found[-1][0], max(found[-1][1], plateau[1])
        else:
            found.append(plateau)
    return found


def _peaks(part: Degree, panels: Sequence[tuple[float, float]]) -> list[float]:
    """Where the part is largest in each panel; a flat one or one far below the others is not searched."""
    samples = [[part(x) for x in (left, *_inside(left, right), right)] for left, right in panels]
    top = max(map(max, samples))
    return [
        peak(part, left, right)
        if max(degrees) > min(degrees) and 2 * max(degrees) - min(degrees) >= top
        else max((left, right), key=part)
        for (left, right), degrees in zip(panels, samples, strict=True)
    ]


def _inside(left: float, right: float) -> tuple[float, ...]:
    return tuple(left + part * (right - left) for part in (1 / 8, 3 / 8, 5 / 8, 7 / 8))


def _weighed(xs: Sequence[float], degrees: Sequence[float]) -> float | None:
    area = sum(degrees)
    return sum(x * degree for x, degree in zip(xs, degrees, strict=True)) / area if area > 0 else None


def _halfway(xs: Sequence[float], degrees: Sequence[float]) -> float | None:
    """The first sample at which half of the sum is reached."""
    half, reached = sum(degrees) / 2, 0.0
    for x, degree in zip(xs, degrees, strict=True):
        reached += degree
        if half > 0 and reached >= half:
            return x
    return None


def _maxima(xs: Sequence[float], degrees: Sequence[float]) -> list[float]:
    top = max(degrees)
    return [x for x, degree in zip(xs, degrees, strict=True) if degree == top > 0]


def _mean(xs: Sequence[float], degrees: Sequence[float]) -> float | None:
    maxima = _maxima(xs, degrees)
    return sum(maxima) / len(maxima) if maxima else None


def _nearest(xs: Sequence[float], degrees: Sequence[float]) -> float | None:
    return min(_maxima(xs, degrees), key=abs, default=None)


def _farthest(xs: Sequence[float], degrees: Sequence[float]) -> float | None:
    return max(_maxima(xs, degrees), key=abs, default=None)


SAMPLED: Mapping[Defuzzification, Callable[[Sequence[float], Sequence[float]], float | None]] = {
    "centroid": _weighed,
    "bisector": _halfway,
    "mom": _mean,
    "som": _nearest,
    "lom": _farthest,
}
