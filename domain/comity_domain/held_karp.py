"""What the legs of the cheapest tour cost, exactly: dynamic programming over sets of people.

Held and Karp, "A dynamic programming approach to sequencing problems", SIAM Journal 10 (1962): the cheapest
way to have visited a set of people and to stand at one spot is the best of the cheapest ways with one person
less. It gives a number and no plan, in a small part of the time of a planner: all that rebinding needs.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from comity_domain.options import Options
from comity_domain.request import START

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

MOST_PEOPLE = 12
"""The table has 2^people rows."""
_NEVER = 2**40
"""Dearer than any tour, in cm."""


def cheapest_legs(options: Options) -> int | None:
    """The least that the legs of a tour through everybody cost, in cm; None where there is no tour.

    Args:
        options: Of 1 to `MOST_PEOPLE` people.
    """
    import numpy as np

    count = len(options.people)
    if not 1 <= count <= MOST_PEOPLE:
        raise ValueError(f"expected 1 to {MOST_PEOPLE} people, got {count}")
    start, legs, owner = _matrices(options)
    best = np.full((2**count, len(owner)), _NEVER, dtype=np.int64)
    for spot, person in enumerate(owner):
        best[1 << person, spot] = start[spot]
    sets = np.arange(2**count)
    sizes = np.array([one.bit_count() for one in range(2**count)])
    for size in range(1, count):
        visited = sets[sizes == size]
        onward = (best[visited][:, :, None] + legs[None]).min(axis=1)
        for spot, person in enumerate(owner):
            new = (visited >> person & 1) == 0
            longer = visited[new] | 1 << person
            best[longer, spot] = np.minimum(best[longer, spot], onward[new, spot])
    cheapest = int(best[-1].min())
    return cheapest if cheapest < _NEVER else None


def _matrices(options: Options) -> tuple[NDArray[np.int64], NDArray[np.int64], list[int]]:
    """The legs from the start, those between spots, and whose spot each is."""
    import numpy as np

    spots = [spot for person in options.people.values() for spot in person.spots()]
    people = list(options.people)
    start = np.array([options.legs.get((START, spot), _NEVER) for spot in spots], dtype=np.int64)
    legs = np.array(
        [[options.legs.get((one, other), _NEVER) for other in spots] for one in spots], dtype=np.int64
    )
    return start, legs, [people.index(spot.place) for spot in spots]
