"""Nobody who walks about in a hall is touched by the robot that crosses it: the sample of `hall_study`."""

from __future__ import annotations

import pytest
from hall_study import KINDS, crossed, crossings

THING, WHEELS, SLUGGISH, CROWD = (list(KINDS)[i] for i in (0, 3, 4, 6))


@pytest.mark.parametrize(
    ("kind", "seed"),
    [(THING, 13), (THING, 116), (WHEELS, 116), (SLUGGISH, 9), (SLUGGISH, 172), (SLUGGISH, 174), (CROWD, 3)]
    + [(kind, 1) for kind in KINDS],
)
def test_a_robot_that_crosses_a_hall_touches_no_passer_by(kind, seed):
    """The first seeds are those of contacts with somebody who stopped or stepped in front of it."""
    crossing = crossed(kind, seed)
    assert crossing.touches_by_robot == 0
    assert crossing.served


@pytest.mark.study
@pytest.mark.parametrize("kind", KINDS)
def test_in_many_halls_too(kind):
    found = crossings(kind, 200)
    assert sum(one.touches_by_robot for one in found) == 0
    assert sum(one.served for one in found) >= 0.99 * len(found)
