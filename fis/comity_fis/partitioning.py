"""The paper's automatic partition of a variable: data in, linguistic terms out.

Subtractive clustering says how many groups there are, fuzzy c-means to which degree each value belongs to
them, and a two-term Gaussian fitted to those degrees becomes the membership function.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from math import isfinite

from comity_fis.errors import InputError
from comity_fis.membership import TwoTermGaussian

RADII = tuple(step / 20 for step in range(2, 21))
"""0.10 to 1.00 in steps of 0.05, around the usual 0.5."""
MOST_SCORES = 5_000
"""The clustering compares each value with each other; a random sample of so many gives the same terms."""
MOST_TERMS = 12
"""Far more than anybody has words for."""


@dataclass(frozen=True, slots=True)
class FittedPartition:
    """What the data gave."""

    radius: float
    starts: tuple[float, ...]
    """Centres of the subtractive clustering, ascending."""
    centres: tuple[float, ...]
    """Centres of fuzzy c-means, ascending, one per term."""
    memberships: tuple[tuple[float, ...], ...]
    """Degree of each datum, in the given order, one row per term."""
    terms: Mapping[str, TwoTermGaussian]
    """LC1, LC2, ... in ascending order of their centres; the paper's names."""
    squared_errors: tuple[float, ...]
    """Of each term's fit, summed over all data."""


def partition(scores: Iterable[float], radius: float = 0.5) -> FittedPartition:
    """Clusters of data, and terms fitted to them; see `from_data` for the whole variable.

    Args:
        scores: The data, in any order; repeated values count.
        radius: Of influence of a cluster centre, as a fraction of the data's range, above 0.

    Raises:
        OneClusterError: if the data form one group only.
        InputError: if the data are no numbers, too many, or form more groups than anybody has words for.
    """
    import numpy as np

    from comity_fis.clustering import c_means, subtractive_centres
    from comity_fis.fitting import fit_two_term_gaussian

    data = np.array(_checked(scores, radius))
    starts = subtractive_centres(data, radius)
    if len(starts) < 2:
        raise OneClusterError(float(starts[0]), radius)
    if len(starts) > MOST_TERMS:
        raise InputError(
            expected=f"at most {MOST_TERMS} groups",
            got=f"{len(starts)} at radius {radius:g}",
            remedy="Use a larger radius.",
        )
    centres, memberships = c_means(data, starts)
    fits = [fit_two_term_gaussian(data, degrees) for degrees in memberships]
    return FittedPartition(
        radius=radius,
        starts=tuple(starts.tolist()),
        centres=tuple(centres.tolist()),
        memberships=tuple(tuple(row) for row in memberships.tolist()),
        terms={f"LC{i}": term for i, (term, _) in enumerate(fits, 1)},
        squared_errors=tuple(error for _, error in fits),
    )


def cluster_counts(scores: Iterable[float], radii: Iterable[float] = RADII) -> Mapping[float, int]:
    """How many clusters subtractive clustering finds at each radius; 1 is an honest answer.

    Raises:
        InputError: as `partition` does for data that are no numbers.
    """
    import numpy as np

    from comity_fis.clustering import subtractive_centres

    values, radii = list(scores), tuple(radii)
    return {radius: len(subtractive_centres(np.array(_checked(values, radius)), radius)) for radius in radii}


class OneClusterError(InputError):
    """All data lie in one group at this radius: an honest answer, but no partition."""

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


def _checked(scores: Iterable[float], radius: float) -> list[float]:
    data = [float(score) for score in scores]
    if len(set(data)) < 2 or not all(map(isfinite, data)):
        raise InputError(
            expected="at least two different finite numbers",
            got=f"{len(data)} numbers, {len(set(data))} of them different",
            remedy="Leave out missing values.",
        )
    if len(data) > MOST_SCORES:
        raise InputError(
            expected=f"at most {MOST_SCORES} numbers",
            got=f"{len(data)}",
            remedy="Take a random sample: its terms are as good.",
        )
    if not 0 < radius < float("inf"):
        raise InputError(
            expected="a radius above 0",
            got=f"{radius:g}",
            remedy="0.5 is the usual one; smaller gives more groups.",
        )
    return data
