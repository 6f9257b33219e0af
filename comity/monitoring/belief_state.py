"""What the robot takes the world for at a time, and the scene that a new plan is made in then."""

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
    """What the robot takes the world for at a time."""

    people: tuple[Person, ...]
    doors: tuple[Door, ...]
    values: Mapping[str, Inference]
    """Everybody's parameters."""
    lost: Mapping[str, str]
    """Whose place it does not know although it looked for them, and why."""
    absent: frozenset[str]
    """Who stands nowhere in the plan: they, and others who are not where they were and whom nobody visits."""
    walking: frozenset[str]
    """Who is going somewhere."""

    def own_m(self, name: str) -> float:
        """How far a person likes to be passed [m]."""
        return own_distance_m(self.values[name])

    def scene(self, start: Scene, robot: Pose) -> Scene:
        """The place as it is then, with the robot wherever it is by now.

        Args:
            start: The scene as it began.
            robot: Where the robot is.

        Raises:
            SceneError: if a person seems to stand where no plan can be computed from, such as in the robot.
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
        except SceneError:  # noise may have put a person where nobody can be
            return scene(people=taken_apart(people, body, floor_plan(left, self.doors)))


def moment_of(world: Environment, values: Mapping[str, Inference], visited: Collection[str]) -> BeliefState:
    """What the robot of a world takes it for now.

    Args:
        world: Its robot knows where everybody is, and which doors are shut.
        values: Everybody's parameters.
        visited: Who is to be visited.
    """
    robot = world.robot
    lost = robot.lost()
    absent = frozenset(name for name in robot.missing if name in lost or name not in visited)
    return BeliefState(robot.people, world.doors, dict(values), lost, absent, robot.walking)
