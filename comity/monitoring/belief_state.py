"""The robot's belief about the world at a time, and the scene for making a new plan."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import partial
from typing import TYPE_CHECKING

from comity.parameters.passing import own_distance_m
from comity_sim2d import Scene, SceneError
from comity_sim2d.scene.obstacles import floor_plan
from comity_sim2d.senses.overlap_resolution import taken_apart

if TYPE_CHECKING:
    from collections.abc import Collection, Mapping

    from comity.environment import Environment
    from comity_fis import Inference
    from comity_sim2d import Door, Person, Pose


@dataclass(frozen=True, slots=True)
class BeliefState:
    """The robot's belief about the world at a time."""

    people: tuple[Person, ...]
    doors: tuple[Door, ...]
    values: Mapping[str, Inference]
    """Everyone's parameters."""
    lost: Mapping[str, str]
    """People whose place it does not know after searching, with the reason."""
    absent: frozenset[str]
    """People absent from planning: those, and unvisited people who are not at their believed place."""
    walking: frozenset[str]
    """People who walk."""

    def own_m(self, name: str) -> float:
        """Distance at which a person likes to be passed [m]."""
        return own_distance_m(self.values[name])

    def scene(self, start: Scene, robot: Pose) -> Scene:
        """The current scene, with the robot at its current pose.

        Args:
            start: The initial scene.
            robot: Pose of the robot.

        Raises:
            SceneError: If a person seems to stand where planning is impossible, such as in the robot.
        """
        left = start.without(self.absent)
        groups = (group.of_those_left(left.people, self.people) for group in left.groups)
        body = replace(left.robot, x_m=robot.x_m, y_m=robot.y_m, heading_rad=robot.heading_rad)
        people = tuple(
            replace(each, personal_distance_m=self.own_m(each.name))
            for each in self.people
            if each.name not in self.absent
        )
        together = tuple(group for group in groups if group is not None)
        scene = partial(replace, left, groups=together, doors=self.doors, robot=body)
        try:
            return scene(people=people)
        except SceneError:  # noise may have put a person in an impossible place
            return scene(people=taken_apart(people, body, floor_plan(left, self.doors)))


def moment_of(world: Environment, values: Mapping[str, Inference], visited: Collection[str]) -> BeliefState:
    """The current belief of a world's robot.

    Args:
        world: Its robot knows where everybody is, and which doors are shut.
        values: Everybody's parameters.
        visited: People to visit.
    """
    robot = world.robot
    lost = robot.lost()
    absent = frozenset(name for name in robot.missing if name in lost or name not in visited)
    return BeliefState(robot.people, world.doors, dict(values), lost, absent, robot.walking)
