"""Execution of a scenario's changes: walks, new wishes, and emergency stops."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import TYPE_CHECKING

from comity.schedule import Announced
from comity.simulation.sent_way import SentWay, sent_way, up_to_a_door
from comity_sim2d import Person, Route
from comity_sim2d.people.collision_filter import is_taken
from comity_sim2d.people.leading import Lead
from comity_sim2d.scene.person import find_person
from comity_sim2d.senses import active_faults

if TYPE_CHECKING:
    from comity.schedule import Happening, Stage
    from comity_fis import Inference
    from comity_sim2d import World
    from comity_sim2d.scene.door import Door

GAP_M = 0.10
"""Distance from the robot and from others at which a walking person stops and waits [m]."""


@dataclass(frozen=True, slots=True)
class ValuesChange:
    """A change of a person's parameters."""

    at_s: float
    person: str
    values: Inference
    text: str
    """Description of the change."""

    def happen(self, stage: Stage) -> Iterator[None]:
        """Inform the planner, once."""
        stage.planner.tell(self.person, self.values, self.text)
        yield from ()


def told(happenings: Iterable[Happening]) -> Iterator[Happening]:
    """Happenings that people tell the robot about; all others affect the simulated world."""
    for happening in happenings:
        inner = happening.happening if isinstance(happening, Announced) else happening
        if isinstance(inner, ValuesChange):
            yield happening


@dataclass(frozen=True, slots=True)
class EmergencyStopPressed:
    """The robot's emergency stop, pressed for some time."""

    at_s: float
    for_s: float
    reason: str = "the emergency stop is pressed"

    def happen(self, stage: Stage) -> Iterator[None]:
        """Press it, then release it."""
        button = stage.world.robot.emergency_stop
        button.press(self.reason)
        while stage.world.time_s < self.at_s + self.for_s - 1e-9:
            yield
        button.release(self.reason)


@dataclass(frozen=True, slots=True)
class WalkStart:
    """A walk around walls and furniture, which waits for people in its path.

    It also waits for a door that blocks every path, however long.
    """

    at_s: float
    person: str
    to_m: tuple[float, float]
    heading_rad: float | None
    """Final heading [rad]; None to keep the direction of arrival."""
    speed_m_s: float
    round_people: bool = False
    """Whether the path avoids others and the robot at their initial positions, rather than waiting for
    them."""
    patience_s: float = math.inf
    """Time that they wait for people in their path [s]; then they stay where they are."""

    def happen(self, stage: Stage) -> Iterator[None]:
        """Walk until sent elsewhere; no effect if there is no longer a path."""
        world = stage.world
        if self._way(world) is None:
            return
        lead = Lead(self.person, self.to_m, self.heading_rad)
        with leading(lead, world) as was_led:
            if was_led:
                yield  # they may already have moved in this tick
            yield from self.steps(lead, stage)

    def steps(self, lead: Lead, stage: Stage) -> Iterator[None]:
        """Walk step by step, while they are guided by `lead`.

        Whenever a door turns they search for a new path; if a door blocks every path, they wait for it.
        """
        world, waits_for = stage.world, None
        doors, way = world.doors, self._way(world)
        gone_m, held_s, stride_m = 0.0, 0.0, self.speed_m_s * world.step_s
        while way and (way.door or gone_m < way.open_m) and held_s < self.patience_s - 1e-9:
            if not world.leads.holds(lead):
                return
            if world.doors != doors:
                doors, rest = world.doors, Route(way.route.rest(gone_m))
                way, gone_m = self._way(world, rest.points), 0.0
                waits_for = self._tell_of_turn(rest, way, waits_for, stage)
                continue
            ahead_m = min(way.open_m, gone_m + stride_m)
            if self._is_taken(way.route.at(ahead_m), world):
                held_s += 0.0 if way.door else world.step_s
            elif ahead_m > gone_m:
                gone_m, held_s = ahead_m, 0.0
                self._stand(way.route, gone_m, world)
            if way.door not in (None, waits_for) and gone_m >= way.open_m:
                waits_for = self._tell_that_they_wait(way.door, stage)
            yield

    def _is_taken(self, xy: tuple[float, float], world: World) -> bool:
        person, others = find_person(world.people, self.person), world.strides_but(self.person)
        return is_taken(xy, person.xy, person.radius_m, (world.robot_stride, *others), GAP_M)

    def _way(self, world: World, rest: tuple[tuple[float, float], ...] = ()) -> SentWay | None:
        person = find_person(world.people, self.person)
        others = _others(person, world) if self.round_people else ()
        return sent_way(person, self.to_m, world, others=others, before=rest)

    def _tell_that_they_wait(self, door: Door, stage: Stage) -> Door:
        text = f"{self.person} waits before {door.shut_name}: no other way leads to {self.there}"
        _note(door, text, stage)
        return door

    def _tell_of_turn(
        self, rest: Route, way: SentWay | None, waits_for: Door | None, stage: Stage
    ) -> Door | None:
        """React to a turned door; returns the door that they still wait for, if any."""
        if way is None or way.door is not None:
            return waits_for
        barred = up_to_a_door(rest, stage.world.doors, find_person(stage.world.people, self.person).radius_m)
        if waits_for is not None:
            _note(waits_for, f"{self.person} goes on to {self.there}", stage)
        elif barred is not None and barred.door is not None:
            text = f"{self.person} goes another way to {self.there}: {barred.door.shut_name} is in the way"
            _note(barred.door, text, stage)
        return None

    @property
    def there(self) -> str:
        """Their destination, in words."""
        return f"({self.to_m[0]:g}, {self.to_m[1]:g})"

    def _stand(self, route: Route, gone_m: float, world: World) -> None:
        dx, dy = route.direction(max(0.0, gone_m - 1e-6))
        heading_rad = math.atan2(dy, dx)
        if gone_m >= route.length_m and self.heading_rad is not None:
            heading_rad = self.heading_rad
        world.move_person(self.person, *route.at(gone_m), heading_rad)


@contextmanager
def leading(lead: Lead, world: World) -> Iterator[bool]:
    """Guide a person; yields whether something else has guided them until now."""
    was_led = world.leads.begin(lead)
    try:
        yield was_led
    finally:
        world.leads.end(lead)


def _note(door: Door, text: str, stage: Stage) -> None:
    stage.planner.note(door.name, text, stage.world.faults.of(active_faults.door(door.name)))


def _others(person: Person, world: World) -> tuple[Person, ...]:
    """Everybody else, including the robot."""
    body, pose = world.scene.robot, world.robot.pose
    robot = Person(body.name, pose.x_m, pose.y_m, pose.heading_rad, body.radius_m)
    return (robot, *(other for other in world.people if other.name != person.name))
