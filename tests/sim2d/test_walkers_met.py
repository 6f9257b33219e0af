"""The robot waits beside the path of a person who walks; it follows nobody, and asks nobody twice."""

from __future__ import annotations

import math
from collections.abc import Callable

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from walkers_study import BEHIND_DEG, NEAR_M, approached_again_m, episode, longest_behind_s

from comity_sim2d import DockingPose, Person, RobotBody, Room, Scene, Sensor, Walk, World, docked
from comity_sim2d.pose import Twist
from comity_sim2d.robot.walkers_met import WALK_M, gap_in_words

FOLLOWS_S, BRAKES_S = 1.5, 0.9
"""Longest drive after a person who walks away [s]: in the study's rooms, and once the robot has seen it."""
POSE = DockingPose(0.8, 0.0)
HALL = Room.rectangle(14.0, 8.0)


def hall(
    walk: Walk | None = None,
    *,
    at: tuple[float, float] = (2.0, 4.0),
    facing: float = 0.0,
    own_m: float = 0.8,
) -> World:
    """Ada in a hall, with a robot in its middle that is told to go to her."""
    ada = Person("p0", *at, facing, personal_distance_m=own_m, walk=walk)
    world = World(Scene(HALL, RobotBody(7.0, 2.0), (ada,)))
    world.robot.navigate("p0", DockingPose(own_m, 0.0), speed_m_s=0.7)
    return world


def walk_on(world: World, velocity: Callable[[float], tuple[float, float]], for_s: float) -> None:
    """Let her walk with a velocity in polar form, speed and course, that depends on the time."""
    end_s = world.time_s + for_s
    while world.time_s < end_s and world.robot.motion().state != "declined":
        ada = world.people[0]
        speed, course = velocity(world.time_s)
        x, y = ada.pose._replace(heading_rad=course).ahead(speed * world.step_s)
        world.move_person("p0", x, y, course)
        world.step()


def stands(world: World) -> tuple[float, float]:
    """How the robot stands to her: the distance between the bodies, and the bearing without its sign."""
    found = docked(world.robot.pose, world.scene.robot.radius_m, world.people[0])
    return found.distance_m, abs(found.bearing_deg)


@settings(max_examples=10, deadline=None)
@given(
    speed=st.floats(0.3, 1.5),
    start=st.tuples(st.floats(1.0, 13.0), st.floats(1.0, 7.0)),
    end=st.tuples(st.floats(1.0, 13.0), st.floats(1.0, 7.0)),
    stops=st.booleans(),
)
def test_the_robot_follows_no_walker_from_behind(speed, start, end, stops) -> None:
    """They have walked by 0.3 m before it knows."""
    if math.dist(start, end) < 0.5 or math.dist(start, (7.0, 2.0)) < 0.6:
        return
    world = hall(Walk((end, start), loop=True, speed_m_s=speed, stops=stops), at=start)
    world.run(20.0)
    assert longest_behind_s(world.frames) <= WALK_M / speed + BRAKES_S


@settings(max_examples=10, deadline=None)
@given(speed=st.floats(0.4, 1.2), y=st.floats(1.5, 4.5))
def test_a_person_who_walks_by_has_declined_and_is_not_approached_again(speed, y) -> None:
    """The robot, 2 m from the wall, is next to their path in time."""
    world = hall(at=(2.0, y))
    walk_on(world, lambda _: (speed, 0.0), 11.0 / speed)
    assert world.robot.motion().state == "declined"
    assert world.robot.motion().text.startswith("walked by the robot, ")
    assert approached_again_m(world, 0.8) < 0.1
    world.robot.dock("p0", POSE, speed_m_s=0.4)
    assert world.robot.motion().state == "declined"


@pytest.mark.parametrize(("gap_m", "told"), [(-0.06, "0.0 m"), (-0.01, "0.0 m"), (0.86, "0.9 m")])
def test_no_gap_is_told_below_zero_though_noise_lets_bodies_overlap(gap_m, told) -> None:
    assert gap_in_words(gap_m) == told


@settings(max_examples=8, deadline=None)
@given(speed=st.floats(0.4, 0.9), own_m=st.floats(0.45, 1.6))
def test_whatever_their_own_distance_the_robot_waits_where_it_can_offer_to_talk(speed, own_m) -> None:
    """A person who walks by has seen it ahead, and has declined."""
    world = hall(own_m=own_m)
    walk_on(world, lambda _: (speed, 0.0), 11.0 / speed)
    assert world.robot.motion().state == "declined"


@settings(max_examples=6, deadline=None)
@given(speed=st.floats(1.2, 1.4), y=st.floats(3.0, 3.4))
def test_who_passes_as_the_visit_begins_has_not_declined(speed, y) -> None:
    """Ada sees the robot ahead for a second, and is past it within the next."""
    world = hall(at=(5.4, y))
    walk_on(world, lambda _: (speed, 0.0), 3.0)
    assert world.robot.motion().state != "declined"


@settings(max_examples=6, deadline=None)
@given(speed=st.floats(0.4, 1.4), facing=st.floats(-math.pi, math.pi))
def test_who_sets_out_beside_the_robot_as_the_visit_begins_has_not_declined(speed, facing) -> None:
    """Ada stands within the distance of the visit, and did not pause there for the robot."""
    world = hall(Walk(((1.0, 7.0),), speed_m_s=speed), at=(6.0, 2.6), facing=facing)
    world.run(2.0)
    assert world.robot.motion().state != "declined"


@settings(max_examples=6, deadline=None)
@given(speed=st.floats(0.4, 0.9))
def test_the_robot_waits_ahead_in_view_outside_her_path_and_her_space(speed) -> None:
    world = hall()
    walk_on(world, lambda _: (speed, 0.0), 0.6 * 5.0 / speed)
    distance_m, bearing_deg = stands(world)
    before = world.robot.pose.xy
    walk_on(world, lambda _: (speed, 0.0), 0.5)
    assert math.dist(world.robot.pose.xy, before) < 0.05
    assert bearing_deg < 60.0
    reach_m = world.scene.robot.radius_m + world.people[0].radius_m
    assert abs(world.robot.pose.y_m - world.people[0].y_m) - reach_m >= 0.8 - 0.05
    assert distance_m > 0.8


def test_a_person_who_stops_is_approached_like_any_other() -> None:
    world = hall()
    walk_on(world, lambda _: (0.8, 0.0), 5.0)
    assert "waiting for p0" in world.robot.motion().text
    while world.robot.motion().state != "succeeded":
        world.step()
    world.robot.dock("p0", POSE, speed_m_s=0.5)
    while world.robot.motion().state != "succeeded":
        world.step()
    assert stands(world)[0] == pytest.approx(0.8, abs=0.01)


@pytest.mark.parametrize("sensor", [Sensor(), Sensor(0.03, 0.1)])
@pytest.mark.parametrize("speed", [0.5, 1.0, 1.4])
@pytest.mark.parametrize("y", [1.5, 3.0, 4.3])
def test_two_wheels_turn_to_who_would_stop_for_them_before_they_have_walked_by(speed, y, sensor) -> None:
    """They were on their way to a better place, with their front elsewhere, and she was taken to decline."""
    ann = Person(
        "p0", 12.0, y, math.pi, walk=Walk(((1.0, 4.4), (12.0, y)), loop=True, speed_m_s=speed, stops=True)
    )
    world = World(Scene(HALL, RobotBody(3.0, 2.7, sensor=sensor, drive="differential"), (ann,)), 10)
    world.robot.dock("p0", POSE, speed_m_s=0.7)
    while world.robot.motion().state != "succeeded":
        world.step()
        assert world.robot.motion().state != "declined"
        assert world.time_s < 40.0


def test_who_stopped_for_two_wheels_stays_while_they_turn_to_their_place_before_her() -> None:
    walk = Walk(((7.5, 4.8), (0.6, 3.6)), loop=True, speed_m_s=0.65, stops=True)
    ann = Person("p0", 9.0, 5.0, math.pi, walk=walk)
    robot = RobotBody(3.5, 5.3, sensor=Sensor(0.03, 0.1), drive="differential")
    world = World(Scene(Room.rectangle(10.0, 6.0), robot, (ann,)), 36)
    world.robot.dock("p0", POSE, speed_m_s=0.5)
    while world.robot.motion().state != "succeeded":
        world.step()
        assert world.robot.motion().state != "declined"


@pytest.mark.parametrize(
    ("does", "velocity"),
    [
        ("turned away from", lambda near: (0.6, math.radians(100.0) if near else 0.0)),
        ("sped up before", lambda near: (1.2 if near else 0.4, 0.0)),
        ("walked by", lambda near: (0.6, 0.0)),
    ],
)
def test_turning_away_speeding_up_and_walking_by_are_told_apart(does, velocity) -> None:
    world = hall()
    began_s: list[float] = []

    def now(t: float) -> tuple[float, float]:
        if stands(world)[0] < 1.5 and not began_s:
            began_s.append(t)
        return velocity(bool(began_s) and t > began_s[0] + 1.2)

    walk_on(world, now, 30.0)
    assert does in world.robot.motion().text


def test_a_person_who_stands_before_they_turn_away_has_declined() -> None:
    """What the robot offered still stands while they do, and while they turn."""
    world = hall()

    def paces(t: float) -> tuple[float, float]:
        turned_s = t - (stood_s[0] if stood_s else t)
        if stands(world)[0] < 1.4 and not stood_s:
            stood_s.append(t)
        return (0.6, 0.0) if not stood_s else (0.0, 0.0) if turned_s < 0.4 else (0.6, math.pi)

    stood_s: list[float] = []
    walk_on(world, paces, 30.0)
    assert stood_s
    assert "turned away from" in world.robot.motion().text


@settings(max_examples=6, deadline=None)
@given(pause_s=st.floats(6.4, 6.8), drive=st.sampled_from(["omnidirectional", "differential"]))
def test_a_person_who_leaves_at_the_end_of_a_pause_has_declined(pause_s, drive) -> None:
    """The robot had come to them while they stood: that was its one attempt."""
    walk = Walk(((9.0, 2.0), (9.0, 6.0), (2.0, 6.0)), speed_m_s=1.1, pauses_s=(pause_s, 0.0, 0.0))
    ada = Person("p0", 13.0, 2.0, math.pi, personal_distance_m=0.8, walk=walk)
    world = World(Scene(HALL, RobotBody(4.0, 2.0, drive=drive), (ada,)))
    for goes, speed_m_s in ((world.robot.navigate, 0.7), (world.robot.dock, 0.4)):
        goes("p0", POSE, speed_m_s=speed_m_s)
        while world.robot.motion().state == "running" and world.time_s < 40.0:
            world.step()
    assert "turned away from the robot" in world.robot.motion().text
    assert approached_again_m(world, 0.8) < 0.01


def test_a_step_is_no_walk_and_declines_nothing() -> None:
    world = hall(at=(5.5, 2.0))
    world.run(1.0)
    walk_on(world, lambda _: (0.4, math.pi), 0.5)
    world.run(1.0)
    assert world.robot.motion().state in ("running", "succeeded")
    assert "waiting" not in world.robot.motion().text


def draw_back(world: World, by_m: float, speed_m_s: float) -> None:
    """Let her go back from the robot, facing it."""
    for _ in range(round(by_m / (speed_m_s * world.step_s))):
        ada = world.people[0]
        world.move_person("p0", ada.x_m + speed_m_s * world.step_s, ada.y_m, math.pi)
        world.step()


def test_a_person_who_gives_ground_slowly_does_not_walk_and_is_followed() -> None:
    world = hall(at=(8.5, 2.0), facing=math.pi)
    world.run(1.0)
    world.robot.dock("p0", POSE, speed_m_s=0.5)
    draw_back(world, 2.0, 0.2)
    assert stands(world)[0] == pytest.approx(0.8, abs=0.05)


@settings(max_examples=8, deadline=None)
@given(speed=st.floats(0.3, 0.6), start_m=st.floats(1.5, 2.0))
def test_a_person_who_keeps_drawing_back_has_declined_and_is_not_pursued(speed, start_m) -> None:
    world = hall(at=(7.45 + start_m, 2.0), facing=math.pi)
    world.run(1.0)
    world.robot.dock("p0", POSE, speed_m_s=0.5)
    world.run(1.0)
    before_m = world.robot.pose.x_m
    draw_back(world, 3.0, speed)
    world.run(1.0)
    assert "drew back from the robot" in world.robot.motion().text
    assert world.robot.pose.x_m - before_m < 1.6
    assert approached_again_m(world, 0.8) < 0.01


@settings(max_examples=8, deadline=None)
@given(
    step_m=st.floats(0.05, 0.5),
    speed=st.floats(0.3, 0.6),
    on_its_way_s=st.floats(0.0, 3.0),
    delay_s=st.sampled_from([0.0, 0.1, 0.3]),
)
def test_one_step_back_declines_nothing_and_the_robot_keeps_its_distance(
    step_m, speed, on_its_way_s, delay_s
) -> None:
    ada = Person("p0", 8.5, 2.0, math.pi, personal_distance_m=0.8)
    world = World(Scene(HALL, RobotBody(7.0, 2.0, sensor=Sensor(delay_s=delay_s)), (ada,)))
    world.run(1.0)
    world.robot.dock("p0", POSE, speed_m_s=0.5)
    world.run(on_its_way_s)
    draw_back(world, step_m, speed)
    world.run(4.0)
    assert world.robot.motion().state == "succeeded"
    assert stands(world)[0] == pytest.approx(0.8, abs=0.02)


@pytest.mark.parametrize("drive", ["omnidirectional", "differential"])
@pytest.mark.parametrize("sigma_m", [0.0, 0.03])
def test_a_scared_person_who_stands_is_left_and_not_driven_into_a_corner(drive, sigma_m) -> None:
    shy = Person("p0", 9.0, 4.0, math.pi, reacts="scared")
    robot = RobotBody(5.0, 4.0, drive=drive, sensor=Sensor(sigma_m=sigma_m))
    world = World(Scene(HALL, robot, (shy,)))
    for goes in (world.robot.navigate, world.robot.dock):
        goes("p0", POSE, speed_m_s=0.5)
        while world.robot.motion().state == "running" and world.time_s < 30.0:
            world.step()
    assert "drew back from the robot" in world.robot.motion().text
    assert math.dist(world.people[0].xy, (9.0, 4.0)) < 2.0
    assert approached_again_m(world, 0.8) < 0.01


def test_beside_a_person_who_agreed_the_robot_goes_along_and_not_behind() -> None:
    world = hall(Walk(((12.0, 4.0),), speed_m_s=0.4, accompanied=True))
    world.run(2.0)
    world.robot.dock("p0", DockingPose(0.8, -90.0), speed_m_s=0.4)
    beside_s = 0.0
    while world.people[0].x_m < 11.5:
        world.step()
        distance_m, bearing_deg = stands(world)
        beside_s += world.step_s * (distance_m < 0.9 and 60.0 < bearing_deg < 120.0)
    assert beside_s > 5.0
    assert longest_behind_s(world.frames) == 0.0


def test_a_robot_on_two_wheels_goes_along_with_nobody() -> None:
    """It could not face them: it waits, and is passed, as by anybody who walks."""
    ada = Person("p0", 2.0, 4.0, 0.0, walk=Walk(((12.0, 4.0),), speed_m_s=0.4, accompanied=True))
    world = World(Scene(HALL, RobotBody(7.0, 2.0, drive="differential"), (ada,)))
    world.robot.navigate("p0", POSE, speed_m_s=0.7)
    while world.robot.motion().state == "running" and world.time_s < 30.0:
        world.step()
    assert world.robot.motion().state == "declined"
    assert "walked by" in world.robot.motion().text
    assert longest_behind_s(world.frames) == 0.0


@settings(max_examples=8, deadline=None)
@given(
    speed=st.floats(0.6, 1.2),
    y=st.floats(1.5, 4.5),
    drive=st.sampled_from(["omnidirectional", "differential"]),
)
def test_a_person_who_agreed_to_company_and_walks_by_too_fast_for_it_has_declined(speed, y, drive) -> None:
    """One attempt, as with any other; at most 0.5 m/s the robot goes along."""
    walk = Walk(((13.0, y), (1.0, y)), loop=True, speed_m_s=speed, accompanied=True)
    ada = Person("p0", 2.0, y, 0.0, personal_distance_m=0.8, walk=walk)
    world = World(Scene(HALL, RobotBody(7.0, 2.0, drive=drive), (ada,)))
    world.robot.navigate("p0", POSE, speed_m_s=0.7)
    while world.robot.motion().state == "running" and world.time_s < 60.0:
        world.step()
    assert world.robot.motion().state == "declined"
    assert approached_again_m(world, 0.8) < 0.01


@pytest.mark.parametrize("walk", [{"speed_m_s": 0.4}, {"speed_m_s": 0.7, "accompanied": True}])
def test_beside_a_person_who_did_not_agree_or_walks_fast_the_robot_does_not_go(walk) -> None:
    world = hall(Walk(((12.0, 4.0),), **walk))
    world.run(2.0)
    world.robot.dock("p0", DockingPose(0.8, -90.0), speed_m_s=0.4)
    beside = 0
    while world.people[0].x_m < 11.5:
        before = world.robot.pose.x_m
        world.step()
        moves = world.robot.pose.x_m - before > 0.2 * world.step_s
        beside += moves and stands(world)[0] < 1.2
    assert beside * world.step_s < 0.5


@pytest.mark.parametrize("seed", range(6))
def test_random_rooms_hold_what_the_study_promises(seed: int) -> None:
    answer = episode(seed)
    assert answer["outcome"] in ("met", "declined", "missed")
    assert float(str(answer["behind_s"])) <= FOLLOWS_S
    assert answer["by_robot"] == 0
    assert float(str(answer.get("approached_m", 0.0))) < 0.1


def test_the_judge_sees_a_robot_that_follows(monkeypatch) -> None:
    world = hall(at=(9.0, 2.0))
    monkeypatch.setattr(world.robot, "control", lambda: Twist(0.5, 0.0, 0.0))
    walk_on(world, lambda _: (0.5, 0.0), 3.0)
    assert stands(world)[1] > BEHIND_DEG
    assert stands(world)[0] < NEAR_M
    assert longest_behind_s(world.frames) > 2.0
