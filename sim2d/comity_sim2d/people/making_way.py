"""Responses of people whom the robot asks to make way: they step aside and look at it, or agree.

All times and lengths are our own choice. A person who stepped aside stays there.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import replace

from comity_sim2d.clock import Clock
from comity_sim2d.people.said import GO_AHEAD, Said
from comity_sim2d.people.stepping_out import ASIDE_M, HEARD_M, against_the_wall, way_out
from comity_sim2d.pose import XY, Pose, direction_to
from comity_sim2d.scene.footpath import Disc, Footpaths
from comity_sim2d.scene.obstacles import FloorPlan
from comity_sim2d.scene.person import Person

HESITATION_S = 0.7
"""Time from the end of the question to the answer [s]."""
STEP_M_S = 0.6
"""Speed of a person who steps aside [m/s]."""


class MakingWay:
    """The pending answers of people, and their steps aside.

    Args:
        robot_radius_m: Radius of the robot's disc [m].
        plan: The static obstacles, which a person must not walk into.
        clock: Simulated time.
        said: What people say; answers are appended to it.
    """

    def __init__(self, robot_radius_m: float, plan: FloorPlan, clock: Clock, said: list[Said]) -> None:
        self._robot_radius_m, self._plan, self._clock, self._said = robot_radius_m, plan, clock, said
        self._answers_s: dict[str, float] = {}
        """When each person who was asked will answer [s]."""
        self._left: dict[str, list[Pose]] = {}
        """Remaining poses, one per tick, the next one last."""

    def use_plan(self, plan: FloorPlan) -> None:
        """Replace the static obstacles."""
        self._plan = plan

    def break_off(self, name: str) -> None:
        """Cancel the step aside of a person who is moved by something else."""
        self._left.pop(name, None)

    def ask(self, person: Person, robot: XY) -> None:
        """Ask a person to make way; if near enough to hear it, they answer after a moment."""
        if (person.steps_aside or person.lets_pass) and math.dist(person.xy, robot) <= HEARD_M:
            self._answers_s[person.name] = self._clock.now_s + HESITATION_S

    def step(
        self,
        people: Mapping[str, Person],
        robot: Pose,
        find_way: Callable[[], Sequence[XY]],
        others: Callable[[str], Iterable[Disc]],
        move: Callable[[Person], bool],
    ) -> None:
        """Advance by one tick.

        Args:
            people: The people of the scene.
            robot: Pose of the robot.
            find_way: Returns the robot's intended path, which people infer from its pose.
            others: Returns all bodies except the robot's and that of one person.
            move: Moves a person; returns whether that was possible.
        """
        for name, at_s in list(self._answers_s.items()):
            if at_s <= self._clock.now_s + 1e-9:
                del self._answers_s[name]
                self._answer(people[name], robot, find_way, others)
        for name in list(self._left):
            pose = self._left[name].pop()
            there = replace(people[name], x_m=pose.x_m, y_m=pose.y_m, heading_rad=pose.heading_rad)
            if not move(there) or not self._left[name]:
                del self._left[name]

    def _answer(
        self,
        person: Person,
        robot: Pose,
        find_way: Callable[[], Sequence[XY]],
        others: Callable[[str], Iterable[Disc]],
    ) -> None:
        if person.lets_pass:
            self._said.append(Said(self._clock.now_s, person.name, GO_AHEAD))
        if not (person.steps_aside and (way := find_way())):
            return
        body, around = (*robot.xy, self._robot_radius_m), list(others(person.name))
        places = self._aside(person, way, body, around)
        if places:
            self._left[person.name] = self._poses(person, places, robot)

    def _aside(self, person: Person, way: Sequence[XY], robot: Disc, others: list[Disc]) -> list[XY] | None:
        """Path of the step aside: off the robot's path if there is room nearby, else against the wall."""
        at, radius_m = person.xy, person.radius_m
        paths = Footpaths(self._plan, radius_m)
        out = way_out(
            at,
            way,
            robot,
            radius_m=radius_m,
            others=others,
            plan=self._plan,
            paths=paths,
            farthest_m=ASIDE_M,
        )
        if out is not None:
            return out
        return against_the_wall(at, way, radius_m=radius_m, others=[*others, robot], plan=self._plan)

    def _poses(self, person: Person, places: Sequence[XY], robot: Pose) -> list[Pose]:
        """Poses along the path, one per tick, the last one first, where the person looks at the robot."""
        step_m, found, start = STEP_M_S * self._clock.step_s, list[Pose](), person.xy
        for end in places:
            length_m, heading = math.dist(start, end), direction_to(start, end)
            steps = max(1, math.ceil(length_m / step_m))
            leg = Pose(*start, heading)
            found += [Pose(*leg.ahead(length_m * k / steps), heading) for k in range(1, steps + 1)]
            start = end
        last = found[-1]
        return [Pose(*last.xy, direction_to(last.xy, robot.xy)), *reversed(found)]
