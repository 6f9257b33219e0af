"""The paper's automatic partition of a variable: from data to linguistic terms.

Subtractive clustering gives the number of clusters, fuzzy c-means the degree of each value in them, and a
two-term Gaussian fitted to those degrees becomes the membership function. All three use fractions of the
data's range, so that unit and offset do not affect the terms.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from math import inf, isfinite, ulp
from typing import TYPE_CHECKING

from comity_fis.errors import InputError
from comity_fis.membership.function import TwoTermGaussian

if TYPE_CHECKING:
    from comity_fis.variables.fitted_term import FittedTerm

RADII = tuple(step / 20 for step in range(2, 21))
"""Radii 0.10 to 1.00 in steps of 0.05, around the usual 0.5."""
MOST_SCORES = 5_000
"""Maximum number of data: the clustering is quadratic; a random sample of this size gives the same terms."""
MOST_TERMS = 12
"""Maximum number of terms: far more than people have words for."""
SPANS = 1e-300, 1e300
"""Allowed width of the data's range: differences and their inverses stay finite."""
FEWEST_STEPS = 10_000
"""Minimum number of floats in the data's range: with fewer, rounding creates the clusters."""
CLOSEST = 1e-6
"""Minimum distance of two cluster centres, as a fraction of the range."""


@dataclass(frozen=True, slots=True)
class FittedPartition:
    """The result of a partition."""

    radius: float
    starts: tuple[float, ...]
    """Centres of the subtractive clustering, ascending."""
    centres: tuple[float, ...]
    """Centres of fuzzy c-means, ascending, one per term."""
    memberships: tuple[tuple[float, ...], ...]
    """Degree of each datum, in the given order, one row per term."""
    fits: tuple[FittedTerm, ...]
    """The fit of each term, in the order of the centres."""

    @property
    def terms(self) -> Mapping[str, TwoTermGaussian]:
        """Terms LC1, LC2, ... in ascending order of their centres; the paper's names."""
        return {f"LC{number}": fit.term for number, fit in enumerate(self.fits, 1)}

    @property
    def squared_errors(self) -> tuple[float, ...]:
        """Sum of squared errors of each term's fit over all data."""
        return tuple(fit.squared_error for fit in self.fits)


def partition(scores: Iterable[float], radius: float = 0.5) -> FittedPartition:
    """Cluster data and fit terms to the clusters; see `from_data` for the whole variable.

    Args:
        scores: The data, in any order; duplicates count.
        radius: Radius of influence of a cluster centre, as a fraction of the data's range, above 0.

    Raises:
        OneClusterError: The data form only one cluster.
        InputError: The data are not numbers, too many, or form too many clusters.
    """
    import numpy as np

    from comity_fis.variables.clustering import c_means, subtractive_centres
    from comity_fis.variables.fitted_term import Frame, fit_term

    given = np.array(_checked(scores, radius))
    starts = subtractive_centres(given, radius)
    if len(starts) < 2:
        raise OneClusterError(float(starts[0]), radius)
    if len(starts) > MOST_TERMS:
        raise _too_many(len(starts), radius)
    frame = Frame(float(given.min()), float(np.ptp(given)))
    data = frame.inside(given)
    centres, memberships = c_means(data, frame.inside(starts))
    if np.diff(centres).min() < CLOSEST:
        raise _too_many(len(starts), radius)
    return FittedPartition(
        radius=radius,
        starts=tuple(starts.tolist()),
        centres=tuple(map(frame.outside, centres.tolist())),
        memberships=tuple(tuple(row) for row in memberships.tolist()),
        fits=tuple(
            fit_term(data, degrees, centres, cluster, frame) for cluster, degrees in enumerate(memberships)
        ),
    )


def _too_many(groups: int, radius: float) -> InputError:
    return InputError(
        expected=f"at most {MOST_TERMS} groups, each with a centre of its own",
        got=f"{groups} at radius {radius:g}",
        remedy="Use a larger radius.",
    )


def cluster_counts(scores: Iterable[float], radii: Iterable[float] = RADII) -> Mapping[float, int]:
    """The number of clusters that subtractive clustering finds at each radius; it may be 1.

    Raises:
        InputError: The data are not numbers, as in `partition`.
    """
    import numpy as np

    from comity_fis.variables.clustering import subtractive_centres

    values, radii = list(scores), tuple(radii)
    return {radius: len(subtractive_centres(np.array(_checked(values, radius)), radius)) for radius in radii}


class OneClusterError(InputError):
    """All data form one cluster at this radius: a valid result, but no partition."""

    def __init__(self, centre: float, radius: float) -> None:
        self.centre = centre
        self.radius = radius
        super().__init__(
            expected="data in at least two groups",
            got=f"one group around {centre:g} at radius {radius:g}",
            remedy="Use a smaller radius, or no partition: one group may be the truth.",
        )

    def __reduce__(self) -> tuple[object, ...]:
        return OneClusterError, (self.centre, self.radius)


def numbers(scores: Iterable[float]) -> list[float]:
    """Data as numbers.

    Raises:
        InputError: A value is not a number.
    """
    try:
        given = list(scores)
    except TypeError:
        raise InputError(
            expected="data as a list of numbers", got=repr(scores), remedy="Give one number per case."
        ) from None
    for place, score in enumerate(given, 1):
        try:
            float(score)
        except (TypeError, ValueError, OverflowError):
            raise InputError(
                expected="data as numbers",
                got=f"{score!r} as number {place}",
                remedy="Leave out missing values; words make terms by `all_known`.",
            ) from None
    return [float(score) for score in given]


def _checked(scores: Iterable[float], radius: float) -> list[float]:
    data = numbers(scores)
    for number, score in enumerate(data, 1):
        if not isfinite(score):
            raise InputError(
                expected="at least two different finite numbers",
                got=f"{score} as number {number}",
                remedy="Leave out missing values.",
            )
    if len(set(data)) < 2:
        raise InputError(
            expected="at least two different finite numbers",
            got=f"{len(set(data))} in {len(data)} numbers" if data else "none",
            remedy="Add data: what is the same everywhere has no parts.",
        )
    low, high = min(data), max(data)
    if not SPANS[0] <= high - low <= SPANS[1] or high - low < FEWEST_STEPS * ulp(max(abs(low), abs(high))):
        raise InputError(
            expected="numbers whose differences can be computed with",
            got=f"{low!r} to {high!r}",
            remedy="Use another unit, or take away what all of them have in common.",
        )
    if len(data) > MOST_SCORES:
        raise InputError(
            expected=f"at most {MOST_SCORES} numbers",
            got=f"{len(data)}",
            remedy="Take a random sample: its terms are as good.",
        )
    if not 0 < radius < inf:
        raise InputError(
            expected="a radius above 0",
            got=f"{radius:g}",
            remedy="0.5 is the usual one; smaller gives more groups.",
        )
    return data
