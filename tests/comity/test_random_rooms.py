"""In random rooms, among people who stand, walk and pass by, the robot comes at nobody: `room_study`."""

from __future__ import annotations

import pytest
from room_study import KINDS, MANY, episode, room, rooms_of


@pytest.mark.parametrize("kind", KINDS)
def test_the_robot_touches_nobody_and_serves_somebody_in_random_rooms(kind):
    found = [episode(kind, seed) for seed in range(2)]
    assert [each["by_robot"] for each in found] == [0, 0]
    assert sum(each["served"] for each in found) > 0


@pytest.mark.parametrize("seed", range(5))
def test_a_room_of_one_profile_is_the_same_room(seed):
    """All that is drawn besides profiles is as in the room of many profiles."""
    texts = (room("mix", seed), room("mix", seed, profile="unknown"))
    lines = zip(*(text.splitlines() for text in texts), strict=True)
    differing = [(one, other) for one, other in lines if one != other]
    assert differing
    assert all(one.split(", ", 1)[1] == other.split(", ", 1)[1] for one, other in differing)


@pytest.mark.study
@pytest.mark.parametrize("kind", KINDS)
def test_in_many_rooms_too(kind):
    assert sum(each["by_robot"] for each in rooms_of(kind, MANY[kind])) == 0
