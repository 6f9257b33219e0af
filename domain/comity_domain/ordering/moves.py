"""Moves from an order of visits to others, many at once: 2-opt, Or-opt, and a larger change at random."""

from __future__ import annotations

import random
from collections.abc import Iterator
from functools import lru_cache
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Whole = NDArray[np.int64]

MOST_MOVED = 3
"""Visits in a row that Or-opt moves."""


@lru_cache(maxsize=16)
def all_moves(count: int) -> Whole:
    """Every 2-opt and Or-opt move in an order of so many visits, shape (moves, 5).

    A move (a, b, c, first, second) exchanges the visits from a to b and those from b to c; where a flag is 1,
    that part is reversed, too. 2-opt reverses a part (Croes 1958, Operations Research 6(6)). Or-opt moves up
    to three visits in a row elsewhere, either way round (Or 1976). Shuffled, always in the same way, so that
    any few of them are of all kinds.
    """
    import numpy as np

    moves = [*_two_opt(count), *_or_opt(count)]
    random.Random(count).shuffle(moves)
    return np.array(moves, dtype=np.int64).reshape(-1, 5)


def _two_opt(count: int) -> Iterator[tuple[int, ...]]:
    return ((a, b, b, 1, 0) for a in range(count) for b in range(a + 2, count + 1))


def _or_opt(count: int) -> Iterator[tuple[int, ...]]:
    for a in range(count):
        for b in range(a + 1, min(a + MOST_MOVED, count) + 1):
            for flip in (0, 1) if b > a + 1 else (0,):
                yield from ((a, b, c, flip, 0) for c in range(b + 1, count + 1))
                yield from ((start, a, b, 0, flip) for start in range(a))


def moved(order: Whole, moves: Whole) -> Whole:
    """The orders that moves lead to, shape (moves, visits)."""
    import numpy as np

    a, b, c, first, second = moves.T[:, :, None]
    place = np.arange(len(order))
    to_second, to_first = place - a, place - a - (c - b)
    in_second = np.where(second, c - 1 - to_second, b + to_second)
    in_first = np.where(first, b - 1 - to_first, a + to_first)
    inside = np.where(to_first < 0, in_second, in_first)
    return order[np.where((place < a) | (place >= c), place, inside)]


def double_bridge(order: Whole, draw: random.Random) -> Whole:
    """The order with two parts of it exchanged, wherever; four visits at least.

    No single 2-opt or Or-opt move undoes it (Martin, Otto, Felten 1991, Complex Systems 5(3)).
    """
    import numpy as np

    a, b, c = sorted(draw.sample(range(1, len(order)), 3))
    return np.concatenate([order[:a], order[b:c], order[a:b], order[c:]])
