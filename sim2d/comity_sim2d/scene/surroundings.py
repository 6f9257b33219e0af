"""The surroundings of a robot of a given size: the floor plan, and the people at their current poses."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from comity_sim2d.pose import XY
from comity_sim2d.scene.o_space import OSpace, o_space_of_those_left
from comity_sim2d.scene.obstacles import FREE_FROM_M, WALL_MARGIN_M, FloorPlan, floor_plan
from comity_sim2d.scene.person import Person, find_person
from comity_sim2d.scene.scene import Scene


@dataclass(frozen=True, slots=True)
class Surroundings:
    """The floor plan with people at their current poses, for a robot of a given size."""

    plan: FloorPlan
    people: tuple[Person, ...]
    robot_radius_m: float
    o_spaces: tuple[OSpace, ...] = ()
    """O-spaces of groups, which nothing crosses."""
    groups: tuple[tuple[Person, ...], ...] = ()
    """Members of each group at their original poses."""

    @classmethod
    def of(cls, scene: Scene) -> Surroundings:
        """The surroundings at the start of a scene."""
        groups = tuple(group.those_of(scene.people) for group in scene.groups)
        return cls(floor_plan(scene), scene.people, scene.robot.radius_m, scene.o_spaces, groups)

    def with_people(self, people: tuple[Person, ...]) -> Surroundings:
        """The same with other poses of people; o-spaces are those of members who have not left."""
        left = (o_space_of_those_left(members, people) for members in self.groups)
        return replace(self, people=people, o_spaces=tuple(space for space in left if space is not None))

    def person(self, name: str) -> Person:
        """The person of that name, where they stand now."""
        return find_person(self.people, name)

    def blocker(self, xy: XY, visited: str | None = None) -> str | None:
        """What blocks the robot, with margins, at a position, in words; the visited person does not count."""
        found = self.plan.blocker(xy, self.robot_radius_m + WALL_MARGIN_M - 1e-9)
        if found is not None:
            return found.name
        for person in self.people:
            reach = person.radius_m + self.robot_radius_m + FREE_FROM_M - 1e-9
            if person.name != visited and math.dist(person.pose.xy, xy) < reach:
                return person.name
        return self._group_around(xy)

    def are_free(self, points: Sequence[XY], *, visited: str) -> NDArray[np.bool_]:
        """Whether places next to a person are free and in their view; shape (n,). For one: `pose_blocker`."""
        at = np.array(points, dtype=float).reshape(-1, 2)
        free = self.plan.are_free(at, self.robot_radius_m + WALL_MARGIN_M - 1e-9)
        for person in self.people:
            if person.name != visited:
                reach = person.radius_m + self.robot_radius_m + FREE_FROM_M - 1e-9
                free &= np.hypot(*(at - np.array(person.pose.xy)).T) >= reach
        for space in self.o_spaces:
            if space.is_closed:
                reach = space.radius_m + self.robot_radius_m - 1e-9
                free &= np.hypot(*(at - np.array(space.xy)).T) >= reach
        if free.any():
            free[free] = self.plan.are_in_view(self.person(visited).pose.xy, at[free])
        return free

    def _group_around(self, xy: XY) -> str | None:
        """The group among which the robot would stand; the place in front of an open one is allowed."""
        for space in self.o_spaces:
            if space.is_closed and math.dist(space.xy, xy) < space.radius_m + self.robot_radius_m - 1e-9:
                return space.words
        return None
