"""What the places and degrees of an output set's panels do not depend on: terms, range and methods.

Worked out once for a parameter, however many people are asked about.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import lru_cache, partial
from itertools import combinations, pairwise
from math import inf, log

import numpy as np
from numpy.typing import NDArray

from comity_fis.defuzzification.gauss_kronrod import integrals, places_in
from comity_fis.membership.arrays import degrees
from comity_fis.membership.function import NumericMembership, is_straight
from comity_fis.membership.turns import SAME, Function, crossing, extreme
from comity_fis.rules.methods import Methods

Floats = NDArray[np.float64]

INSIDE = 2.0**-32
"""Of a panel's width: degrees at its ends are taken so far inside, since an edge may be vertical there."""

FINE = 1e-14
"""Of a term's area: panels are halved until no term's area errs by more in any of them."""

FINEST = 2.0**-40
"""Of a range: no step from a place to the next is smaller."""

MOST_HALVINGS = 30
MOST_PANELS = 5_000
"""Of one range: terms that want more keep panels in which people's sets are halved on."""

LOOKS = 17
"""Places in each panel at which two terms are compared."""


@dataclass(frozen=True, slots=True, eq=False)
class Ground:
    """A range in panels: in each, every term is smooth and only rises or only falls.

    Under aggregation by max two terms pass each other nowhere inside a panel either, however high they are
    cut off (implication min); under prod their ratio only rises or only falls.
    """

    terms: tuple[NumericMembership, ...]
    low: float
    high: float
    left: Floats
    """Where each panel starts."""
    right: Floats
    degrees: Floats
    """Of each term, at the places in each panel."""
    ends: Floats
    """Of each term, in each panel, just inside both ends."""

    @property
    def span(self) -> float:
        """The width of the range."""
        return self.high - self.low

    @property
    def frame(self) -> tuple[float, float]:
        """What moments are about, and how far from it places can be."""
        return self.low, self.span


@lru_cache(maxsize=256)
def ground_of(terms: tuple[NumericMembership, ...], low: float, high: float, methods: Methods) -> Ground:
    """The panels of a range."""
    places = _ascending([low, high, *(x for term in terms for x in _graded(term, low, high))], low, high)
    if methods.aggregation == "max":
        places = _ascending([*places, *_passes(terms, places, methods)], low, high)
    places = _halved(terms, places)
    left, right = places[:-1], places[1:]
    inside = INSIDE * (right - left)
    ends = np.stack([left + inside, right - inside], axis=-1)
    return Ground(terms, low, high, left, right, _of_all(terms, places_in(left, right)), _of_all(terms, ends))


def _graded(term: NumericMembership, low: float, high: float) -> Iterator[float]:
    """The places where a term turns, and between and beyond them twice as far at each step.

    A single panel from one narrow bump to the next, or to the end of the range, would miss their tails.
    """
    turns = term.turns
    yield from turns
    if is_straight(term):
        return
    least = FINEST * (high - low)
    steps = [max(right - left, least) for left, right in pairwise(turns)]
    for start, end, step in zip(turns[1:], (*turns[2:], high), steps, strict=True):
        yield from _doubling(start, end, step)
    for start, end, step in zip(turns[:-1], (low, *turns[:-2]), steps, strict=True):
        yield from _doubling(start, end, -step)


def _doubling(start: float, end: float, step: float) -> Iterator[float]:
    while abs(step) < (end - start) * (1 if step > 0 else -1):
        yield start + step
        step *= 2


def _ascending(places: list[float], low: float, high: float) -> Floats:
    found = np.unique(np.array(places, dtype=np.float64))
    return found[(low <= found) & (found <= high)]


def _of_all(terms: tuple[NumericMembership, ...], xs: Floats) -> Floats:
    return np.stack([degrees(term, xs) for term in terms])


def _halved(terms: tuple[NumericMembership, ...], places: Floats) -> Floats:
    """Panels halved until the rule integrates every term in each of them, tails included."""
    low, high = float(places[0]), float(places[-1])
    for _ in range(MOST_HALVINGS):
        left, right = places[:-1], places[1:]
        xs = places_in(left, right)
        found = [integrals(degrees(term, xs), left, right, low, high - low) for term in terms]
        coarse = np.any([one.error > FINE * one.area.sum() for one in found], axis=0)
        middles = (left[coarse] + right[coarse]) / 2
        if not len(middles) or len(places) + len(middles) > MOST_PANELS:
            break
        places = np.unique(np.concatenate([places, middles]))
    return places


def _passes(terms: tuple[NumericMembership, ...], places: Floats, methods: Methods) -> Iterator[float]:
    """Where two terms are as high as each other (min), or where their ratio turns (prod)."""
    steps = np.linspace(INSIDE, 1 - INSIDE, LOOKS)
    xs = places[:-1, None] + np.diff(places)[:, None] * steps
    looks = _of_all(terms, xs)
    for (one, here), (other, there) in combinations(zip(terms, looks, strict=True), 2):
        both = (here.max(axis=1) > 0) & (there.max(axis=1) > 0)
        if methods.implication == "min":
            yield from _meetings(partial(_gap, one, other), xs[both], (here - there)[both])
        else:
            with np.errstate(divide="ignore", invalid="ignore"):
                ratios = np.log(here[both]) - np.log(there[both])
            yield from (turn for _, turn in _turns(partial(_log_ratio, one, other), xs[both], ratios))


def _meetings(gap: Function, xs: Floats, gaps: Floats) -> Iterator[float]:
    """Where a difference is 0; in a panel it may be so twice, on both sides of a turn."""
    changing: list[int] = np.flatnonzero(gaps[:, 0] * gaps[:, -1] < 0).tolist()
    turns: dict[int, list[float]] = {row: [] for row in changing}
    for row, turn in _turns(gap, xs, gaps):
        turns.setdefault(row, []).append(turn)
    for row, of_row in turns.items():
        for left, right in pairwise((float(xs[row, 0]), *sorted(of_row), float(xs[row, -1]))):
            if gap(left) * gap(right) < 0:
                yield crossing(gap, left, right)


def _turns(function: Function, xs: Floats, values: Floats) -> Iterator[tuple[int, float]]:
    """Rows with a place where the function turns; three values in a row give it away."""
    with np.errstate(invalid="ignore"):
        steps = np.diff(values, axis=1)
        turned = (steps[:, :-1] * steps[:, 1:] < 0) & (
            np.minimum(*np.abs([steps[:, :-1], steps[:, 1:]])) > SAME
        )
    for row, k in np.argwhere(turned).tolist():
        sign = 1 if steps[row, k] > 0 else -1
        yield row, extreme(function, sign, float(xs[row, k]), float(xs[row, k + 2]))


def _gap(one: NumericMembership, other: NumericMembership, x: float) -> float:
    return one(x) - other(x)


def _log_ratio(one: NumericMembership, other: NumericMembership, x: float) -> float:
    above, below = one(x), other(x)
    return (log(above) if above > 0 else -inf) - (log(below) if below > 0 else -inf)
