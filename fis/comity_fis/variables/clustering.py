"""Cluster centres of one-dimensional data: how many groups there are, and where."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]

# MATLAB `subclust`'s defaults; Chiu recommends a squash of 1.5, the paper names MATLAB.
SQUASH = 1.25
ACCEPT = 0.5
REJECT = 0.15

TIE = 1e-9
"""Relative difference of potentials that is rounding."""

FUZZINESS = 2.0
"""The exponent m of fuzzy c-means (Bezdek 1981), its usual value."""


def subtractive_centres(data: Floats, radius: float) -> Floats:
    """Centres by subtractive clustering.

    Every point's potential is how many points lie near it; the point of highest potential becomes a centre,
    and the potential near it is taken away, until none is left that stands out (Chiu, "Fuzzy model
    identification based on cluster estimation", 1994).

    Args:
        data: One value per point; repeated values count.
        radius: Of influence, as a fraction of the data's range.

    Returns:
        Centres, which are data points, ascending; at least one.
    """
    points = np.sort(data)
    span = np.ptp(points)
    scaled = (points - points[0]) / span if span > 0 else np.zeros_like(points)
    potential = np.array([np.exp(-4 * ((x - scaled) / radius) ** 2).sum() for x in scaled])
    highest = potential.max()
    chosen: list[int] = []
    while (ratio := (potential[(best := _first_highest(potential))]) / highest) > REJECT:
        nearest = min((abs(scaled[best] - scaled[i]) for i in chosen), default=np.inf)
        if ratio <= ACCEPT and nearest / radius + ratio < 1:
            potential[best] = 0  # neither high nor far enough from the others: passed over
            continue
        chosen.append(best)
        taken = potential[best] * np.exp(-4 * ((scaled - scaled[best]) / (SQUASH * radius)) ** 2)
        potential = np.maximum(potential - taken, 0)
    return np.sort(points[chosen])


def _first_highest(potential: Floats) -> int:
    """Of places that differ by rounding only the lowest, whatever unit the data are in."""
    return int((potential >= potential.max() * (1 - TIE)).argmax())


def c_means(data: Floats, centres: Floats) -> tuple[Floats, Floats]:
    """Fuzzy c-means by scikit-fuzzy, started from given centres, so that no random start is needed.

    Args:
        data: One value per point.
        centres: Where to start, at least two.

    Returns:
        Centres, ascending, and memberships of shape (centres, points).
    """
    import skfuzzy  # its start-up takes longer than all the rest

    found, memberships, *_ = skfuzzy.cmeans(
        data[None, :],
        len(centres),
        FUZZINESS,
        error=1e-12,
        maxiter=10_000,
        init=memberships_of(data, centres),
    )
    order = np.argsort(found[:, 0])
    return found[order, 0], memberships[order]


def memberships_of(data: Floats, centres: Floats) -> Floats:
    """The degrees of c-means: in proportion to the inverse squared distances from the centres.

    Returns:
        Shape (centres, points); every point's degrees add up to 1.
    """
    squared = np.maximum((data - centres[:, None]) ** 2, np.finfo(float).tiny ** 0.5)
    closeness = squared ** (-1 / (FUZZINESS - 1))
    return np.asarray(closeness / closeness.sum(axis=0))


def peaked_degrees(places: Floats, centres: Floats, cluster: int) -> Floats:
    """What c-means says of any place, from the centre of the one neighbour to that of the other; 0 beyond.

    There the degree rises to 1 at the cluster's own centre and falls from it. Beyond the neighbours it rises
    again a little, as everything far away belongs to all clusters alike; no term means that.
    """
    degrees = memberships_of(places, centres)[cluster]
    low = centres[cluster - 1] if cluster > 0 else -np.inf
    high = centres[cluster + 1] if cluster < len(centres) - 1 else np.inf
    return np.where((low < places) & (places < high), degrees, 0.0)
