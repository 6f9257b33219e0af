"""Output sets cut into panels in which nothing happens to them, for many people at once.

In a panel a set is smooth and has no corner, so that Gauss and Kronrod's rule gives its area and moment to
rounding. Where it does not (the far tail of a curve under a very weak rule) the panel is halved, a bounded
number of times.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from comity_fis.defuzzification.corners import Corners, corners_of
from comity_fis.defuzzification.gauss_kronrod import integrals, places_in
from comity_fis.defuzzification.ground import Ground
from comity_fis.defuzzification.sets import Sets

Floats = NDArray[np.float64]
Whole = NDArray[np.intp]

TOLERANCE = 1e-12
"""Of a set's area: what area and moment may be off by in one panel."""

MOST_HALVINGS = 40

CHUNK = 150_000
"""Degrees in one array: 1.2 MB, which stays in the processor's cache."""


@dataclass(frozen=True, slots=True)
class Panels:
    """All panels of several people, one person after the other, from low to high."""

    sets: Sets
    person: Whole
    """Whose it is."""
    left: Floats
    right: Floats
    area: Floats
    moment: Floats
    """About the low end of the range."""

    def of_people(self, amounts: Floats) -> Floats:
        """The sum of an amount over each person's panels."""
        return np.asarray(np.bincount(self.person, amounts, self.sets.count), dtype=np.float64)


Pieces = tuple[NDArray[Any], ...]
"""Of panels: whose they are, where they start and end, area, moment."""


def panels_of(sets: Sets) -> Panels:
    """All panels."""
    people = max(1, CHUNK // max(sets.ground.degrees[0].size, sets.ground.left.size * len(sets.terms)))
    parts = []
    for start in range(0, sets.count, people):
        person, *amounts = _panels(sets.part(slice(start, start + people)))
        parts.append((person + start, *amounts))
    return Panels(sets, *_joined(parts))


def _panels(sets: Sets) -> Pieces:
    """The panels of a few people: those of the ground, but where a set has corners in one of them."""
    ground = sets.ground
    area, moment, error = integrals(sets.on_ground(), ground.left, ground.right, *ground.frame)
    allowed = TOLERANCE * area.sum(axis=1)
    corners = corners_of(sets)
    cut = np.zeros(area.shape, dtype=bool)
    cut[corners.person, corners.panel] = True
    coarse = ~cut & (error > allowed[:, None])
    found = [_whole(ground, area, moment, ~cut & ~coarse)]
    person, panel = np.nonzero(coarse)
    parts = _joined([_parts(corners, ground), (person, ground.left[panel], ground.right[panel])])
    found += _refined(sets, *parts, allowed=allowed)
    pieces = _joined(found)
    order = np.lexsort((pieces[1], pieces[0]))
    return tuple(one[order] for one in pieces)


def _whole(ground: Ground, area: Floats, moment: Floats, which: NDArray[np.bool_]) -> Pieces:
    """Panels of the ground, by person."""
    person, panel = np.nonzero(which)
    return person, ground.left[panel], ground.right[panel], area[which], moment[which]


def _parts(corners: Corners, ground: Ground) -> Pieces:
    """The parts of panels that corners cut them into: whose they are, where they start and end."""
    person, panel, place = corners
    cut = np.unique(np.column_stack([person, panel]), axis=0)
    person, panel = np.concatenate([cut[:, 0], person]), np.concatenate([cut[:, 1], panel])
    left = np.concatenate([ground.left[cut[:, 1]], place])
    order = np.lexsort((left, panel, person))
    person, panel, left = person[order], panel[order], left[order]
    goes_on = (person[1:] == person[:-1]) & (panel[1:] == panel[:-1])
    right = ground.right[panel]
    right[:-1][goes_on] = left[1:][goes_on]
    wide = right > left
    return person[wide], left[wide], right[wide]


def _refined(sets: Sets, person: Whole, left: Floats, right: Floats, *, allowed: Floats) -> list[Pieces]:
    """Panels, halved until each errs by no more than allowed."""
    done: list[Pieces] = []
    for halving in range(MOST_HALVINGS + 1):
        if not person.size:
            break
        degrees = sets.at(person, places_in(left, right))
        area, moment, error = integrals(degrees, left, right, *sets.ground.frame)
        fine = (error <= allowed[person]) | (halving == MOST_HALVINGS)
        done.append((person[fine], left[fine], right[fine], area[fine], moment[fine]))
        person, left, right = person[~fine], left[~fine], right[~fine]
        middle = (left + right) / 2
        person = np.concatenate([person, person])
        left, right = np.concatenate([left, middle]), np.concatenate([middle, right])
    return done


def _joined(parts: Iterable[Pieces]) -> Pieces:
    """Arrays behind those of the same kind."""
    return tuple(map(np.concatenate, zip(*parts, strict=True)))
