"""Least-squares fits of a sum of two Gaussians to the degrees of one cluster.

Places are fractions of the data's range, so that unit and offset do not affect the terms.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np

from comity_fis.membership.function import Bump, TwoTermGaussian

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]

TALLEST, FARTHEST, NARROWEST, WIDEST = 3.0, 4.0, 0.01, 5.0
"""Bounds of a free fit: height, and centres' distance outside the data and widths as fractions of its
range."""
NARROWEST_HELD, WIDEST_HELD = 0.02, 2.0
"""Bounds on the widths of a held fit (our choice)."""
CENTRES = tuple(k / 16 for k in range(-4, 21))
WIDTHS = 0.03, 0.06, 0.1, 0.16, 0.25, 0.4, 0.7
"""Widths of the bumps on the grid from whose pairs searches start."""
STARTS = 4
"""Number of pairs, the best-fitting ones, from which a search starts."""


def free_fit(places: Floats, degrees: Floats) -> TwoTermGaussian:
    """The paper's fit: two bumps with minimum squared error to the data's degrees, heights at least 0.

    Without that bound the optimum has a negative height and negative memberships. Duplicate places count.
    """
    at, first, counts = np.unique(places, return_index=True, return_counts=True)
    wanted, weights = degrees[first], np.sqrt(counts)

    def misses(p: Floats) -> Floats:
        return np.asarray(weights * (_curve(at, p) - wanted))

    def slopes(p: Floats) -> Floats:
        return np.column_stack(_slopes(at, p)) * weights[:, None]

    low = [0.0, -FARTHEST, NARROWEST] * 2
    high = [TALLEST, 1 + FARTHEST, WIDEST] * 2
    starts = _nearest_pairs(at, wanted, weights)
    return _two_terms(_least_squares(misses, slopes, starts, low, high))


def held_fit(places: Floats, degrees: Floats, centre: float) -> TwoTermGaussian:
    """The best-fitting two bumps that together have one peak, whatever the degrees are.

    Heights are at most 1, and the centres at most sqrt(2) times the smaller width apart: two Gaussians whose
    means differ by at most twice the smaller standard deviation are unimodal in any proportion (Behboodian,
    "On the modes of a mixture of two normal distributions", Technometrics 12, 1970).

    Args:
        places: Fractions of the data's range.
        degrees: Target degrees at these places.
        centre: Centre of the cluster; the first bump's centre is at most a quarter of the range from it.
    """

    def bumps(q: Floats) -> Floats:
        height, at, width, other, apart, another = q
        return np.array([height, at, width, other, at + apart * 2**0.5 * min(width, another), another])

    def misses(q: Floats) -> Floats:
        return np.asarray(_curve(places, bumps(q)) - degrees)

    def slopes(q: Floats) -> Floats:
        width, apart, another = q[2], q[4] * 2**0.5, q[5]
        height, at, wide, other, beside, wider = _slopes(places, bumps(q))
        by_width, by_another = (apart, 0.0) if width <= another else (0.0, apart)
        return np.column_stack(
            [height, at + beside, wide + by_width * beside, other, 2**0.5 * min(width, another) * beside,
             wider + by_another * beside]
        )  # fmt: skip

    low = [0.0, centre - 0.25, NARROWEST_HELD, 0.0, -1.0, NARROWEST_HELD]
    high = [1.0, centre + 0.25, WIDEST_HELD, 1.0, 1.0, WIDEST_HELD]
    near = _nearest_pairs(places, degrees, np.ones_like(places), nearness=2**0.5)
    starts = [[h, b, c, o, (e - b) / (2**0.5 * min(c, w)), w] for h, b, c, o, e, w in near.tolist()]
    return _two_terms(bumps(_least_squares(misses, slopes, np.array(starts), low, high)))


def _nearest_pairs(places: Floats, wanted: Floats, weights: Floats, nearness: float = np.inf) -> Floats:
    """The best-fitting of all pairs of bumps on a grid, each pair with its optimal heights.

    Heights enter linearly, so the optimal ones of each pair solve two equations: variable projection (Golub
    and Pereyra 1973).

    Args:
        places: Places of the target degrees.
        wanted: The target degrees.
        weights: Weights of the residuals.
        nearness: Maximum distance of two centres, in units of the smaller width.

    Returns:
        Shape (pairs, 6): height, centre and width of each bump.
    """
    # A sum of two bumps has many local optima, and least squares from one start ends in the nearest. The
    # heights enter linearly, so that for fixed centres and widths the best ones solve a 2 x 2 system
    # (variable projection; Golub and Pereyra 1973): all pairs of a grid are compared at their best in one
    # array operation, with the inner products computed once, and only the nearest few pairs start a search.
    # The grid, not chance, picks the starts: the same data give the same terms.
    grid = np.array([(centre, width) for width in WIDTHS for centre in CENTRES])
    units = weights * np.exp(-(((places - grid[:, :1]) / grid[:, 1:]) ** 2))
    aims, products = units @ (weights * wanted), units @ units.T
    one, other = np.triu_indices(len(grid), 1)
    apart = np.abs(grid[one, 0] - grid[other, 0])
    near = apart <= nearness * np.minimum(grid[one, 1], grid[other, 1])
    one, other = one[near], other[near]
    first, second, both = products[one, one], products[other, other], products[one, other]
    scale = first * second - both**2 + 1e-9
    heights = np.clip(
        [(second * aims[one] - both * aims[other]) / scale, (first * aims[other] - both * aims[one]) / scale],
        0, 1,
    )  # fmt: skip
    a, b = heights
    costs = a * a * first + b * b * second + 2 * a * b * both - 2 * (a * aims[one] + b * aims[other])
    best = np.argsort(costs, kind="stable")[:STARTS]
    return np.column_stack([a[best], grid[one[best]], b[best], grid[other[best]]])


def _least_squares(
    misses: Callable[[Floats], Floats],
    slopes: Callable[[Floats], Floats],
    starts: Floats,
    low: list[float],
    high: list[float],
) -> Floats:
    """The best of several searches; the best few are then run to convergence."""
    from scipy.optimize import least_squares

    def search(start: Floats, exactness: float, steps: int) -> tuple[float, Floats]:
        inside = np.clip(start, np.array(low) + 1e-9, np.array(high) - 1e-9)
        found = least_squares(
            misses,
            inside,
            jac=slopes,
            bounds=(low, high),
            xtol=exactness,
            ftol=exactness,
            gtol=exactness,
            max_nfev=steps,
        )
        return float(found.cost), np.asarray(found.x)

    with np.errstate(all="ignore"):  # a search step may overflow along a bound
        best = min((search(start, 1e-6, 60) for start in starts), key=lambda found: found[0])
        return min(best, search(best[1], 1e-15, 600), key=lambda found: found[0])[1]


def _two_terms(p: Floats) -> TwoTermGaussian:
    bumps = Bump(*p[:3].tolist()), Bump(*p[3:].tolist())
    return TwoTermGaussian(*sorted(bumps, key=lambda bump: bump.centre))


def _curve(places: Floats, p: Floats) -> Floats:
    first = p[0] * np.exp(-(((places - p[1]) / p[2]) ** 2))
    second = p[3] * np.exp(-(((places - p[4]) / p[5]) ** 2))
    return np.asarray(first + second)


def _slopes(places: Floats, p: Floats) -> list[Floats]:
    """Derivatives of a curve with respect to height, centre and width of both bumps."""
    slopes = []
    for height, centre, width in (p[:3], p[3:]):
        off = (places - centre) / width
        unit = np.exp(-(off**2))
        slopes += [unit, 2 * height * unit * off / width, 2 * height * unit * off**2 / width]
    return slopes
