"""In random rooms, among people who stand, walk and pass by, the robot comes at nobody: `room_study`."""

from __future__ import annotations

from dataclasses import replace

import pytest
from room_study import ANSWERS, KINDS, MANY, episode, prepared, room, rooms_of


@pytest.mark.parametrize("kind", [*KINDS, *ANSWERS])
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


@pytest.mark.parametrize("seed", range(5))
def test_a_room_for_a_robot_that_does_not_see_all_round_is_the_same_room(seed):
    seeing, other = prepared("walk", seed).scene, prepared("walk", seed, view_deg=60).scene
    narrow = replace(seeing.robot.sensor, field_of_view_deg=60.0)
    assert other == replace(seeing, robot=replace(seeing.robot, sensor=narrow))


@pytest.mark.parametrize("seed", range(5))
@pytest.mark.parametrize("kind", ANSWERS)
def test_a_room_in_which_people_answer_is_the_room_in_which_they_stand(kind, seed):
    plain, answering = prepared("stand", seed).scene, prepared(kind, seed).scene
    assert answering.room == plain.room
    assert answering.furniture == plain.furniture
    assert answering.robot == replace(plain.robot, margin_m=answering.robot.margin_m)
    assert [one.pose for one in answering.people] == [one.pose for one in plain.people]
    assert all(one.steps_aside == (kind == "step aside") for one in answering.people)
    assert all(one.lets_pass == (kind == "let pass") for one in answering.people)


@pytest.mark.study
@pytest.mark.parametrize("kind", [*KINDS, *ANSWERS])
def test_in_many_rooms_too(kind):
    assert sum(each["by_robot"] for each in rooms_of(kind, MANY[kind])) == 0
