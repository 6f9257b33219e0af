"""Execution of a scenario's faults, each in the part of the world or robot that it affects."""

from __future__ import annotations

import math
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace
from itertools import cycle, product
from typing import TYPE_CHECKING

from comity.simulation.happenings import WalkStart, leading
from comity.simulation.sent_way import way_of
from comity_executor import FaultError
from comity_sim2d import RouteMap
from comity_sim2d.people.leading import Lead
from comity_sim2d.scene.obstacles import floor_plan
from comity_sim2d.scene.person import find_person
from comity_sim2d.scene.surroundings import Surroundings
from comity_sim2d.senses import active_faults
from comity_sim2d.senses.active_faults import PATH, Subject

if TYPE_CHECKING:
    from comity.schedule import Stage
    from comity_sim2d import Person, World

TURNS_DEG = (0, 30, -30, 60, -60, 90, -90)
SHARES = (1.0, 0.75, 0.5, 0.25)
"""Shares of the full distance that a person who walks off tries in turn: straight away from the robot, or as
nearly so as there is space."""
NOTICED_S = 1.0
"""Time after its end during which a fault still counts as a cause [s]: the robot needs a moment to notice."""
PATIENCE_S = 2.0
"""Time that a person waits for another one in their path before they stop there or choose another path [s]
(our choice)."""
AHEAD_M = 1.5
"""Distance ahead of the robot at which an obstructing person stands [m]; if less of its path remains, the
middle of that."""


@dataclass(frozen=True, slots=True)
class PartFails:
    """Failure of a part of the robot for some time."""

    at_s: float
    for_s: float
    part: Subject
    text: str

    def happen(self, stage: Stage) -> Iterator[None]:
        """Keep the part failing for the duration."""
        with _fault(stage.world, self.part, self.text):
            yield from _until(self.at_s + self.for_s, stage.world)


@dataclass(frozen=True, slots=True)
class WalkOff:
    """A person who walks away from the robot."""

    at_s: float
    person: str
    by_m: float
    heading_rad: float | None
    """Final heading [rad]; None to keep the direction of arrival."""
    speed_m_s: float
    text: str

    def happen(self, stage: Stage) -> Iterator[None]:
        """Start the walk; no effect if there is nowhere to go."""
        to_m = self._whereto(stage.world)
        if to_m is None:
            return
        with _fault(stage.world, active_faults.person(self.person), self.text):
            walk = WalkStart(
                self.at_s, self.person, to_m, self.heading_rad, self.speed_m_s, patience_s=PATIENCE_S
            )
            yield from walk.happen(stage)
            yield from _until(stage.world.time_s + NOTICED_S, stage.world)

    def _whereto(self, world: World) -> tuple[float, float] | None:
        person, robot = find_person(world.people, self.person), world.robot.pose
        away = math.atan2(person.y_m - robot.y_m, person.x_m - robot.x_m)
        for share, turn_deg in product(SHARES, TURNS_DEG):
            angle, by_m = away + math.radians(turn_deg), share * self.by_m
            there = (person.x_m + by_m * math.cos(angle), person.y_m + by_m * math.sin(angle))
            if _can_walk(person, there, world):
                return there
        return None


@dataclass(frozen=True, slots=True)
class StandInTheWay:
    """A person who goes to stand on the robot's path, or as near to it as others allow, and returns later.

    A person who is meanwhile sent elsewhere goes there, and no longer obstructs the robot.
    """

    at_s: float
    person: str
    for_s: float
    speed_m_s: float
    text: str

    def happen(self, stage: Stage) -> Iterator[None]:
        """Start once the robot is moving; no effect if nobody can get onto its path."""
        world = stage.world
        while (goal := world.robot.goal) is None:
            yield
        there = _on_the_way(goal, world)
        if there is None or not _can_walk(find_person(world.people, self.person), there, world):
            return
        lead = self._lead(world)
        with _fault(world, active_faults.person(self.person), self.text), leading(lead, world) as was_led:
            if was_led:
                yield  # they may already have moved in this tick
            walk = WalkStart(self.at_s, self.person, there, None, self.speed_m_s, patience_s=PATIENCE_S)
            yield from walk.steps(lead, stage)
            yield from _until(world.time_s + self.for_s, world, lead)
            back = replace(walk, to_m=lead.to_m, heading_rad=lead.heading_rad)
            yield from self._go_back(back, lead, stage)

    def _lead(self, world: World) -> Lead:
        """The guidance of the person; their home is where they stand, or where they were being sent."""
        sent = world.leads.of(self.person)
        if sent is not None:
            return replace(sent)
        person = find_person(world.people, self.person)
        return Lead(self.person, person.xy, person.heading_rad, stays=False)

    def _go_back(self, back: WalkStart, lead: Lead, stage: Stage) -> Iterator[None]:
        """Return on the same path, or around people who stand there, as soon as there is a path."""
        world = stage.world
        for round_people in cycle((False, True)):
            yield from replace(back, round_people=round_people).steps(lead, stage)
            is_there = math.dist(find_person(world.people, self.person).xy, back.to_m) < 1e-6
            if is_there or not world.leads.holds(lead):
                return
            yield from _until(world.time_s + NOTICED_S, world, lead)


@dataclass(frozen=True, slots=True)
class DoorTurns:
    """A door that is shut or opened."""

    at_s: float
    door: str
    opens: bool
    for_s: float | None
    """Time after which it is turned back [s]; None: it stays until something else turns it."""
    text: str

    def happen(self, stage: Stage) -> Iterator[None]:
        """Turn the door; if a person stands in it, wait until they have left, as recorded in the trace.

        A door already in that state, other than by a fault, is left alone and not turned back.
        """
        world = stage.world
        was_so = _is_open(self.door, world) == self.opens and world.faults.of(self._subject) is None
        yield from self._turn(self.opens, stage)
        if not was_so:
            yield from self._held_open(stage) if self.opens else self._held_shut(stage)

    @property
    def _subject(self) -> Subject:
        return active_faults.door(self.door)

    def _held_shut(self, stage: Stage) -> Iterator[None]:
        world = stage.world
        with _fault(world, PATH, self.text), _fault(world, self._subject, self.text):
            yield from self._until_over(world)
        if self.for_s is not None and world.faults.of(self._subject) is None:
            yield from self._turn(True, stage)

    def _held_open(self, stage: Stage) -> Iterator[None]:
        world = stage.world
        with _fault(world, self._subject, self.text):
            if self.for_s is not None:
                yield from self._until_over(world)
                yield from self._turn(False, stage)
            yield from _until(world.time_s + NOTICED_S, world)

    def _until_over(self, world: World) -> Iterator[None]:
        """Wait until the time is over, or something else turns the door."""
        end_s = math.inf if self.for_s is None else world.time_s + self.for_s
        while world.time_s < end_s - 1e-9 and _is_open(self.door, world) == self.opens:
            yield

    def _turn(self, opens: bool, stage: Stage) -> Iterator[None]:
        told = None
        while (why := _refused(self.door, opens, stage.world)) is not None:
            if why != told:
                told = why
                stage.planner.note(self.door, f"{why}; it waits", self.text)
            yield


@dataclass(frozen=True, slots=True)
class PlannerBreaksDown:
    """Planner calls that raise an exception."""

    at_s: float
    calls: int
    text: str

    def happen(self, stage: Stage) -> Iterator[None]:
        """Make the next calls fail."""
        stage.planner.break_down(FaultError(self.text), self.calls)
        yield from ()


@dataclass(frozen=True, slots=True)
class LeafBreaksDown:
    """A leaf that raises an exception."""

    at_s: float
    leaf: str
    times: int
    text: str

    def happen(self, stage: Stage) -> Iterator[None]:
        """Make the next ticks fail."""
        stage.tree.raise_in(self.leaf, FaultError(self.text), times=self.times)
        yield from ()


@contextmanager
def _fault(world: World, subject: Subject, text: str) -> Iterator[None]:
    world.faults.begin(subject, text)
    try:
        yield
    finally:
        world.faults.end(subject, text)


def _until(end_s: float, world: World, lead: Lead | None = None) -> Iterator[None]:
    while world.time_s < end_s - 1e-9 and (lead is None or world.leads.holds(lead)):
        yield


def _can_walk(person: Person, there: tuple[float, float], world: World) -> bool:
    plan = floor_plan(world.scene, world.doors)
    return plan.blocker(there, person.radius_m) is None and way_of(person, there, plan) is not None


def _on_the_way(goal: tuple[float, float], world: World) -> tuple[float, float] | None:
    surroundings = Surroundings(floor_plan(world.scene, world.doors), (), world.scene.robot.radius_m)
    route = RouteMap(surroundings).route(world.robot.pose.xy, goal)
    return route.at(min(AHEAD_M, route.length_m / 2)) if route is not None else None


def _is_open(door: str, world: World) -> bool:
    return next(each.is_open for each in world.doors if each.name == door)


def _refused(door: str, opens: bool, world: World) -> str | None:
    """Turn a door; returns why it failed, since a door cannot be shut while a person stands in it."""
    try:
        world.set_door(door, open=opens)
    except ValueError as error:
        return str(error)
    return None
