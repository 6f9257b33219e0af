"""The pedestrians of a world: the people of the scene who may move, and the passers-by."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from comity_sim2d.clock import Clock
from comity_sim2d.people.collision_filter import Stride
from comity_sim2d.people.crowd import TURN, Bodies, Crowd
from comity_sim2d.people.itinerary import Itinerary
from comity_sim2d.people.outlines import Outlines
from comity_sim2d.people.pedestrian_behaviour import PedestrianBehaviour, Stroller
from comity_sim2d.people.social_force import Numbers, Vectors
from comity_sim2d.people.stepping_out import HEARD_M, SteppingOut, way_out
from comity_sim2d.pose import XY, Pose, Twist, wrap_angle
from comity_sim2d.scene.footpath import Footpaths
from comity_sim2d.scene.obstacles import FloorPlan, floor_plan
from comity_sim2d.scene.placing import Placed, place
from comity_sim2d.scene.robot_reaction import RobotSeen
from comity_sim2d.scene.walk_check import check_walks

if TYPE_CHECKING:
    from comity_sim2d.scene.person import Person
    from comity_sim2d.scene.scene import Scene

DECISIONS_HZ = 10
"""Rate of people's decisions [Hz]: the step of common social force models."""
WALKS_OFF_M_S = 1.0
"""Pace of a standing person who leaves because of the robot, if the reaction has none [m/s] (our choice)."""


class Pedestrians:
    """The people of one world who may move, with all other bodies as obstacles.

    Raises:
        SceneError: If a person cannot follow their walk, or there is no room for the passers-by.
    """

    def __init__(self, scene: Scene, clock: Clock, seed: int) -> None:
        check_walks(scene)
        self._scene, self._clock = scene, clock
        self._index = {person.name: i for i, person in enumerate(scene.people)}
        self._robot_radius_m = scene.robot.radius_m
        self._ticks = max(1, round(clock.hz / DECISIONS_HZ))
        decision_s = self._ticks * clock.step_s
        plan, placed = floor_plan(scene), place(scene, seed)
        self._plan = plan
        self.names = scene.passers_by.names if scene.passers_by else ()
        """Names of the passers-by."""
        self._paths = _paths(scene, plan)
        strollers = tuple(_strollers(scene, placed, self._paths))
        bodies = _bodies(scene, placed)
        self._strolling = PedestrianBehaviour(strollers, bodies.at, plan, decision_s)
        self._crowd = Crowd(
            bodies,
            strollers,
            self._strolling,
            Outlines.of(scene),
            step_s=clock.step_s,
            decision_s=decision_s,
            side=1.0 if scene.keep_to == "right" else -1.0,
            seed=seed,
        )
        self._first = len(scene.people)
        self.at: Vectors = self._crowd.at[self._first : -1]
        """Positions of the passers-by [m], x + iy; shape (m,). A view that moves with them."""
        self.radius_m: Numbers = self._crowd.radius_m[self._first : -1]
        """Radii of the passers-by [m], shape (m,)."""
        self._movers = [person.name for person in scene.people if person.may_move]
        self._keep_open(scene.people)

    @property
    def poses(self) -> Numbers:
        """Poses of the passers-by: x [m], y [m], heading [rad]; shape (m, 3)."""
        at, poses = self.at, np.empty((len(self.names), 3))
        poses[:, 0], poses[:, 1] = at.real, at.imag
        heading = self._crowd.heading[self._first : -1]
        poses[:, 2] = heading - TURN * np.rint(heading * (1.0 / TURN))
        return poses

    @property
    def discs(self) -> list[tuple[str, XY, float]]:
        """The passers-by: name, place and radius [m] of each."""
        places = zip(self.at.real.tolist(), self.at.imag.tolist(), strict=True)
        return list(zip(self.names, places, self.radius_m.tolist(), strict=True))

    def is_walking(self, name: str) -> bool:
        """Whether a person of the scene currently moves on their own."""
        return self._crowd.is_walking(self._index[name])

    def strides_but(self, name: str) -> list[Stride]:
        """Strides of all people except one until the next decision, without the robot."""
        crowd = self._crowd
        ahead = crowd.velocity[:-1] * (-self._clock.tick % self._ticks * self._clock.step_s)
        ends = crowd.at[:-1] + ahead
        rows = zip(crowd.at[:-1].tolist(), ends.tolist(), crowd.radius_m[:-1].tolist(), strict=True)
        mine = self._index[name]
        return [Stride(_xy(at), _xy(end), r) for i, (at, end, r) in enumerate(rows) if i != mine]

    def put(self, person: Person, people: Mapping[str, Person]) -> None:
        """Note that a person was moved by another person."""
        self._crowd.put(self._index[person.name], complex(*person.xy), person.heading_rad)
        if self._scene.groups:
            self._keep_open(people.values())

    def hold(self, name: str) -> None:
        """Suspend the own behaviour of a person of the scene while something else leads them.

        Others see how they are moved.
        """
        self._crowd.hold(self._index[name])

    def let_go(self, name: str, *, stays: bool) -> None:
        """Let them stay where they are, or resume their own behaviour."""
        self._crowd.let_go(self._index[name], stays=stays)

    def ask_to_pass(self, name: str, robot: XY, way: Sequence[XY]) -> bool:
        """Ask a passer-by to make way; returns whether they do.

        Args:
            name: The passer-by.
            robot: Position of the robot [m].
            way: The robot's intended path, which they infer from its pose.
        """
        i = self._first + self.names.index(name)
        at, radius_m = _xy(complex(self._crowd.at[i])), float(self._crowd.radius_m[i])
        if not way or not self._crowd.makes_way(i) or math.dist(at, robot) > HEARD_M:
            return False
        bodies = zip(self._crowd.at[:-1].tolist(), self._crowd.radius_m[:-1].tolist(), strict=True)
        others = [(place.real, place.imag, r) for k, (place, r) in enumerate(bodies) if k != i]
        body = (*robot, self._robot_radius_m)
        paths = self._paths[radius_m]
        out = way_out(at, way, body, radius_m=radius_m, others=others, plan=self._plan, paths=paths)
        if out is not None:
            self._crowd.make_way(i, SteppingOut(complex(*at), [complex(*bend) for bend in out]))
        return out is not None

    def go_on(self, name: str, robot: XY) -> None:
        """Let a person of the scene go on who stopped for the robot, if they hear that it wants to pass."""
        i = self._index[name]
        if math.dist(_xy(complex(self._crowd.at[i])), robot) <= HEARD_M:
            self._crowd.go_on(i)

    def use_plan(self, plan: FloorPlan) -> None:
        """Replace the floor plan."""
        self._plan = plan
        self._crowd.use_outlines(Outlines.of_plan(plan))
        for paths in self._paths.values():
            paths.use_plan(plan)
        self._strolling.use_plan(plan)

    @property
    def is_due(self) -> bool:
        """Whether people decide at this tick."""
        return (self._clock.tick - 1) % self._ticks == 0

    def decide(self, robot: Pose, twist: Twist) -> None:
        """Let all people choose their velocities, given the robot's pose and velocity."""
        seen = RobotSeen(complex(*robot.xy), complex(*twist.xy), robot.heading_rad, self._robot_radius_m)
        self._crowd.decide(seen)

    def step(self, people: Mapping[str, Person], move: Callable[[Person], None]) -> None:
        """Advance by one tick.

        Args:
            people: The people of the scene.
            move: Receives each person of the scene who has moved.
        """
        crowd = self._crowd
        crowd.advance()
        for name in self._movers:
            i, person = self._index[name], people[name]
            at, heading = complex(crowd.at[i]), wrap_angle(float(crowd.heading[i]))
            if at != complex(*person.xy) or heading != person.heading_rad:
                move(replace(person, x_m=at.real, y_m=at.imag, heading_rad=heading))

    def _keep_open(self, people: Iterable[Person]) -> None:
        """Update the o-spaces of the groups."""
        spaces = self._scene.o_spaces_among(people)
        self._crowd.o_spaces = (
            np.array([complex(*space.xy) for space in spaces], dtype=complex),
            np.array([space.radius_m for space in spaces]),
        )


def _paths(scene: Scene, plan: FloorPlan) -> dict[float, Footpaths]:
    """The footpaths, by body radius."""
    around = [(p.x_m, p.y_m, p.radius_m) for p in scene.people if not p.may_move]
    around += [(space.x_m, space.y_m, space.radius_m) for space in scene.o_spaces]
    return {radius: Footpaths(plan, radius, tuple(around)) for radius in sorted(_radii(scene))}


def _strollers(
    scene: Scene, placed: tuple[Placed, ...], paths: Mapping[float, Footpaths]
) -> Iterator[Stroller]:
    """All people who may move, those of the scene first."""
    for i, person in enumerate(scene.people):
        if not person.may_move:
            continue
        walk, known = person.walk, paths[person.radius_m]
        stops = [(person.xy, 0.0)] if walk is None else list(zip(walk.route, walk.stops_s, strict=True))
        yield Stroller(
            i,
            walk.speed_m_s if walk else WALKS_OFF_M_S,
            Itinerary(stops, loop=bool(walk and walk.loop), paths=known),
            reacts=person.reacts or "regular",
            stops=bool(walk and walk.stops),
            is_home=walk is None,
        )
    for i, one in enumerate(placed, len(scene.people)):
        assert scene.passers_by is not None
        stops = [(_xy(stop), 0.0) for stop in one.stops]
        path = paths[scene.passers_by.radius_m]
        yield Stroller(i, one.speed_m_s, Itinerary(stops, loop=True, paths=path), scene.passers_by.reacts)


def _radii(scene: Scene) -> set[float]:
    passing = {scene.passers_by.radius_m} if scene.passers_by else set()
    return passing | {person.radius_m for person in scene.people if person.may_move}


def _bodies(scene: Scene, placed: tuple[Placed, ...]) -> Bodies:
    """Positions, headings and radii of all bodies, the robot last."""
    robot, passers_by = scene.robot, scene.passers_by
    at = [complex(*person.xy) for person in scene.people] + [one.at for one in placed]
    heading = [person.heading_rad for person in scene.people]
    heading += [float(np.angle(one.stops[0] - one.at)) for one in placed]
    radius_m = [person.radius_m for person in scene.people]
    radius_m += [passers_by.radius_m if passers_by else 0.0] * len(placed)
    return Bodies(
        np.array([*at, complex(*robot.pose.xy)]),
        np.array([*heading, robot.heading_rad]),
        np.array([*radius_m, robot.radius_m]),
    )


def _xy(place: complex) -> XY:
    return (place.real, place.imag)
