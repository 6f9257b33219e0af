"""Sets without area that are above 0 at single places: what singletons give.

Such a place counts by its degree, as the constant of a zero-order Sugeno rule does by the rule's strength. It
is what equally narrow rectangles in the singletons' place give as they narrow, so that beside a term with an
area a singleton counts for nothing.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from comity_fis.defuzzification.sets import Sets, Whole

Floats = NDArray[np.float64]

HALF = 1e-12
"""Of a sum: a part that lacks no more of half of it is half of it."""


class Spikes(NamedTuple):
    """Places at which sets without area may be above 0, and how high they are there."""

    places: Floats
    """Ascending; where terms turn, and the ends of the range."""
    degrees: Floats
    """By set and place."""


def spikes_of(sets: Sets, which: Whole) -> Spikes:
    """The spikes of some of the sets, which have no area."""
    places = np.append(sets.ground.left, sets.ground.high)
    return Spikes(places, sets.at(which, np.broadcast_to(places, (which.size, places.size))))


def centre(spikes: Spikes) -> Floats:
    """The mean of the places, weighed by degree; NaN where there is no spike."""
    with np.errstate(invalid="ignore"):
        return np.asarray(spikes.degrees @ spikes.places / spikes.degrees.sum(axis=1))


def halfway(spikes: Spikes) -> Floats:
    """The lowest place up to which half of the sum of degrees is reached; NaN where there is no spike."""
    upto = np.cumsum(spikes.degrees, axis=1)
    total = upto[:, -1]
    first = np.argmax(upto >= total[:, None] / 2 * (1 - HALF), axis=1)
    return np.where(total > 0, spikes.places[first], np.nan)
