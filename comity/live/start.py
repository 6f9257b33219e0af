"""A scenario where the robot truly is, and people where it sees them: what the plan starts from."""

from __future__ import annotations

import math
import time
from dataclasses import replace
from typing import TYPE_CHECKING, TypeVar

from comity.scenario import Standing
from comity_fis import InputError

if TYPE_CHECKING:
    from comity.scenario import ScenarioFile
    from comity_executor import Localisation, MapRobot, PersonTrack

PATIENCE_S = 10.0
"""So long a robot may take to know where it is (our choice)."""
EVERY_S = 0.1
StandingT = TypeVar("StandingT", bound=Standing)


def as_seen(file: ScenarioFile, base: MapRobot) -> ScenarioFile:
    """The scenario with the robot where it is, and those people whom it sees where it sees them.

    Args:
        file: The scenario; who is not seen stays where it has them.
        base: The robot.

    Raises:
        InputError: The robot does not say where it is.
    """
    here = _localised(base)
    scenario = file.scenario
    robot = _standing(scenario.robot, here.x_m, here.y_m, here.heading_rad)
    seen = {track.person: track for track in base.tracks() or () if track.person in scenario.people}
    people = {
        name: _as_tracked(person, seen[name]) if name in seen else person
        for name, person in scenario.people.items()
    }
    return replace(file, scenario=scenario.model_copy(update={"robot": robot, "people": people}))


def for_adults(file: ScenarioFile, *, adults_only: bool) -> ScenarioFile:
    """The scenario with the statement that nobody is under 18 whose age is not known, where it is made."""
    if not adults_only:
        return file
    return replace(file, scenario=file.scenario.model_copy(update={"adults_only": True}))


def slowed(file: ScenarioFile, max_speed_m_s: float | None) -> ScenarioFile:
    """The scenario with a robot that is no faster; one that is slower anyway stays so.

    Raises:
        InputError: It is no speed.
    """
    robot = file.scenario.robot
    if max_speed_m_s is not None and not max_speed_m_s > 0.0:
        raise InputError(
            expected="a speed in m/s above 0",
            got=f"--max-speed {max_speed_m_s:g}",
            remedy="Write one such as 0.3.",
        )
    if max_speed_m_s is None or max_speed_m_s >= robot.max_speed_m_s:
        return file
    slower = robot.model_copy(update={"max_speed_m_s": max_speed_m_s})
    return replace(file, scenario=file.scenario.model_copy(update={"robot": slower}))


def _localised(base: MapRobot) -> Localisation:
    sleep, ends_s = getattr(base, "sleep", time.sleep), base.now_s() + PATIENCE_S
    while (here := base.localisation()) is None:
        if base.now_s() >= ends_s:
            raise InputError(
                expected=f"a robot that knows where it is within {PATIENCE_S:g} s",
                got="None from its `localisation`",
                remedy="Localise it on the map of the scenario first.",
            )
        sleep(EVERY_S)
    return here


def _as_tracked(person: StandingT, track: PersonTrack) -> StandingT:
    heading = track.heading_rad
    if heading is None:
        heading = math.radians(person.facing_deg or 0.0)
    return _standing(person, track.x_m, track.y_m, heading)


def _standing(standing: StandingT, x_m: float, y_m: float, heading_rad: float) -> StandingT:
    """To the millimetre and a tenth of a degree: what a run writes of it reads like what people write."""
    facing_deg = round(math.degrees(math.remainder(heading_rad, math.tau)), 1)
    return standing.model_copy(
        update={"at_m": (round(x_m, 3), round(y_m, 3)), "at": None, "facing_deg": facing_deg}
    )
