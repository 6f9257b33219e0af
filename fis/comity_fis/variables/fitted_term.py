"""Membership function of one cluster: the paper's fit if its shape is usable, else a constrained fit.

Least squares constrains a curve only where there are data. With few distinct values, or gaps between them,
the best sum of two Gaussians may have a second hump or a plateau where there are no data. So every free fit
is checked over the whole range, and refitted under tighter bounds if it is not usable.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

import numpy as np

from comity_fis.membership.function import Bump, TwoTermGaussian
from comity_fis.variables.clustering import peaked_degrees
from comity_fis.variables.fitting import free_fit, held_fit
from comity_fis.variables.resolution import resolved

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]

Form = Literal["free", "held"]
"""Free: two Gaussians by least squares over the data's degrees, as in the paper. Held: two Gaussians with one
peak and heights of at most 1, by least squares over the c-means degrees of the whole range."""
PARAMETERS = 6
"""Parameters of two Gaussians: with no more distinct values, a free fit has no error to judge it by."""
FARTHEST_OFF = 0.15
"""Maximum error against the c-means degrees in the data's range (our choice; the paper's fit has 0.10)."""
DEEPEST = 1e-6
"""Dip between two humps that counts as rounding."""
PLACES = 201
"""Number of points at which the range is checked."""


@dataclass(frozen=True, slots=True)
class FittedTerm:
    """A membership function, its errors, and how it was found."""

    term: TwoTermGaussian
    squared_error: float
    """Sum of squared errors over all data."""
    largest_error: float
    """Maximum error against the c-means degrees over the data's range, not only at the data."""
    form: Form
    because: str
    """Why the fit is held; empty if it is free."""


@dataclass(frozen=True, slots=True)
class Frame:
    """The data's range; fits use fractions of it, so that the unit does not affect the terms."""

    low: float
    span: float

    def inside(self, numbers: Floats) -> Floats:
        """Numbers as fractions of the range."""
        return (numbers - self.low) / self.span

    def outside(self, fraction: float) -> float:
        """A fraction of the range as a number."""
        return self.low + fraction * self.span

    def unfolded(self, term: TwoTermGaussian) -> TwoTermGaussian:
        """A term over fractions as a term over numbers."""
        first, second = (
            Bump(bump.height, self.outside(bump.centre), bump.width * self.span)
            for bump in (term.first, term.second)
        )
        return TwoTermGaussian(first, second)


def fit_term(data: Floats, degrees: Floats, centres: Floats, cluster: int, frame: Frame) -> FittedTerm:
    """The term of one cluster.

    Args:
        data: One value per point, as fractions of the range; duplicates count.
        degrees: Fuzzy c-means degree of each point.
        centres: Centres of all clusters, as fractions of the range, ascending.
        cluster: Index of the cluster.
        frame: The range.
    """
    places, centre = np.linspace(0, 1, PLACES), float(centres[cluster])
    wanted = peaked_degrees(places, centres, cluster)

    def judged(term: TwoTermGaussian, form: Form, because: str) -> FittedTerm:
        error = float(((_degrees(term, data) - degrees) ** 2).sum())
        off = float(np.abs(_degrees(term, places) - wanted).max())
        return FittedTerm(frame.unfolded(term), error, off, form, because)

    different = len(set(data.tolist()))
    if different <= PARAMETERS:
        because = f"{different} different values are no more than a free fit has parameters"
    else:
        free = free_fit(data, degrees)
        because = _fault(free, places, wanted, centre, frame)
        if not because:
            return judged(free, "free", "")
    return judged(held_fit(places, wanted, centre), "held", because)


def _fault(term: TwoTermGaussian, places: Floats, wanted: Floats, centre: float, frame: Frame) -> str:
    """Why a free fit is unusable; empty if it is usable."""
    if len(peaks := humps(term)) > 1:
        hump, height = max(peaks, key=lambda peak: abs(peak[0] - centre))
        return f"a free fit has a second hump of {height:.2f} at {_said(hump, frame)}"
    found = _degrees(term, places)
    worst = int(np.abs(found - wanted).argmax())
    if abs(found[worst] - wanted[worst]) > FARTHEST_OFF:
        place = _said(float(places[worst]), frame)
        return f"a free fit gives {found[worst]:.2f} at {place}, fuzzy c-means {wanted[worst]:.2f}"
    return ""


def humps(term: TwoTermGaussian) -> list[tuple[float, float]]:
    """The local maxima of a term, as (place, degree): the highest one and any second hump.

    A second hump can only lie between the two centres, where the sum is smooth on the scale of the widths.
    """
    low, high = term.first.centre, term.second.centre
    width = min(term.first.width, term.second.width)
    places = np.linspace(low, high, int(min(20 * (high - low) / width, 20_000)) + 2)
    degrees = _degrees(term, places)
    top = int(degrees.argmax())
    peaks = [top]
    for side in (np.arange(top, -1, -1), np.arange(top, len(places))):
        rises = degrees[side] - np.minimum.accumulate(degrees[side])
        if rises.max() > DEEPEST:
            peaks.append(int(side[rises.argmax()]))
    return [(float(places[peak]), float(degrees[peak])) for peak in peaks]


def _degrees(term: TwoTermGaussian, places: Floats) -> Floats:
    return np.array([term(x) for x in places.tolist()])


def _said(fraction: float, frame: Frame) -> str:
    return resolved(frame.outside(fraction), frame.span, 3)
