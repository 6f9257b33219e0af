"""From fuzzy sets to one number each: MATLAB's five methods, exactly.

The smallest and the largest of maximum are by magnitude, as MATLAB has them: of the maxima -8 to -2, som is
-2 and lom is -8. Where two lie as far from 0, the lower one counts. Of a set that is above 0 at single places
only, the places count (`spikes`).
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from comity_fis.defuzzification.gauss_kronrod import integrals, places_in
from comity_fis.defuzzification.panels import Panels
from comity_fis.defuzzification.sets import Sets, Whole
from comity_fis.defuzzification.spikes import HALF, Spikes, centre, halfway, spikes_of
from comity_fis.membership.turns import GOLDEN
from comity_fis.rules.methods import Defuzzification

Floats = NDArray[np.float64]

LEVEL = 1e-9
"""Degrees that differ by less from the largest one are as large: curves are cut off to rounding only."""

ROUNDING = 1e-14
"""Degrees that differ by less are the same: a peak stands where its panel ends if it is as high there."""

STEPS = 60
"""Of a search by halves or by the golden section: to 1e-12 of a panel at least."""


def centroid(panels: Panels) -> Floats:
    """The centres of area, by person, or of spikes without area; NaN for what is 0 everywhere."""
    ground = panels.sets.ground
    area, moment = panels.of_people(panels.area), panels.of_people(panels.moment)
    with np.errstate(divide="ignore", invalid="ignore"):
        centres = np.clip(ground.low + moment / area, ground.low, ground.high)
    return _or_spikes(panels, area, centres, centre)


def bisector(panels: Panels) -> Floats:
    """The lowest places that have half of the area on either side, or of spikes; NaN for what is 0."""
    people = np.arange(panels.sets.count)
    first = np.searchsorted(panels.person, people)
    number = np.arange(panels.person.size) - first[panels.person]
    areas = np.zeros((people.size, number.max() + 1))
    areas[panels.person, number] = panels.area
    upto = np.cumsum(areas, axis=1)
    half = upto[:, -1] / 2
    reached = np.argmax(upto >= half[:, None] * (1 - 2 * HALF), axis=1)
    share = half - (upto - areas)[people, reached]
    start, low, high = (end[first + reached] for end in (panels.left, panels.left, panels.right))
    for _ in range(STEPS):
        middle = (low + high) / 2
        degrees = panels.sets.at(people, places_in(start, middle))
        enough = integrals(degrees, start, middle, *panels.sets.ground.frame).area >= share
        low, high = np.where(enough, low, middle), np.where(enough, middle, high)
    return _or_spikes(panels, half, (low + high) / 2, halfway)


def _or_spikes(panels: Panels, area: Floats, values: Floats, of_spikes: Callable[[Spikes], Floats]) -> Floats:
    """The values of sets with an area, and those of the spikes of sets without."""
    without = np.flatnonzero(~(area > 0))
    if without.size:
        values[without] = of_spikes(spikes_of(panels.sets, without))
    return values


def mean_of_maximum(panels: Panels) -> Floats:
    """The means of all places of the largest degree, by person."""
    person, left, right = _maxima(panels)
    count = panels.sets.count
    widths = np.bincount(person, right - left, minlength=count)
    # Where no maximum has a width, each place counts alike, once: neighbouring panels share one.
    flat = widths[person] > LEVEL * panels.sets.ground.span
    again = np.append(False, (person[1:] == person[:-1]) & (left[1:] == left[:-1]))
    weight = np.where(flat, right - left, ~again)
    with np.errstate(invalid="ignore"):
        total = np.bincount(person, weight * (left + right) / 2, minlength=count)
        return total / np.bincount(person, weight, minlength=count)


def smallest_of_maximum(panels: Panels) -> Floats:
    """The places of the largest degree that are nearest to 0, by person."""
    person, left, right = _maxima(panels)
    nearest = np.clip(0.0, left, right)
    return _first(person, np.abs(nearest), nearest, panels.sets.count)


def largest_of_maximum(panels: Panels) -> Floats:
    """The places of the largest degree that are farthest from 0, by person."""
    person, left, right = _maxima(panels)
    ends = np.concatenate([left, right])
    return _first(np.tile(person, 2), -np.abs(ends), ends, panels.sets.count)


EXACT: Mapping[Defuzzification, Callable[[Panels], Floats]] = {
    "centroid": centroid,
    "bisector": bisector,
    "mom": mean_of_maximum,
    "som": smallest_of_maximum,
    "lom": largest_of_maximum,
}


class _Stretches(NamedTuple):
    """Intervals, some of them single places."""

    person: Whole
    left: Floats
    right: Floats


def heights(panels: Panels) -> Floats:
    """The largest degrees, by person."""
    return _highest(panels).top


def _maxima(panels: Panels) -> _Stretches:
    """Where each person's set is as high as anywhere, from low to high; nothing where it is 0 everywhere."""
    places, degrees, lowest, top = _highest(panels)
    level = np.where(top > 0, top - LEVEL * np.minimum(1.0, top), np.inf)[panels.person]
    flat = lowest >= level
    which, panel = np.nonzero((degrees >= level) & ~flat)
    person = np.concatenate([panels.person[flat], panels.person[panel]])
    left = np.concatenate([panels.left[flat], places[which, panel]])
    right = np.concatenate([panels.right[flat], places[which, panel]])
    order = np.lexsort((left, person))
    return _Stretches(person[order], left[order], right[order])


class _Heights(NamedTuple):
    """How high sets are."""

    places: Floats
    """The left end of each panel, its highest place and its right end."""
    degrees: Floats
    """There."""
    lowest: Floats
    """The lowest degree inside each panel."""
    top: Floats
    """The largest degree of each person."""


def _highest(panels: Panels) -> _Heights:
    sets, person = panels.sets, panels.person
    places = np.column_stack([panels.left, places_in(panels.left, panels.right), panels.right])
    degrees = sets.at(person, places)
    best = np.argmax(degrees, axis=1)
    peak, height = (_taken(one, best) for one in (places, degrees))
    top = np.zeros(sets.count)
    np.maximum.at(top, person, height)
    if sets.methods.aggregation != "max":
        # What is added up may have a peak between the places looked at; under max only ends are highest.
        search = 2 * height - degrees.min(axis=1) >= top[person]
        peak[search] = _peaks(sets, person[search], places[search], best[search])
        height = np.maximum(height, sets.at(person, peak))
        np.maximum.at(top, person, height)
    three = np.stack([places[:, 0], peak, places[:, -1]])
    lowest = degrees[:, 1:-1].min(axis=1)
    return _Heights(three, np.stack([degrees[:, 0], height, degrees[:, -1]]), lowest, top)


def _peaks(sets: Sets, person: Whole, places: Floats, best: Whole) -> Floats:
    """Where sets are highest between the neighbours of the highest places looked at: golden section."""
    low = _taken(places, np.maximum(best - 1, 0))
    high = _taken(places, np.minimum(best + 1, places.shape[1] - 1))
    for _ in range(STEPS if person.size else 0):
        one, other = high - GOLDEN * (high - low), low + GOLDEN * (high - low)
        falls = sets.at(person, one) >= sets.at(person, other)
        low, high = np.where(falls, low, one), np.where(falls, other, high)
    middle = (low + high) / 2
    before = _taken(places, best)
    return np.where(sets.at(person, middle) > sets.at(person, before) + ROUNDING, middle, before)


def _taken(of_panels: Floats, which: Whole) -> Floats:
    """One number of each panel."""
    return np.take_along_axis(of_panels, which[:, None], axis=1)[:, 0]


def _first(person: Whole, key: Floats, places: Floats, count: int) -> Floats:
    """Of each person's places the one with the smallest key, and the lowest of several; NaN without any."""
    order = np.lexsort((places, key, person))
    people, at = np.unique(person[order], return_index=True)
    found = np.full(count, np.nan)
    found[people] = places[order][at]
    return found
