"""Where output sets have corners: where a rule cuts a term off, or one term passes another.

In a panel of the ground every term only rises or only falls, so that it crosses a strength once at most.
Under max and prod the ratio of two terms does, so that two scaled terms pass each other once at most.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from itertools import combinations
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from comity_fis.defuzzification.ground import Ground
from comity_fis.defuzzification.sets import Sets
from comity_fis.membership.arrays import degrees

Floats = NDArray[np.float64]
Whole = NDArray[np.intp]

MOST_STEPS = 100
"""Of a search; most take fewer than ten."""

CLOSE = 1e-12
"""Of the range: a search ends where its guesses are as near to each other as this."""

SEEN = 1e-6
"""A corner counts where the set is no higher than it by more, relative to its height."""

ONE = -1
"""The number of no term: of what is 1 everywhere."""


class Corners(NamedTuple):
    """Places, each in a panel of one person's set."""

    person: Whole
    panel: Whole
    place: Floats


class _Meetings(NamedTuple):
    """A term times a factor is as high as another term times a factor."""

    person: Whole
    panel: Whole
    term: Whole
    factor: Floats
    other: Whole
    """May be `ONE`."""
    level: Floats
    """The other's factor."""


def corners_of(sets: Sets) -> Corners:
    """All corners that the sets have inside panels."""
    found = [_in_panels(sets.ground, *meeting) for meeting in _possible(sets)]
    if not found:
        return Corners(np.empty(0, np.intp), np.empty(0, np.intp), np.empty(0))
    meetings = _Meetings(*(np.concatenate(parts) for parts in zip(*found, strict=True)))
    person, panel, *_ = meetings
    place = _places(sets.ground, meetings)
    if sets.methods.aggregation == "max" and person.size:
        height = meetings.level * _Degrees(sets.ground, meetings.other)(place)
        seen = sets.at(person, place) <= height * (1 + SEEN)
        return Corners(person[seen], panel[seen], place[seen])
    return Corners(person, panel, place)


def _possible(sets: Sets) -> Iterator[tuple[int, Floats, int, Floats]]:
    """Terms and factors that may meet, the factors by layer and person."""
    tops = sets.tops()
    largest = sets.methods.aggregation == "max"
    if sets.methods.implication == "min":
        for term, top in tops.items():
            own = [i for i, of_layer in enumerate(sets.terms) if of_layer == term]
            # Under max a term may also pass what another one is cut off at, up to where it is cut off itself.
            levels = np.where(sets.strengths <= top, sets.strengths, 0.0) if largest else sets.strengths[own]
            yield term, np.ones_like(levels), ONE, levels
    elif largest:
        for one, other in combinations(tops, 2):
            yield one, tops[one][None], other, tops[other][None]


def _in_panels(ground: Ground, term: int, factor: Floats, other: int, level: Floats) -> _Meetings:
    """People and panels at whose ends they are not the same one higher."""
    ends = ground.ends[other] if other != ONE else np.ones((1, 2))
    factors, levels = factor[:, :, None], level[:, :, None]
    above = [factors * ground.ends[term][:, end] - levels * ends[:, end] for end in (0, 1)]
    layer, person, panel = np.nonzero((above[0] > 0) & (above[1] < 0) | (above[0] < 0) & (above[1] > 0))
    same = np.full(person.shape, 1, dtype=np.intp)
    return _Meetings(person, panel, term * same, factor[layer, person], other * same, level[layer, person])


def _places(ground: Ground, meetings: _Meetings) -> Floats:
    heights = _Degrees(ground, meetings.term), _Degrees(ground, meetings.other)

    def above(xs: Floats) -> Floats:
        height, other = (degrees_at(xs) for degrees_at in heights)
        return meetings.factor * height - meetings.level * other

    left, right = ground.left[meetings.panel], ground.right[meetings.panel]
    return crossings(above, left, right, CLOSE * ground.span)


class _Degrees:
    """The degrees of places, each in a term of its own."""

    def __init__(self, ground: Ground, terms: Whole) -> None:
        self.size = terms.size
        numbers = sorted(set(terms.tolist()) - {ONE})
        self.groups = [(ground.terms[number], np.flatnonzero(terms == number)) for number in numbers]

    def __call__(self, xs: Floats) -> Floats:
        found = np.ones(self.size)
        for term, which in self.groups:
            found[which] = degrees(term, xs[which])
        return found


def crossings(function: Callable[[Floats], Floats], low: Floats, high: Floats, close: float) -> Floats:
    """Where a function is 0 between places at which its signs differ, all searched together.

    By the Illinois method (Dowell and Jarratt 1971): the line through the values at both ends is followed to
    0, and the value at an end that stays is halved, so that the search comes nearer from both sides. It is
    exact at once on a straight line.
    """
    other, at_other, guess, at_guess = low, function(low), high, function(high)
    for _ in range(MOST_STEPS if low.size else 0):
        before = guess
        with np.errstate(divide="ignore", invalid="ignore"):
            step = at_guess * (guess - other) / (at_guess - at_other)
        guess = guess - np.where(np.isfinite(step), step, 0.0)
        found = function(guess)
        passed = np.sign(found) != np.sign(at_guess)
        other, at_other = np.where(passed, before, other), np.where(passed, at_guess, at_other / 2)
        at_guess = found
        if np.all((np.abs(guess - before) <= close) | (found == 0)):
            break
    return guess
