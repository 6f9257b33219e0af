"""When a person who turns on while the robot comes round to their front has turned away from it."""

from __future__ import annotations

import math

from hypothesis import given
from hypothesis import strategies as st

from comity_fis.proxemics import CLOSE_SOCIAL_M
from comity_sim2d import Person, docked
from comity_sim2d.pose import Pose
from comity_sim2d.robot.turning_away import TURNS_RAD, TurningAway

TURNS = st.lists(st.floats(-40.0, 40.0), min_size=2, max_size=20)


def turned(turns_deg: list[float], bearing_deg: float, gap_m: float = 0.8) -> bool:
    """Whether a person turns away, who turns each time, with the robot at one bearing."""
    turning, heading, found = TurningAway(), 0.0, False
    for turn_deg in turns_deg:
        heading += math.radians(turn_deg)
        at = Pose(*Pose(0.0, 0.0, heading).ahead(gap_m + 0.45, math.radians(bearing_deg)), 0.0)
        found |= turning.look(heading, docked(at, 0.25, Person("p0", 0.0, 0.0, heading)))
    return found


@given(TURNS, st.floats(65.0, 175.0), st.sampled_from([-1, 1]))
def test_turns_from_the_robot_add_up_and_turns_to_it_undo_them(turns_deg, off_deg, side) -> None:
    """The first heading is where they stood."""
    away, most = 0.0, 0.0
    for turn in turns_deg[1:]:
        away = max(0.0, away - side * turn)
        most = max(most, away)
    if abs(most - math.degrees(TURNS_RAD)) > 1e-6:
        assert turned(turns_deg, side * off_deg) == (most > math.degrees(TURNS_RAD))


@given(st.floats(-59.0, 59.0))
def test_who_faces_the_robot_does_not_turn_away_however_they_turn(bearing_deg) -> None:
    assert not turned([30.0] * 20, bearing_deg)


def test_far_from_the_robot_nobody_turns_away() -> None:
    assert not turned([-30.0] * 20, 100.0, CLOSE_SOCIAL_M + 0.01)
    assert turned([-30.0] * 20, 100.0, CLOSE_SOCIAL_M - 0.01)
