"""From the scenario's place and people to the world's scene, with the file's lines in every complaint."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from comity_sim2d import Comfort, Furniture, Group, Person, RobotBody, Room, Scene, SceneError, Sensor, Wall

if TYPE_CHECKING:
    from collections.abc import Mapping

    from comity import scenario as written
    from comity.scenario import ScenarioFile


def scene_of(file: ScenarioFile, own_distances: Mapping[str, float]) -> Scene:
    """The scene that a scenario describes.

    Args:
        file: The scenario.
        own_distances: How far robots that pass should stay from each person, by name [m].

    Raises:
        InputError: if something cannot stand where it is put, naming its line.
    """
    place, robot = file.scenario.place, file.scenario.robot
    try:
        return Scene(
            room=Room.rectangle(place.width_m, place.height_m),
            robot=RobotBody(
                *robot.at_m,
                math.radians(robot.facing_deg),
                name=robot.name,
                sensor=Sensor(robot.sensor.noise_m, robot.sensor.delay_s),
            ),
            people=tuple(
                Person(
                    name=name,
                    x_m=person.at_m[0],
                    y_m=person.at_m[1],
                    heading_rad=math.radians(person.facing_deg),
                    posture=person.posture,
                    personal_distance_m=own_distances.get(name),
                    comfort=_comfort(name, person, file),
                )
                for name, person in file.scenario.people.items()
            ),
            walls=tuple(Wall(start, end) for start, end in place.walls_m),
            furniture=tuple(Furniture(item.name, _corners(item)) for item in place.furniture),
            groups=tuple(Group(name, members) for name, members in file.scenario.groups.items()),
        )
    except SceneError as error:
        raise error.at(file.where(*_location(error.entity, file))) from None


def _comfort(name: str, person: written.Person, file: ScenarioFile) -> Comfort | None:
    if person.comfort is None:
        return None
    try:
        return Comfort(*person.comfort.wants_m, person.comfort.shows, person.comfort.chance)
    except SceneError as error:
        raise error.at(file.where("people", name, "comfort")) from None


def _corners(item: written.Furniture) -> tuple[tuple[float, float], ...]:
    if item.polygon_m is not None:
        return item.polygon_m
    assert item.box_m is not None  # the model accepts exactly one of the two
    x, y, width, height = item.box_m
    return ((x, y), (x + width, y), (x + width, y + height), (x, y + height))


def _location(entity: str, file: ScenarioFile) -> tuple[str | int, ...]:
    """Where in the file that stands which the scene complains of."""
    scenario = file.scenario
    if entity in scenario.people:
        return ("people", entity, "at_m")
    if entity == scenario.robot.name:
        return ("robot", "at_m")
    for i, item in enumerate(scenario.place.furniture):
        if item.name == entity:
            return ("place", "furniture", i)
    if entity.startswith("wall "):
        return ("place", "walls_m", int(entity.removeprefix("wall ")) - 1)
    return ("place",)
