"""Whatever brings the robot near a thing, it brakes at the last moment, and not before."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st
from judging import Body, touches_lines

from comity_sim2d import Furniture, Person, Pose, RobotBody, Room, RouteMap, Scene, Wall, World
from comity_sim2d.avoidance.emergency_braking import NEARLY_M, EmergencyBraking
from comity_sim2d.base.base import Base, BaseControl, VelocityCommand
from comity_sim2d.base.differential import Differential
from comity_sim2d.base.drive import hardest_braking
from comity_sim2d.base.omnidirectional import Omnidirectional
from comity_sim2d.navigation.docking import DockingPose
from comity_sim2d.navigation.yielding import Walker
from comity_sim2d.robot.approach import Approach, MovingTarget
from comity_sim2d.scene.obstacles import FloorPlan

STEP_S = 0.05
ROOM = Room.rectangle(12.0, 6.0)
BODY = RobotBody(1.0, 3.0)
DRIVES: dict[str, type[Omnidirectional | Differential]] = {
    "omnidirectional": Omnidirectional,
    "differential": Differential,
}


def moved(pose: Pose, control: BaseControl, base: Base, wanted: VelocityCommand, *, brakes: bool) -> Pose:
    """The pose a tick later; a base turns evenly during it."""
    twist = control.brake() if brakes else control.command(base, wanted, 1.5)
    turned = pose.heading_rad + twist.turn_rad_s * STEP_S
    return Pose(pose.x_m + twist.x_m_s * STEP_S, pose.y_m + twist.y_m_s * STEP_S, turned)


def touches(plan: FloorPlan, pose: Pose, radius_m: float = BODY.radius_m) -> bool:
    """As the judge of the study of encounters has it."""
    body = Body(0.0, pose.x_m, pose.y_m, 0.0, radius_m)
    lines = zip(plan.segments.ends.tolist(), plan.segments.half_m.tolist(), strict=True)
    return any(touches_lines(body, ends, half) for ends, half in lines)


@st.composite
def plans(draw: st.DrawFn) -> FloorPlan:
    """A box and a wall beyond it, ahead of a robot that drives to the right."""
    x, y, angle = draw(st.floats(4.0, 7.0)), draw(st.floats(2.3, 3.7)), draw(st.floats(-3.0, 3.0))
    box = Furniture.box("box", x, y, width_m=0.6, depth_m=0.4, angle_rad=angle)
    return FloorPlan(ROOM, (Wall((9.0, 1.0), (9.0, 5.0), draw(st.floats(0.02, 0.3))),), (box,))


@given(st.sampled_from(sorted(DRIVES)), plans(), st.floats(-0.6, 0.6), st.sampled_from([0.7, 1.5]))
@settings(max_examples=60, deadline=None)
def test_a_robot_that_is_steered_at_a_thing_stops_before_it(
    drive: str, plan: FloorPlan, aside: float, speed: float
) -> None:
    body = RobotBody(1.0, 3.0, drive=drive, max_speed_m_s=speed)
    control, moment, pose = DRIVES[drive](body, STEP_S), EmergencyBraking(body), Pose(1.0, 3.0, 0.0)
    wanted = VelocityCommand((speed * math.cos(aside), speed * math.sin(aside)), aside)
    for _ in range(400):
        base = control.base(pose)
        if brakes := moment.has_come(base, plan):
            break
        pose = moved(pose, control, base, wanted, brakes=False)
    assert brakes  # the room has walls, if nothing else is ahead
    while control.base(pose).speed_m_s:
        pose = moved(pose, control, control.base(pose), wanted, brakes=True)
    assert not touches(plan, pose)
    assert touches(plan, pose, BODY.radius_m + NEARLY_M + 2 * speed * STEP_S)  # not long before


@given(
    st.sampled_from(sorted(DRIVES)),
    st.floats(-0.4, 0.4),
    st.sampled_from([0.7, 1.5]),
)
@settings(max_examples=60, deadline=None)
def test_a_robot_that_is_steered_at_a_passer_by_stops_before_them(
    drive: str, aside_m: float, speed: float
) -> None:
    body = RobotBody(1.0, 3.0, drive=drive, max_speed_m_s=speed)
    control, moment, pose = DRIVES[drive](body, STEP_S), EmergencyBraking(body), Pose(1.0, 3.0, 0.0)
    people, reach_m = np.array([5.0 + (3.0 + aside_m) * 1j, 5.0 + 9.0j]), np.array([0.45, 0.45])
    wanted = VelocityCommand((speed, 0.0), 0.0)
    for _ in range(600):
        base = control.base(pose)
        if brakes := moment.has_come_before(base, people, reach_m):
            break
        pose = moved(pose, control, base, wanted, brakes=False)
    assert brakes
    while control.base(pose).speed_m_s:
        pose = moved(pose, control, control.base(pose), wanted, brakes=True)
    gap_m = abs(people[0] - complex(*pose.xy)) - 0.45
    assert 0.0 < gap_m < NEARLY_M + 2 * speed * STEP_S


@given(st.floats(-math.pi, math.pi), st.floats(0.0, 0.04), st.floats(0.05, 0.7), st.floats(1e-3, 0.5))
def test_it_does_not_brake_for_who_is_behind_or_beside_its_way(
    towards: float, gap_m: float, speed: float, off: float
) -> None:
    """At more than a right angle, or along a line that comes no nearer, however near they are."""
    base = Base(Pose(0.0, 0.0, 0.0), (speed, 0.0), 0.0, 0.5, STEP_S, 0.0)
    behind = math.cos(towards) < 0.0
    apart = 0.45 + gap_m
    place = apart * complex(math.cos(towards), math.sin(towards))
    if not behind:
        place = complex(place.real, math.copysign(0.45 + NEARLY_M + off, place.imag))
    assert not EmergencyBraking(BODY).has_come_before(base, np.array([place]), np.array([0.45]))


@given(st.floats(4.0, 7.0), st.floats(-3.0, 3.0), st.floats(0.2, 1.5), st.floats(-3.0, 3.0))
@settings(max_examples=60, deadline=None)
def test_a_robot_that_passes_a_thing_does_not_brake(
    x: float, angle: float, speed: float, course: float
) -> None:
    """However near: on a straight line at 11 mm from it there is no reason to."""
    box = Furniture.box("box", x, 3.0, width_m=0.6, depth_m=0.4, angle_rad=angle)
    plan, moment = FloorPlan(ROOM, (), (box,)), EmergencyBraking(BODY)
    ux, uy = math.cos(course), math.sin(course)
    across = [-uy * (cx - x) + ux * (cy - 3.0) for cx, cy in box.corners]
    off = max(across) + BODY.radius_m + NEARLY_M + 0.001
    for along in np.arange(-1.2, 1.2, 0.03).tolist():
        at = Pose(x + along * ux - off * uy, 3.0 + along * uy + off * ux, 0.0)
        assert not moment.has_come(Base(at, (speed * ux, speed * uy), 0.0, 0.5, STEP_S, 0.0), plan)


@given(st.floats(0.0, 0.02), st.floats(0.1, 0.7), st.floats(-1.5, 1.5))
@settings(max_examples=40, deadline=None)
def test_a_robot_that_was_pushed_to_a_wall_may_go_along_it_and_away(
    gap: float, speed: float, course: float
) -> None:
    plan, moment = FloorPlan(ROOM, (), ()), EmergencyBraking(BODY)
    velocity = (speed * math.cos(course), speed * math.sin(course))  # the wall is to the left
    at = Pose(BODY.radius_m + gap, 3.0, course)
    assert not moment.has_come(Base(at, velocity, 0.0, 0.5, STEP_S, 0.0), plan)
    back = (-velocity[0], -velocity[1])
    reach = gap + 1e-9 < back[0] * -(STEP_S + speed / (2 * hardest_braking(BODY)))
    assert moment.has_come(Base(at, back, 0.0, 0.5, STEP_S, 0.0), plan) or not reach


@given(st.floats(-math.pi, math.pi), st.floats(-math.pi, math.pi), st.floats(0.0, math.pi), st.booleans())
@example(heading=1.46, course=-1.17, beside=0.41, may_reverse=True)
@settings(max_examples=60, deadline=None)
def test_two_wheels_do_not_creep_up_to_the_end_of_a_wall(
    heading: float, course: float, beside: float, may_reverse: bool
) -> None:
    """Told to drive in any direction beside it for 20 s: a step and a brake at a time they would touch it."""
    plan = FloorPlan(ROOM, (Wall((6.0, 0.0), (6.0, 3.0), 0.1),), ())
    reach_m = BODY.radius_m + 0.05 + NEARLY_M
    pose = Pose(6.0 + reach_m * math.cos(beside), 3.0 + reach_m * math.sin(beside), heading)
    body = RobotBody(1.0, 3.0, drive="differential")
    control, moment = Differential(body, STEP_S), EmergencyBraking(body)
    wanted = VelocityCommand((0.2 * math.cos(course), 0.2 * math.sin(course)), heading, may_reverse)
    for _ in range(400):
        base = control.base(pose)
        brakes = moment.has_come(base, plan)
        pose = moved(pose, control, base, moment.turned(base, wanted, plan), brakes=brakes)
        assert not touches(plan, pose)


@given(st.integers(0, 2**32 - 1), st.floats(0.3, 0.7), st.sampled_from(sorted(DRIVES)))
@settings(max_examples=20, deadline=None)
def test_a_robot_that_lets_somebody_pass_brakes_on_its_way(seed: int, speed: float, drive: str) -> None:
    """Two wheels go where they turn: noise in how fast the goal moves must not turn them while they brake."""
    rng = np.random.default_rng(seed)
    body, anna = RobotBody(1.0, 3.0, drive=drive), Person("anna", 10.0, 3.0, math.pi)
    routes = RouteMap(Scene(ROOM, body, (anna,)))
    control, approach = DRIVES[drive](body, STEP_S), Approach("anna", DockingPose(0.8, 0.0), speed)
    pose = Pose(1.0, 3.0, 0.0)
    for tick in range(100):
        base = control.base(pose)
        omar = Walker(Person("omar", pose.x_m + 1.5, 3.0, math.pi), (-0.8, 0.0))
        vx, vy = rng.normal(0.0, 0.005, 2).tolist()
        walkers = (omar,) if tick >= 40 else ()
        velocity = approach.steer(base, MovingTarget((8.65, 3.0), (vx, vy)), routes, walkers)
        pose = moved(pose, control, base, VelocityCommand(velocity, math.pi / 2), brakes=False)
        assert abs(pose.y_m - 3.0) < 0.01
    assert approach.gives_way_to == "omar"
    assert control.base(pose).speed_m_s < 1e-6


@pytest.mark.parametrize("turns", [-1.0, 1.0])
def test_two_wheels_come_to_rest_before_they_turn_to_whom_they_are_to_look_at(turns: float) -> None:
    body = RobotBody(1.0, 3.0, drive="differential")
    control, pose = Differential(body, STEP_S), Pose(1.0, 3.0, 0.0)
    for _ in range(40):
        pose = moved(pose, control, control.base(pose), VelocityCommand((0.6, 0.0), 0.0), brakes=False)
    for _ in range(80):
        wanted = VelocityCommand((0.0, 0.0), turns * math.pi / 2)
        pose = moved(pose, control, control.base(pose), wanted, brakes=False)
    assert pose.heading_rad == pytest.approx(turns * math.pi / 2, abs=1e-3)
    assert abs(pose.y_m - 3.0) < 0.01


HOOK = ((3.0, 3.0), (5.0, 3.0), (5.0, 3.4), (3.4, 3.4), (3.4, 5.0), (3.0, 5.0))


@pytest.mark.parametrize("jerk", [0.1, 0.3, 0.5, 1.0, 3.0])
@pytest.mark.parametrize("limit", [0.3, 0.5, 1.5])
def test_two_wheels_of_little_jerk_get_round_a_corner_without_braking_before_it(jerk, limit, monkeypatch):
    """They come inside of their bends besides what aiming ahead does."""
    late: list[Pose] = []
    has_come = EmergencyBraking.has_come

    def noted(self: EmergencyBraking, base: Base, plan: FloorPlan) -> bool:
        if comes := has_come(self, base, plan):
            late.append(base.pose)
        return comes

    monkeypatch.setattr(EmergencyBraking, "has_come", noted)
    limits = {"max_jerk_m_s3": jerk, "max_acceleration_m_s2": limit}
    walls, table = (Wall((6.0, 0.0), (6.0, 3.0)),), Furniture("table", HOOK)
    world = docking(RobotBody(1.0, 1.0, 0.35, drive="differential", **limits), walls, table)
    while world.time_s < 60.0 and world.robot.motion().state != "succeeded":
        world.step()
    assert world.robot.motion().state == "succeeded"
    assert not late


@given(st.floats(0.001, NEARLY_M), st.floats(-3.1, 3.1), st.sampled_from([0.3, 1.0, 3.0, 20.0]))
@settings(max_examples=25, deadline=None)
def test_two_wheels_that_stand_right_beside_a_corner_leave_it(
    gap: float, heading: float, jerk: float
) -> None:
    """Braking before the corner, they go on turning; and then they go past it."""
    x, y = 5.0 + (0.25 + gap) * math.cos(-1.0), 3.0 + (0.25 + gap) * math.sin(-1.0)
    body = RobotBody(x, y, heading, drive="differential", max_jerk_m_s3=jerk)
    world = docking(body, (), Furniture("table", HOOK))
    while world.time_s < 60.0 and world.robot.motion().state != "succeeded":
        world.step()
    assert world.robot.motion().state == "succeeded", world.robot.motion().text
    assert not world.robot_touches


def docking(body: RobotBody, walls: tuple[Wall, ...], table: Furniture) -> World:
    """A world in which a robot is to dock to somebody behind a table's corner."""
    ada = Person("ada", 4.2, 4.2, -math.pi / 4)
    world = World(Scene(Room.rectangle(12.0, 8.0), body, (ada,), walls=walls, furniture=(table,)))
    world.robot.dock("ada", DockingPose(0.8, 45.0), speed_m_s=0.7)
    world.step()
    return world
