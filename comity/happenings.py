"""The changes of a scenario as they happen: somebody walks or wants something else, the robot is stopped."""

from __future__ import annotations

import math
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import TYPE_CHECKING

from comity_sim2d import Person, Route, RouteMap
from comity_sim2d.footing import is_taken
from comity_sim2d.leading import Lead
from comity_sim2d.obstacles import FloorPlan, Surroundings, floor_plan
from comity_sim2d.scene import find_person

if TYPE_CHECKING:
    from comity.schedule import Stage
    from comity_fis import Inference
    from comity_sim2d import World

GAP_M = 0.10
"""Whoever walks stops so far from the robot and from others, and waits."""


@dataclass(frozen=True, slots=True)
class ValuesChange:
    """Somebody's parameters are others from a time on."""

    at_s: float
    person: str
    values: Inference
    text: str
    """What happened, in words."""

    def happen(self, stage: Stage) -> Iterator[None]:
        """Tell the planner, once."""
        stage.planner.tell(self.person, self.values, self.text)
        yield from ()


@dataclass(frozen=True, slots=True)
class EmergencyStopPressed:
    """The robot's emergency stop is pressed for some time."""

    at_s: float
    for_s: float
    reason: str = "the emergency stop is pressed"

    def happen(self, stage: Stage) -> Iterator[None]:
        """Hold it down, and let it go."""
        button = stage.world.robot.emergency_stop
        button.press(self.reason)
        while stage.world.time_s < self.at_s + self.for_s - 1e-9:
            yield
        button.release(self.reason)


@dataclass(frozen=True, slots=True)
class Walk:
    """Somebody walks somewhere, around walls and furniture, and waits for whoever stands in their way."""

    at_s: float
    person: str
    to_m: tuple[float, float]
    heading_rad: float | None
    """How they stand there; None: as they came."""
    speed_m_s: float
    round_people: bool = False
    """Whether they go round others and the robot as they stand when they set out, rather than wait."""
    patience_s: float = math.inf
    """How long they wait for whoever stands in their way; then they stay where they are."""

    def happen(self, stage: Stage) -> Iterator[None]:
        """Until something else sends them elsewhere; nothing happens where no way leads there by now."""
        world = stage.world
        if self._route(world) is None:
            return
        lead = Lead(self.person, self.to_m, self.heading_rad)
        with leading(lead, world) as was_led:
            if was_led:
                yield  # they may have made a step in this tick
            yield from self.steps(lead, world)

    def steps(self, lead: Lead, world: World) -> Iterator[None]:
        """From where they are, step by step, for as long as they are led so."""
        route = self._route(world)
        gone_m, held_s, stride_m = 0.0, 0.0, self.speed_m_s * world.step_s
        while route is not None and gone_m < route.length_m and held_s < self.patience_s - 1e-9:
            if not world.leads.holds(lead):
                return
            ahead_m = min(route.length_m, gone_m + stride_m)
            person = find_person(world.people, self.person)
            others = (world.robot_stride, *world.strides_but(self.person))
            if is_taken(route.at(ahead_m), person.xy, person.radius_m, others, GAP_M):
                held_s += world.step_s
            else:
                gone_m, held_s = ahead_m, 0.0
                self._stand(route, gone_m, world)
            yield

    def _route(self, world: World) -> Route | None:
        person, plan = find_person(world.people, self.person), floor_plan(world.scene, world.doors)
        return way_of(person, self.to_m, plan, _others(person, world) if self.round_people else ())

    def _stand(self, route: Route, gone_m: float, world: World) -> None:
        dx, dy = route.direction(max(0.0, gone_m - 1e-6))
        heading_rad = math.atan2(dy, dx)
        if gone_m >= route.length_m and self.heading_rad is not None:
            heading_rad = self.heading_rad
        world.move_person(self.person, *route.at(gone_m), heading_rad)


@contextmanager
def leading(lead: Lead, world: World) -> Iterator[bool]:
    """Lead somebody; it is said whether something else did until now."""
    was_led = world.leads.begin(lead)
    try:
        yield was_led
    finally:
        world.leads.end(lead)


def way_of(
    person: Person, to_m: tuple[float, float], plan: FloorPlan, others: tuple[Person, ...] = ()
) -> Route | None:
    """The way of a person through a place; None where there is none.

    Args:
        person: Who walks, from where they stand.
        to_m: Where to.
        plan: Its walls and furniture are gone around.
        others: Who is gone around, too; all others and the robot are waited for.
    """
    return RouteMap(Surroundings(plan, others, person.radius_m)).route(person.xy, to_m)


def _others(person: Person, world: World) -> tuple[Person, ...]:
    """Everybody else, with the robot as one of them."""
    body, pose = world.scene.robot, world.robot.pose
    robot = Person(body.name, pose.x_m, pose.y_m, pose.heading_rad, body.radius_m)
    return (robot, *(other for other in world.people if other.name != person.name))
