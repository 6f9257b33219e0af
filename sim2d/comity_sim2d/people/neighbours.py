"""Neighbour lists: pairs of near people, kept until a person has moved far enough (Verlet 1967)."""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from comity_sim2d.people.social_force import Vectors

Indices = NDArray[np.intp]
VERY_FEW = 14
"""Number of people up to which all pairs are listed permanently (measured)."""
FEW = 50
"""Number of people up to which all pairs are examined; above it, a k-d tree finds the near ones."""


@lru_cache(maxsize=8)
def _all_pairs(count: int) -> tuple[Indices, Indices]:
    one, other = np.triu_indices(count, 1)
    return one, other


def pairs_within(at: Vectors, distance_m: float) -> tuple[Indices, Indices]:
    """All pairs of points within a distance, each once, in ascending order."""
    if len(at) <= FEW:
        one, other = _all_pairs(len(at))
        near = np.abs(at[other] - at[one]) <= distance_m
        return one[near], other[near]
    from scipy.spatial import cKDTree

    tree = cKDTree(np.column_stack([at.real, at.imag]))
    pairs = tree.query_pairs(distance_m, output_type="ndarray")
    pairs = pairs[np.lexsort((pairs[:, 1], pairs[:, 0]))]
    return pairs[:, 0], pairs[:, 1]


class NeighbourList:
    """The pairs within a distance, searched again only when a person has moved by half the skin.

    Args:
        distance_m: Maximum distance of pairs that matter [m].
        skin_m: Additional distance up to which pairs are listed, so that the list stays valid [m].
        moves: Whether each body moves at all, shape (n,); pairs of two static bodies are left out.
    """

    def __init__(self, distance_m: float, skin_m: float, moves: NDArray[np.bool_]) -> None:
        self._distance_m, self._skin_m, self._moves = distance_m, skin_m, moves
        self._lasts = len(moves) <= VERY_FEW
        self._listed_at: Vectors | None = None
        self.one: Indices = np.empty(0, dtype=np.intp)
        self.other: Indices = np.empty(0, dtype=np.intp)

    def update(self, at: Vectors) -> bool:
        """Ensure that the list is valid for these positions; returns whether it changed."""
        listed = self._listed_at
        if listed is not None and (self._lasts or np.abs(at - listed).max() <= self._skin_m / 2):
            return False
        self._listed_at = at.copy()
        one, other = pairs_within(at, np.inf if self._lasts else self._distance_m + self._skin_m)
        matters = self._moves[one] | self._moves[other]
        self.one, self.other = one[matters], other[matters]
        return True
