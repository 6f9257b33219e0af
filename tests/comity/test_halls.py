"""Nobody who walks about in a hall is touched by the robot that crosses it: the sample of `hall_study`."""

from __future__ import annotations

import pytest
from hall_study import KINDS, crossed


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("seed", [116, 174])
def test_a_robot_that_crosses_a_hall_touches_no_passer_by(kind, seed):
    assert crossed(kind, seed).touches_by_robot == 0


@pytest.mark.study
@pytest.mark.parametrize("kind", KINDS)
def test_in_many_halls_too(kind):
    found = [crossed(kind, seed) for seed in range(200)]
    assert sum(one.touches_by_robot for one in found) == 0
    assert sum(one.served for one in found) >= 0.99 * len(found)
