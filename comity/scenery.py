"""From the scenario's place and people to the world's scene, with the file's lines in every complaint."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from comity.place import map_of
from comity.scenario import MapPlace
from comity_sim2d import Comfort, Group, Person, RobotBody, Scene, SceneError, Sensor

if TYPE_CHECKING:
    from collections.abc import Mapping

    from comity import scenario as written
    from comity.scenario import ScenarioFile


def scene_of(file: ScenarioFile, own_distances: Mapping[str, float]) -> Scene:
    """The scene that a scenario describes.

    Args:
        file: The scenario, with everybody placed.
        own_distances: How far robots that pass should stay from each person, by name [m].

    Raises:
        InputError: if something cannot stand where it is put, naming its line.
    """
    robot = file.scenario.robot
    place = map_of(file)
    try:
        return place.scene(
            RobotBody(
                *_pose(robot),
                name=robot.name,
                drive=robot.drive,
                max_speed_m_s=robot.max_speed_m_s,
                max_acceleration_m_s2=robot.max_acceleration_m_s2,
                max_jerk_m_s3=robot.max_jerk_m_s3,
                sensor=_sensor(robot.sensor),
            ),
            tuple(
                Person(
                    name,
                    *_pose(person),
                    posture=person.posture,
                    personal_distance_m=own_distances.get(name),
                    comfort=_comfort(name, person, file),
                )
                for name, person in file.scenario.people.items()
            ),
            groups=tuple(Group(name, members) for name, members in file.scenario.groups.items()),
        )
    except SceneError as error:
        raise error.at(file.where(*_location(error.entity, file))) from None


def _pose(standing: written.Standing) -> tuple[float, float, float]:
    """x, y and heading."""
    assert standing.at_m is not None  # placed before
    return (*standing.at_m, math.radians(standing.facing_deg or 0.0))


def _sensor(sensor: written.Sensor) -> Sensor:
    return Sensor(
        sigma_m=sensor.noise_m,
        delay_s=sensor.delay_s,
        range_m=sensor.range_m,
        field_of_view_deg=sensor.field_of_view_deg,
        hidden_by_walls=sensor.hidden_by_walls,
    )


def _comfort(name: str, person: written.Person, file: ScenarioFile) -> Comfort | None:
    if person.comfort is None:
        return None
    try:
        return Comfort(*person.comfort.wants_m, person.comfort.shows, person.comfort.chance)
    except SceneError as error:
        raise error.at(file.where("people", name, "comfort")) from None


def _location(entity: str, file: ScenarioFile) -> tuple[str | int, ...]:
    """Where in the file that stands which the scene complains of."""
    scenario = file.scenario
    if entity in scenario.people:
        return ("people", entity, "at_m")
    if entity == scenario.robot.name:
        return ("robot", "at_m")
    if isinstance(scenario.place, MapPlace):
        return ("place", "map")
    for i, item in enumerate(scenario.place.furniture):
        if item.name == entity:
            return ("place", "furniture", i)
    if entity.startswith("wall "):
        return ("place", "walls_m", int(entity.removeprefix("wall ")) - 1)
    return ("place",)
