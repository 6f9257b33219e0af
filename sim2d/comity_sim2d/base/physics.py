"""The bodies in pymunk: the robot can be pushed; people, walls and furniture do not budge.

The robot is a dynamic body attached to a kinematic control body by a pivot and a gear joint. It follows
velocities exactly while nothing blocks it, and collides with static bodies (kinematic bodies do not).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import pymunk
from numpy.typing import NDArray
from pymunk.constraints import GearJoint, PivotJoint

from comity_sim2d.clock import Clock
from comity_sim2d.pose import Pose, Twist
from comity_sim2d.scene.door import Door
from comity_sim2d.scene.person import Person
from comity_sim2d.scene.robot_body import RobotBody
from comity_sim2d.scene.scene import Scene

ROBOT, OTHER = 1, 2
"""Collision types."""
NEAR_M = 0.6
"""Passers-by farther away than this [m] cannot be touched before their next decision."""
MASS_KG = 20.0
DRIVE_N, DRIVE_N_M = 400.0, 100.0
"""Maximum force [N] and torque [N m] of the drive: 20 m/s^2, far above any command, but too little to move a
wall."""


@dataclass(frozen=True, slots=True)
class Touch:
    """A contact of the robot with a person or an object."""

    t: float
    """When it began, to the tick [s]."""
    entity: str
    """The person's or the furniture's name, `wall 2`, `door NAME`, or `room`."""


class Physics:
    """One pymunk space with all bodies."""

    def __init__(self, scene: Scene, clock: Clock, hz: int) -> None:
        self._clock = clock
        self._hz = hz
        self._space = pymunk.Space()
        self._names: dict[pymunk.Shape, str] = {}
        self.touches: list[Touch] = []
        for outline in scene.room.outlines:
            self._add_outline("room", outline)
        for i, wall in enumerate(scene.walls, start=1):
            self._add_line(wall.name or f"wall {i}", wall.start, wall.end, wall.thickness_m / 2)
        for piece in scene.furniture:
            self._add_outline(piece.name, piece.corners)
        self._shut: dict[str, pymunk.Shape] = {}
        for door in scene.doors:
            self.set_door(door)
        self._people = {person.name: self._add_person(person) for person in scene.people}
        self._passing: list[tuple[pymunk.Body, pymunk.Shape]] = []
        self._present: list[int] = []
        self._robot_radius_m = scene.robot.radius_m
        self._robot = self._add_robot(scene.robot)
        self._control = self._add_control(self._robot)
        self._commanded: Twist | None = None
        self._pose: Pose | None = None
        self._twist: Twist | None = None
        self._space.on_collision(ROBOT, OTHER, begin=self._on_touch)

    @property
    def step_s(self) -> float:
        """Length of one physics step [s]."""
        return 1.0 / self._hz

    @property
    def pose(self) -> Pose:
        """Pose of the robot."""
        if self._pose is None:
            self._pose = Pose(*self._robot.position, self._robot.angle)
        return self._pose

    @property
    def twist(self) -> Twist:
        """Velocity of the robot."""
        if self._twist is None:
            self._twist = Twist(*self._robot.velocity, self._robot.angular_velocity)
        return self._twist

    def command(self, twist: Twist) -> None:
        """Set the velocity of the drive; the body takes it up at the end of its next step."""
        if twist != self._commanded:
            self._commanded = twist
            self._control.velocity = twist.xy
            self._control.angular_velocity = twist.turn_rad_s

    def run(self, steps: int) -> None:
        """Advance by a number of steps."""
        step, step_s = self._space.step, self.step_s
        for _ in range(steps):
            step(step_s)
        self._pose = self._twist = None

    def place(self, person: Person) -> None:
        """Move a person's body to where they are."""
        body = self._people[person.name]
        body.position = person.pose.xy
        body.angle = person.heading_rad
        self._space.reindex_shapes_for_body(body)

    def add_passers_by(self, names: Sequence[str], radius_m: Sequence[float]) -> None:
        """Create bodies for people who are not of the scene; they take effect once near the robot."""
        for name, radius in zip(names, radius_m, strict=True):
            body = pymunk.Body(body_type=pymunk.Body.KINEMATIC)
            shape = pymunk.Circle(body, radius)
            shape.collision_type = OTHER
            self._names[shape] = name
            self._passing.append((body, shape))
        self._near_m = np.array(radius_m) + (self._robot_radius_m + NEAR_M)

    def look_for_passers_by(self, at: NDArray[np.complex128]) -> None:
        """Activate the bodies of passers-by near the robot, and remove the others."""
        near = (np.abs(at - complex(*self.pose.xy)) < self._near_m).nonzero()[0].tolist()
        if near != self._present:
            for i in sorted({*self._present} - {*near}):
                self._space.remove(*self._passing[i])
            for i in sorted({*near} - {*self._present}):
                self._space.add(*self._passing[i])
            self._present = near

    def place_passers_by(self, at: NDArray[np.complex128]) -> None:
        """Move the active passers-by to their positions [m], x + iy."""
        for i in self._present:
            body, place = self._passing[i][0], complex(at[i])
            body.position = (place.real, place.imag)
            self._space.reindex_shapes_for_body(body)

    def set_door(self, door: Door) -> None:
        """Shut or open a door; a shut door is a wall."""
        shut = self._shut.pop(door.name, None)
        if shut is not None:
            self._names.pop(shut)
            self._space.remove(shut)
        if not door.is_open:
            body = self._space.static_body
            shape = pymunk.Segment(body, door.start, door.end, door.thickness_m / 2)
            self._shut[door.name] = shape
            self._add_shape(f"door {door.name}", shape)

    def _on_touch(self, arbiter: pymunk.Arbiter, space: pymunk.Space, data: object) -> None:
        other = next(shape for shape in arbiter.shapes if shape in self._names)
        self.touches.append(Touch(self._clock.now_s, self._names[other]))

    def _add_line(
        self, name: str, start: tuple[float, float], end: tuple[float, float], half_m: float
    ) -> None:
        self._add_shape(name, pymunk.Segment(self._space.static_body, start, end, half_m))

    def _add_outline(self, name: str, corners: tuple[tuple[float, float], ...]) -> None:
        for start, end in zip(corners, (*corners[1:], corners[0]), strict=True):
            self._add_line(name, start, end, 0.0)

    def _add_person(self, person: Person) -> pymunk.Body:
        body = pymunk.Body(body_type=pymunk.Body.KINEMATIC)
        body.position = person.pose.xy
        body.angle = person.heading_rad
        self._space.add(body)
        self._add_shape(person.name, pymunk.Circle(body, person.radius_m))
        return body

    def _add_shape(self, name: str, shape: pymunk.Shape) -> None:
        shape.collision_type = OTHER
        self._names[shape] = name
        self._space.add(shape)

    def _add_robot(self, robot: RobotBody) -> pymunk.Body:
        body = pymunk.Body(MASS_KG, pymunk.moment_for_circle(MASS_KG, 0.0, robot.radius_m))
        body.position = robot.pose.xy
        body.angle = robot.heading_rad
        shape = pymunk.Circle(body, robot.radius_m)
        shape.collision_type = ROBOT
        self._space.add(body, shape)
        return body

    def _add_control(self, robot: pymunk.Body) -> pymunk.Body:
        control = pymunk.Body(body_type=pymunk.Body.KINEMATIC)
        control.position = robot.position
        control.angle = robot.angle
        pivot = PivotJoint(control, robot, (0.0, 0.0), (0.0, 0.0))
        gear = GearJoint(control, robot, 0.0, 1.0)
        for joint, most in ((pivot, DRIVE_N), (gear, DRIVE_N_M)):
            joint.max_bias = 0.0  # velocities are held: the control body's own position has no meaning
            joint.max_force = most
        self._space.add(control, pivot, gear)
        return control


def foresee(pose: Pose, twist: Twist, step_s: float) -> Pose:
    """Pose of a body when a command takes effect: pymunk moves it once more at the old velocity."""
    return Pose(
        pose.x_m + twist.x_m_s * step_s,
        pose.y_m + twist.y_m_s * step_s,
        math.remainder(pose.heading_rad + twist.turn_rad_s * step_s, math.tau),
    )
