"""Conversion of a scenario's place and people to the world's scene; every error names its line."""

from __future__ import annotations

import math
from collections.abc import Mapping
from types import MappingProxyType
from typing import TYPE_CHECKING

from comity.parameters.passing import asked_speed_m_s, own_distance_m
from comity.scenario import MapPlace
from comity.simulation.place import map_of
from comity_fis import InputError
from comity_sim2d import Comfort, Group, PassersBy, Person, RobotBody, Scene, SceneError, Sensor, Walk
from comity_sim2d.robot.reduced_margin import check_margin
from comity_sim2d.scene.comfort import FARTHEST_M, NARROWEST_M, NEAREST_M
from comity_sim2d.scene.group_check import check_groups
from comity_sim2d.scene.margin_facts import MarginFacts
from comity_sim2d.scene.placing import place as place_passers_by
from comity_sim2d.scene.walk_check import check_walks

if TYPE_CHECKING:
    from comity import scenario as written
    from comity.scenario import ScenarioFile
    from comity_fis import Inference

NOTHING_DECLARED: Mapping[str, MarginFacts] = MappingProxyType({})


def scene_of(
    file: ScenarioFile,
    values: Mapping[str, Inference],
    seed: int = 0,
    *,
    margin_facts: Mapping[str, MarginFacts] = NOTHING_DECLARED,
) -> Scene:
    """The scene that a scenario describes.

    Args:
        file: The scenario, after placement.
        values: Parameters by person, which determine how robots move near them.
        seed: Seed of the episode, which determines where passers-by start, and so whether there is space.
        margin_facts: Declarations of people about being passed at a reduced margin, by name.

    Raises:
        InputError: with its line, if something cannot stand at its position.
    """
    robot = file.scenario.robot
    place = map_of(file)
    try:
        scene = place.scene(
            RobotBody(
                *_pose(robot),
                name=robot.name,
                radius_m=robot.radius_m,
                drive=robot.drive,
                max_speed_m_s=robot.max_speed_m_s,
                max_acceleration_m_s2=robot.max_acceleration_m_s2,
                max_jerk_m_s3=robot.max_jerk_m_s3,
                emergency_deceleration_m_s2=robot.emergency_deceleration_m_s2,
                sensor=_sensor(robot.sensor),
                margin_m=robot.margin_m,
            ),
            tuple(
                Person(
                    name,
                    *_pose(person),
                    radius_m=person.radius_m,
                    posture=person.posture,
                    personal_distance_m=own_distance_m(values[name]),
                    approach_speed_m_s=asked_speed_m_s(values[name]),
                    comfort=_comfort(name, person, file),
                    walk=_walk(name, person, file),
                    reacts=person.reacts,
                    steps_aside=person.steps_aside,
                    lets_pass=person.lets_pass,
                    margin_facts=margin_facts.get(name, MarginFacts()),
                )
                for name, person in file.scenario.people.items()
            ),
            groups=tuple(Group(name, members) for name, members in file.scenario.groups.items()),
            passers_by=_passers_by(file),
            keep_to=file.scenario.keep_to,
        )
        check_walks(scene)
        check_groups(scene)
        place_passers_by(scene, seed)
    except SceneError as error:
        raise error.at(file.where(*_location(error, file))) from None
    return scene


def require_margin(file: ScenarioFile, scene: Scene) -> None:
    """Refuse a margin below that of the simulated robot; a real robot has its own limit.

    Raises:
        InputError: with its line, if it is too low.
    """
    if file.real_robot:
        return
    try:
        check_margin(scene.robot)
    except SceneError as error:
        raise error.at(file.where("robot", "margin_m")) from None


def _pose(standing: written.Placement) -> tuple[float, float, float]:
    """Position x, y [m] and heading [rad]."""
    assert standing.at_m is not None  # placed before
    return (*standing.at_m, math.radians(standing.facing_deg or 0.0))


def _sensor(sensor: written.SensorSpec) -> Sensor:
    return Sensor(
        sigma_m=sensor.noise_m,
        delay_s=sensor.delay_s,
        range_m=sensor.range_m,
        field_of_view_deg=sensor.field_of_view_deg,
        hidden_by_walls=sensor.hidden_by_walls,
    )


def _comfort(name: str, person: written.PersonSpec, file: ScenarioFile) -> Comfort | None:
    if person.comfort is None:
        return None
    try:
        return Comfort(*person.comfort.wants_m, person.comfort.shows, person.comfort.chance)
    except SceneError:
        nearest, farthest = person.comfort.wants_m
        raise InputError(
            expected=f"wants_m as two distances, the nearer one first: up to {NEAREST_M[1]:g} m, and at "
            f"least {NARROWEST_M:g} m more, up to {FARTHEST_M:g} m",
            got=f"[{nearest:g}, {farthest:g}]",
            remedy="Write them as in `wants_m: [0.8, 1.1]`.",
            where=file.where("people", name, "comfort", "wants_m"),
        ) from None


def _walk(name: str, person: written.PersonSpec, file: ScenarioFile) -> Walk | None:
    walks = person.walks
    if walks is None:
        return None
    pauses_s = walks.pause_s if isinstance(walks.pause_s, tuple) else (walks.pause_s,) * len(walks.route)
    try:
        return Walk(
            walks.route, walks.loop, walks.speed_m_s, pauses_s, walks.stops, accompanied=walks.accompanied
        )
    except SceneError as error:
        raise error.at(file.where("people", name, "walks")) from None


def _passers_by(file: ScenarioFile) -> PassersBy | None:
    asked = file.scenario.passers_by
    if asked is None:
        return None
    return PassersBy(asked.count, asked.between, asked.speed_m_s, asked.reacts)


def _location(error: SceneError, file: ScenarioFile) -> tuple[str | int, ...]:
    """Position in the file of the object that the error concerns."""
    scenario, entity = file.scenario, error.entity
    if (entity, error.field) == ("scene", "people"):
        return ("people",)
    if error.field == "members":
        return ("groups", entity)
    if entity in scenario.people:
        key = {"walk": "walks"}.get(error.field or "", error.field or "at_m")
        return ("people", entity, key if key in ("walks", "reacts", "steps_aside", "lets_pass") else "at_m")
    if entity == scenario.robot.name:
        return ("robot", "name" if error.field == "name" else "at_m")
    if entity == "passers_by":
        return ("passers_by", error.field or "count")
    return ("place", *_in_place(entity, scenario.place))


def _in_place(entity: str, place: MapPlace | written.Place) -> tuple[str | int, ...]:
    if isinstance(place, MapPlace):
        return ("map",)
    for i, item in enumerate(place.furniture):
        if item.name == entity:
            return ("furniture", i)
    return ("walls_m", int(entity.removeprefix("wall ")) - 1) if entity.startswith("wall ") else ()
