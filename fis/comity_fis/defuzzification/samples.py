"""From a fuzzy set to one number as MATLAB has it: from evenly spaced samples of equal weight."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

from comity_fis.rules.methods import Defuzzification


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
