"""Clusters one-dimensional data: number of clusters and their centres."""

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
"""Relative difference of potentials that counts as rounding."""

FUZZINESS = 2.0
"""The exponent m of fuzzy c-means (Bezdek 1981), its usual value."""


def subtractive_centres(data: Floats, radius: float) -> Floats:
    """Cluster centres by subtractive clustering.

    The potential of a point is the number of points near it. The point with the highest potential becomes a
    centre and the potential around it is reduced, until no remaining potential stands out (Chiu, "Fuzzy model
    identification based on cluster estimation", 1994).

    Args:
        data: One value per point; duplicates count.
        radius: Radius of influence, as a fraction of the data's range.

    Returns:
        Centres in ascending order, all of them data points; at least one.
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
            potential[best] = 0  # neither high nor far enough from the others: skipped
            continue
        chosen.append(best)
        taken = potential[best] * np.exp(-4 * ((scaled - scaled[best]) / (SQUASH * radius)) ** 2)
        potential = np.maximum(potential - taken, 0)
    return np.sort(points[chosen])


def _first_highest(potential: Floats) -> int:
    """Index of the maximum; among values equal up to rounding the lowest, whatever the data's unit."""
    return int((potential >= potential.max() * (1 - TIE)).argmax())


def c_means(data: Floats, centres: Floats) -> tuple[Floats, Floats]:
    """Fuzzy c-means by scikit-fuzzy, started from given centres rather than at random.

    Args:
        data: One value per point.
        centres: Initial centres, at least two.

    Returns:
        Centres in ascending order, and memberships of shape (centres, points).
    """
    import skfuzzy  # slow to import

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
    """Degrees of c-means: proportional to the inverse squared distances from the centres.

    Returns:
        Shape (centres, points); every point's degrees add up to 1.
    """
    squared = np.maximum((data - centres[:, None]) ** 2, np.finfo(float).tiny ** 0.5)
    closeness = squared ** (-1 / (FUZZINESS - 1))
    return np.asarray(closeness / closeness.sum(axis=0))


def peaked_degrees(places: Floats, centres: Floats, cluster: int) -> Floats:
    """C-means degrees between the centres of the two neighbouring clusters; 0 beyond.

    Between them the degree rises to 1 at the cluster's own centre and falls again. Beyond the neighbours it
    would rise again a little, since far points belong to all clusters equally; no term means that.
    """
    degrees = memberships_of(places, centres)[cluster]
    low = centres[cluster - 1] if cluster > 0 else -np.inf
    high = centres[cluster + 1] if cluster < len(centres) - 1 else np.inf
    return np.where((low < places) & (places < high), degrees, 0.0)
