"""The world: a scene simulated in time. Control at 20 Hz, physics at 60 Hz, one frame per tick."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import TYPE_CHECKING

from comity_fis.errors import WrongValueError
from comity_sim2d.base.physics import Physics, Touch
from comity_sim2d.clock import Clock
from comity_sim2d.frames import FrameRecorder, Frames, frame_row
from comity_sim2d.kinds import TRUTH, require_kinds
from comity_sim2d.maps.doorways import DoorTurn, Doorways
from comity_sim2d.maps.topology import topology
from comity_sim2d.navigation.route_map import RouteMap
from comity_sim2d.people.collision_filter import Stride, is_taken
from comity_sim2d.people.leading import Leads
from comity_sim2d.people.said import Said
from comity_sim2d.pose import Pose
from comity_sim2d.robot.acts import ActEvent
from comity_sim2d.robot.base_controller import BaseController
from comity_sim2d.robot.margins import MarginDecision
from comity_sim2d.robot.reduced_margin import check_margin
from comity_sim2d.robot.sim_robot import SimRobot
from comity_sim2d.scene.door import Door
from comity_sim2d.scene.group_check import check_groups
from comity_sim2d.scene.obstacles import floor_plan
from comity_sim2d.scene.person import Person, find_person
from comity_sim2d.scene.scene import Scene
from comity_sim2d.scene_error import is_near, require_between, require_finite, require_whole, shown
from comity_sim2d.senses.active_faults import ActiveFaults
from comity_sim2d.senses.sensing import SensedPeople
from comity_sim2d.senses.sight import Sight

if TYPE_CHECKING:
    import networkx as nx

    from comity_sim2d.people.making_way import MakingWay
    from comity_sim2d.people.pedestrians import Pedestrians
    from comity_sim2d.people.reactions import Reactions, Shown
    from comity_sim2d.scene.footpath import Disc


MOST_SEED = 2**128


class World:
    """A scene in motion. The same scene, seed and commands give the same frames, bit for bit.

    Args:
        scene: The initial scene.
        seed: Seed of the sensor noise, and of the reactions of people with a comfort interval.
        control_hz: Rate of commands, sensors and frames, in [1, 1000] [Hz].
        physics_hz: Rate of the physics; a multiple of `control_hz`, at most 10000 [Hz].
        route_map: An existing map of this scene, to share its caches.
        places: Poses for fetching things, by name of the place.

    Raises:
        SceneError: If a person cannot follow their walk, a wall stands within a group, there is no room for
            the passers-by, or the robot cannot keep its margin.
    """

    def __init__(
        self,
        scene: Scene,
        seed: int = 0,
        *,
        control_hz: int = 20,
        physics_hz: int = 60,
        route_map: RouteMap | None = None,
        places: Mapping[str, Pose] | None = None,
    ) -> None:
        require_whole("world", "seed", seed, 0, MOST_SEED)
        require_kinds("world", scene=(scene, Scene), route_map=(route_map, RouteMap | None))
        require_kinds("world", places=(places, Mapping | None))
        for pose in (places or {}).values():
            require_kinds("world", places=(pose, Pose))
        _require_rates(control_hz, physics_hz)
        self.scene = scene
        self._steps = physics_hz // control_hz
        self._clock = Clock(control_hz)
        check_margin(scene.robot, self._clock.step_s)
        self._people = {person.name: person for person in scene.people}
        self._stands = {person.name: frame_row(person.pose) for person in scene.people}
        self._doorways = Doorways(scene, self._clock)
        self._physics = Physics(scene, self._clock, physics_hz)
        self._plan = floor_plan(scene)
        check_groups(scene)
        sight = Sight(scene.robot.sensor, self._plan)
        self.faults = ActiveFaults()
        """Faults that are active now; a schedule begins and ends them here."""
        self._senses = SensedPeople(
            scene.robot.sensor,
            sight,
            scene.people,
            self._people,
            clock=self._clock,
            seed=seed,
            faults=self.faults,
        )
        self._said: list[Said] = []
        """Utterances of people, in order."""
        self._reactions = self._people_who_react(seed)
        self._making_way = self._people_who_make_way()
        self._traffic = self._people_who_walk(seed)
        self.leads = Leads(self._traffic)
        """People currently led; changes and faults begin and end their leads here."""
        self.robot = self._robot_in(route_map or RouteMap(scene), places or {})
        self._recorder = FrameRecorder(self._bodies())
        self._felt = 0
        """Number of the robot's contacts that its senses have processed."""
        self._observe()

    @property
    def time_s(self) -> float:
        """Time since the start [s]."""
        return self._clock.now_s

    @property
    def step_s(self) -> float:
        """Length of a control tick [s]."""
        return self._clock.step_s

    @property
    def frames(self) -> Frames:
        """All frames so far, t = 0 included."""
        return self._recorder.frames()

    def frames_since(self, count: int) -> Frames:
        """The frames after the first `count` ones."""
        return self._recorder.frames(count)

    @property
    def events(self) -> tuple[ActEvent, ...]:
        """Speech and acts of the robot."""
        return self.robot.events

    @property
    def robot_touches(self) -> tuple[Touch, ...]:
        """Every contact of the robot with a person or object, at its start."""
        return tuple(self._physics.touches)

    @property
    def people(self) -> tuple[Person, ...]:
        """All people at their current poses."""
        return tuple(self._people.values())

    @property
    def shown(self) -> tuple[Shown, ...]:
        """True reactions of people, whether or not the robot noticed."""
        return tuple(self._reactions.shown) if self._reactions else ()

    @property
    def margin_decisions(self) -> tuple[MarginDecision, ...]:
        """Whether each person who let the robot pass is passed at the reduced margin, in order."""
        return self.robot.margin_decisions

    def step(self) -> None:
        """Advance by one control tick."""
        self._physics.command(self.robot.control())
        self._physics.run(self._steps)
        self._clock.tick += 1
        self.robot.feel()
        if self._traffic:
            if is_due := self._traffic.is_due:
                self._traffic.decide(self._physics.pose, self._physics.twist)
            self._traffic.step(self._people, self._put)
            if is_due:
                self._physics.look_for_passers_by(self._traffic.at)
            self._physics.place_passers_by(self._traffic.at)
        for name in self.robot.asked_now:
            self._ask_to_pass(name)
        if self._making_way:
            self._making_way.step(
                self._people, self._physics.pose, self.robot.find_way, self._discs_but, self._step_aside
            )
        if self._reactions:
            speed_m_s = self._physics.twist.speed_m_s
            self._reactions.step(self._people, self._physics.pose, speed_m_s, self._step_aside)
        self._observe()

    def _ask_to_pass(self, name: str) -> None:
        here = self._physics.pose.xy
        if self._traffic and name in self._traffic.names:
            self._traffic.ask_to_pass(name, here, self.robot.find_way())
            return
        person = self._people[name]
        if self._making_way:
            self._making_way.ask(person, here)
            if self._reactions:
                self._reactions.break_off(name)
        if self._traffic and not (person.steps_aside or person.lets_pass):
            self._traffic.go_on(name, here)

    def run(self, seconds: float) -> None:
        """Advance by a time, rounded to the nearest tick.

        Raises:
            SceneError: If it is no time, or longer than a day.
        """
        require_between("world", "seconds", seconds, 0.0, 86_400.0)
        for _ in range(round(seconds * self._clock.hz)):
            self.step()

    def move_person(self, name: str, x_m: float, y_m: float, heading_rad: float) -> None:
        """Move a person elsewhere in the room, even onto obstacles; small steps amount to a walk.

        Raises:
            SceneError: If the heading is no angle.
            ValueError: If there is no such person, or no such place in the room.
        """
        require_finite("world", heading_rad=heading_rad)
        person = find_person(self.people, name)
        if not (is_near(x_m) and is_near(y_m) and self._plan.is_floor((x_m, y_m))):
            expected, got = f"x_m, y_m as a place in the room for {name!r}", f"({shown(x_m)}, {shown(y_m)})"
            raise WrongValueError(expected=expected, got=got, remedy="Choose a point of the floor.")
        self._displace(replace(person, x_m=x_m, y_m=y_m, heading_rad=heading_rad))
        if self._reactions:
            self._reactions.break_off(name)
        if self._making_way:
            self._making_way.break_off(name)

    def _displace(self, person: Person) -> None:
        self._put(person)
        if self._traffic:
            self._traffic.put(person, self._people)

    def _step_aside(self, person: Person) -> bool:
        """Move a person as part of a reaction, unless they walk, are led, or the place is taken.

        Returns whether they stand there now.
        """
        if self.leads.of(person.name) is not None:
            return False
        if self._traffic and self._traffic.is_walking(person.name):
            return False
        here = self._people[person.name].xy
        if is_taken(person.xy, here, person.radius_m, self.strides_but(person.name)):
            return False
        self._displace(person)
        return True

    @property
    def robot_stride(self) -> Stride:
        """The robot's stride: a point, since it decides at every tick."""
        return Stride(self._physics.pose.xy, self._physics.pose.xy, self.scene.robot.radius_m)

    def strides_but(self, name: str) -> list[Stride]:
        """Strides of all other people, passers-by included, until their next decision."""
        if self._traffic:
            return self._traffic.strides_but(name)
        people = (person for person in self._people.values() if person.name != name)
        return [Stride(person.xy, person.xy, person.radius_m) for person in people]

    def _discs_but(self, name: str) -> list[Disc]:
        """Discs of all other people, passers-by included, at the end of their current strides."""
        return [(*stride.end, stride.radius_m) for stride in self.strides_but(name)]

    @property
    def doors(self) -> tuple[Door, ...]:
        """All doors in their current state."""
        return self._doorways.doors

    @property
    def topology(self) -> nx.MultiGraph[str]:
        """Rooms, named places and doors as a graph, with the doors in their current state."""
        return topology(self.scene, self.doors)

    @property
    def door_turns(self) -> tuple[DoorTurn, ...]:
        """All openings and shuttings of doors since the start, in order."""
        return tuple(self._doorways.turns)

    def set_door(self, name: str, *, open: bool) -> None:  # noqa: A002  (the word for it)
        """Open or shut a door; takes effect on bodies, routes and lines of sight at once.

        Raises:
            ValueError: If there is no such door, it has no leaf, or a person or object stands in it.
        """
        require_kinds("world", open=(open, TRUTH))
        robot = (self.scene.robot.name, self._physics.pose.xy, self.scene.robot.radius_m)
        bodies = [robot, *((person.name, person.xy, person.radius_m) for person in self.people)]
        if self._traffic:
            bodies += self._traffic.discs
        door = self._doorways.turn(name, is_open=open, bodies=bodies)
        if door is None:
            return
        self._physics.set_door(door)
        self.robot.use_plan(self._doorways.plan)
        if self._traffic:
            self._traffic.use_plan(self._doorways.plan)
        if self._reactions:
            self._reactions.use_plan(self._doorways.plan)
        if self._making_way:
            self._making_way.use_plan(self._doorways.plan)

    def _put(self, person: Person) -> None:
        self._people[person.name] = person
        self._stands[person.name] = frame_row(person.pose)
        self._physics.place(person)

    def _bodies(self) -> list[tuple[str, float]]:
        """Names and radii [m] in the order of the frames."""
        robot = self.scene.robot
        walkers = (
            zip(self._traffic.names, self._traffic.radius_m.tolist(), strict=True) if self._traffic else ()
        )
        people = ((person.name, person.radius_m) for person in self.scene.people)
        return [(robot.name, robot.radius_m), *people, *walkers]

    def _robot_in(self, ways: RouteMap, places: Mapping[str, Pose]) -> SimRobot:
        """The robot, for which passers-by are bodies."""
        body, physics, senses = self.scene.robot, self._physics, self._senses
        controller = BaseController(body, physics, senses, self._clock, ways, places=places, said=self._said)
        if self._traffic:
            physics.add_passers_by(self._traffic.names, self._traffic.radius_m.tolist())
            controller.let_pass(self._traffic)
        return SimRobot(body, physics, senses, self._clock, controller, said=self._said, faults=self.faults)

    def _people_who_react(self, seed: int) -> Reactions | None:
        if not any(person.comfort for person in self.scene.people):
            return None
        from comity_sim2d.people.reactions import Reactions

        radius_m = self.scene.robot.radius_m
        return Reactions(self.scene.people, radius_m, self._plan, self._clock, seed=seed, said=self._said)

    def _people_who_make_way(self) -> MakingWay | None:
        if not any(person.steps_aside or person.lets_pass for person in self.scene.people):
            return None
        from comity_sim2d.people.making_way import MakingWay

        return MakingWay(self.scene.robot.radius_m, self._plan, self._clock, self._said)

    def _people_who_walk(self, seed: int) -> Pedestrians | None:
        moving = self.scene.passers_by or any(person.may_move for person in self.scene.people)
        if not moving:
            return None
        from comity_sim2d.people.pedestrians import Pedestrians

        return Pedestrians(self.scene, self._clock, seed)

    def _observe(self) -> None:
        felt = {touch.entity for touch in self._physics.touches[self._felt :]}
        self._felt = len(self._physics.touches)
        self._senses.observe(self._physics.pose, felt)
        passing = self._traffic.poses if self._traffic else None
        rows = [frame_row(self._physics.pose), *self._stands.values()]
        self._recorder.record(self.time_s, rows, passing)


def _require_rates(control_hz: int, physics_hz: int) -> None:
    require_whole("world", "control_hz", control_hz, 1, 1000)
    require_whole("world", "physics_hz", physics_hz, 1, 10_000)
    if physics_hz % control_hz:
        raise WrongValueError(
            expected=f"physics_hz as a multiple of control_hz, {control_hz}",
            got=f"{physics_hz}",
            remedy=f"Choose {control_hz * max(1, physics_hz // control_hz)}, for example.",
        )
