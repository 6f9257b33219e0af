"""Positions of the robot and of people placed at named places, or at random ones drawn with the seed."""

from __future__ import annotations

import math
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from functools import cached_property
from typing import TYPE_CHECKING, TypeVar

import numpy as np

from comity.scenario import ANYWHERE, MapPlace, Placement, RandomPlace
from comity.simulation.place import map_of, written_map
from comity_fis import InputError
from comity_sim2d import SceneError
from comity_sim2d.scene.obstacles import FloorPlan, floor_plan_of
from comity_sim2d.scene.spawning import MOST_DRAWS, random_spot

if TYPE_CHECKING:
    from comity.scenario import Place, ScenarioFile
    from comity_sim2d import Area

PlacementT = TypeVar("PlacementT", bound=Placement)
STREAM = 2
"""Random stream of placement, separate from sensor noise and people's reactions."""


def placed(file: ScenarioFile, seed: int = 0) -> ScenarioFile:
    """The scenario with a position and heading for everybody, and with its map written out.

    Args:
        file: The scenario.
        seed: Seed of random places, which are drawn in the order of the scenario, the robot's first.

    Raises:
        InputError: if a named place does not exist, or there is no space for a person.
    """
    scenario, stage = file.scenario, _Stage(file, seed)
    robot = stage.named(scenario.robot, "robot")
    people = {name: stage.named(person, "people", name) for name, person in scenario.people.items()}
    stage.occupy(robot, robot.radius_m)
    for person in people.values():
        stage.occupy(person, person.radius_m)
    robot = stage.drawn(robot, robot.radius_m, "robot")
    people = {name: stage.drawn(person, person.radius_m, "people", name) for name, person in people.items()}
    settled = {"robot": robot, "people": people, "place": _with_map(file)}
    return replace(file, scenario=scenario.model_copy(update=settled))


def _with_map(file: ScenarioFile) -> Place | MapPlace:
    place = file.scenario.place
    if isinstance(place, MapPlace) and isinstance(place.map, str):
        return place.model_copy(update={"map": written_map(file, place.map)[1]})
    return place


class _Stage:
    """The place while it is filled with people."""

    def __init__(self, file: ScenarioFile, seed: int) -> None:
        self._file = file
        self._map = map_of(file)
        self._rng = np.random.Generator(np.random.PCG64([seed, STREAM]))
        self._bodies: list[tuple[tuple[float, float], float]] = []

    @cached_property
    def _plan(self) -> FloorPlan:
        place = self._map
        return floor_plan_of(place.room, place.walls, place.furniture, place.doors)

    def occupy(self, standing: Placement, radius_m: float) -> None:
        """Reserve the position of a person, so that no random place overlaps it."""
        if standing.at_m is not None:
            self._bodies.append((standing.at_m, radius_m))

    def named(self, standing: PlacementT, *section: str) -> PlacementT:
        """The placement with its position, unless it is still to be drawn."""
        at, facing = standing.at, standing.facing_deg
        if isinstance(at, RandomPlace) or at == ANYWHERE:
            return standing
        if at is None:
            return standing.model_copy(update={"facing_deg": facing or 0.0})
        with self._placing(*section):
            spot = self._map.location(at)
        if facing is None:
            facing = 0.0 if spot.heading_rad is None else math.degrees(spot.heading_rad)
        return standing.model_copy(update={"at_m": spot.xy, "at": None, "facing_deg": facing})

    def drawn(self, standing: PlacementT, radius_m: float, *section: str) -> PlacementT:
        """The placement with its position; a random one is drawn now."""
        if standing.at is None:
            return standing
        room = None
        if isinstance(standing.at, RandomPlace):
            with self._placing(*section):
                room = self._map.area(standing.at.random_in)
        spot = random_spot(self._plan, self._bodies, radius_m, self._rng, within=room)
        facing = float(self._rng.uniform(-180.0, 180.0))
        if spot is None:
            raise self._full(room, *section)
        # To the millimetre and the degree: a run's files then read like those written by people.
        at_m = (round(spot[0], 3), round(spot[1], 3))
        self._bodies.append((at_m, radius_m))
        kept = round(facing) if standing.facing_deg is None else standing.facing_deg
        return standing.model_copy(update={"at_m": at_m, "at": None, "facing_deg": float(kept)})

    @contextmanager
    def _placing(self, *section: str) -> Iterator[None]:
        try:
            yield
        except SceneError as error:
            raise error.at(self._file.where(*section, "at")) from None

    def _full(self, room: Area | None, *section: str) -> InputError:
        where = f"in the room {room.name!r}" if room else "in the place"
        return InputError(
            expected=f"a free place for {section[-1]} {where}",
            got=f"none in {MOST_DRAWS} random points",
            remedy="Put fewer people or less furniture there, or choose another room.",
            where=self._file.where(*section, "at"),
        )
