"""When a person who moves away from the robot has retreated from it."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from comity_sim2d import Person, docked
from comity_sim2d.clock import Clock
from comity_sim2d.navigation.yielding import Walker
from comity_sim2d.pose import Pose
from comity_sim2d.robot.retreat import LASTS_S, RETREATS_M_S, Retreat

ROBOT = Pose(0.0, 0.0, 0.0)


def judged(retreat: Retreat, clock: Clock, gap_m: float, speed_m_s: float, lasts_s: float) -> bool:
    """Whether a person retreats, who faces the robot and moves away from a gap."""
    found = False
    for tick in range(round(lasts_s * clock.hz) + 1):
        person = Person("p0", 0.45 + gap_m + speed_m_s * tick / clock.hz, 0.0, math.pi)
        found |= retreat.look(Walker(person, (speed_m_s, 0.0)), docked(ROBOT, 0.25, person), ROBOT.xy)
        clock.tick += 1
    return found


@given(st.floats(-0.6, 0.6), st.floats(0.1, 0.8))
def test_a_person_retreats_by_moving_away_faster_than_the_least_speed(speed, gap) -> None:
    clock = Clock(20)
    if abs(speed - RETREATS_M_S) > 1e-3:
        assert judged(Retreat(clock), clock, gap, speed, LASTS_S) is (speed > RETREATS_M_S)


@pytest.mark.parametrize("lasts_s", [0.5, 1.0, 1.9])
def test_a_step_back_is_shorter_than_a_retreat(lasts_s) -> None:
    clock = Clock(20)
    assert not judged(Retreat(clock), clock, 0.8, 0.5, lasts_s)


def test_what_moves_the_person_while_the_robot_does_not_look_is_no_retreat() -> None:
    """A stop may hold the robot for a while."""
    clock = Clock(20)
    retreat = Retreat(clock)
    assert not judged(retreat, clock, 0.4, 0.2, 1.0)
    clock.tick += 30 * clock.hz
    assert not judged(retreat, clock, 1.2, 0.1, 1.0)


def test_after_a_walk_a_retreat_begins_again() -> None:
    clock = Clock(20)
    retreat = Retreat(clock)
    assert not judged(retreat, clock, 0.4, 0.5, 1.0)
    retreat.forget()
    clock.tick += clock.hz
    assert not judged(retreat, clock, 1.4, 0.5, 1.0)


@given(st.floats(-30.0, 30.0), st.floats(0.3, 0.5), st.floats(0.0, 4.0))
def test_drawing_back_from_a_robot_that_keeps_up_is_a_retreat_whenever_it_begins(
    off_deg, speed, begins_s
) -> None:
    """From where the robot is by then, a person off its line has hardly drawn back."""
    clock, off = Clock(20), math.radians(off_deg)
    retreat, found = Retreat(clock), False
    for tick in range(round((begins_s + LASTS_S) * clock.hz) + 3):
        way_m = speed * max(0.0, tick / clock.hz - begins_s)
        robot = Pose(way_m, 0.0, 0.0)
        person = Person("p0", 1.2 * math.cos(off) + way_m, 1.2 * math.sin(off), math.pi + off)
        found |= retreat.look(Walker(person, (speed, 0.0)), docked(robot, 0.25, person), robot.xy)
        clock.tick += 1
    assert found
