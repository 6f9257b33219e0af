"""People whom noise puts into one another, into the robot or into walls are taken apart by little."""

from __future__ import annotations

import math
from dataclasses import replace

from hypothesis import given
from hypothesis import strategies as st

from comity_sim2d import Person, RobotBody, Room, Scene
from comity_sim2d.scene.obstacles import floor_plan
from comity_sim2d.senses.overlap_resolution import taken_apart

ROOM = Room.rectangle(6.0, 5.0)
ROBOT = RobotBody(3.0, 2.5)
NOISE_M = 0.1
TRUE = {
    "in a corner": (0.25, 0.25),
    "beside them": (0.66, 0.25),
    "at a wall": (5.79, 3.0),
    "at the robot": (3.55, 2.5),
    "behind them": (3.96, 2.5),
    "alone": (1.5, 4.0),
}
"""Where people touch one another, the robot or the room's edge, to within centimetres."""

noise = st.floats(-NOISE_M, NOISE_M)


def believed(offsets) -> tuple[Person, ...]:
    at = zip(TRUE.items(), offsets, strict=True)
    return tuple(Person(name, x + dx, y + dy, 0.0) for (name, (x, y)), (dx, dy) in at)


def apart(people) -> tuple[Person, ...]:
    return taken_apart(people, ROBOT, floor_plan(Scene(ROOM, robot=ROBOT)))


@given(st.lists(st.tuples(noise, noise), min_size=len(TRUE), max_size=len(TRUE)))
def test_whatever_noise_makes_of_a_scene_that_can_be_is_taken_apart_to_one(offsets) -> None:
    """And nobody is moved much farther than noise put them."""
    people = believed(offsets)
    found = apart(people)
    Scene(ROOM, robot=ROBOT, people=found)
    for before, after in zip(people, found, strict=True):
        assert replace(after, x_m=before.x_m, y_m=before.y_m) == before
        assert math.dist(before.xy, after.xy) <= 4.0 * NOISE_M


def test_who_overlaps_nothing_stays() -> None:
    people = believed([(0.0, 0.0)] * len(TRUE))
    assert all(after is before for before, after in zip(people, apart(people), strict=True))


def test_two_in_one_place_part_along_the_room() -> None:
    one, other = (Person(name, 1.5, 1.5, 0.0) for name in ("one", "other"))
    found = apart((one, other))
    assert math.dist(found[0].xy, found[1].xy) >= one.radius_m + other.radius_m
    assert found[0].y_m == found[1].y_m == 1.5
