"""Updates a scenario with the true poses of robot and people before planning."""

from __future__ import annotations

import math
import time
from dataclasses import replace
from typing import TYPE_CHECKING, TypeVar

from comity.live.driving import sleep_of
from comity.scenario import Placement
from comity_executor.robots.raised import raised
from comity_fis import InputError

if TYPE_CHECKING:
    from collections.abc import Sequence

    from comity.scenario import RobotStart, ScenarioFile
    from comity_executor import Localisation, MapRobot, PersonTrack

PATIENCE_S = 10.0
"""Maximum time until the robot knows its pose and its tracks [s] (our choice)."""
EVERY_S = 0.1
FARTHEST_REACH_M = 3.0
"""Maximum reach of a robot's gestures [m] (our choice)."""
PlacementT = TypeVar("PlacementT", bound=Placement)


def as_seen(file: ScenarioFile, base: MapRobot) -> ScenarioFile:
    """The scenario with the robot's measured pose and the positions of tracked people.

    Args:
        file: The scenario; untracked people stay at its positions.
        base: The robot.

    Raises:
        InputError: The robot does not report its pose or its tracks.
    """
    here, tracks = _sensed(base)
    scenario = file.scenario
    robot = _standing(_reaching(scenario.robot, base), here.x_m, here.y_m, here.heading_rad)
    seen = {track.person: track for track in tracks if track.person in scenario.people}
    people = {
        name: _as_tracked(person, seen[name]) if name in seen else person
        for name, person in scenario.people.items()
    }
    scenario = scenario.model_copy(update={"robot": robot, "people": people})
    return replace(file, scenario=scenario, real_robot=True)


def _reaching(robot: RobotStart, base: MapRobot) -> RobotStart:
    """The robot with its stated reach of gestures; the scenario's values stay for other gestures.

    Raises:
        InputError: A stated reach is not a length.
    """
    stated = getattr(base, "gesture_reach_m", {})
    try:
        own = {str(gesture): float(reach_m) for gesture, reach_m in stated.items()}
    except (AttributeError, TypeError, ValueError):
        own = {"": math.nan}
    if not all(0.0 <= reach_m <= FARTHEST_REACH_M for reach_m in own.values()):
        raise InputError(
            expected=f"gesture_reach_m of the robot as lengths of 0 to {FARTHEST_REACH_M:g} m by gesture",
            got=repr(stated),
            remedy="State how far each gesture reaches beyond the body, as in {'wave': 0.4}.",
        )
    return robot.model_copy(update={"gesture_reach_m": {**robot.gesture_reach_m, **own}})


def for_adults(file: ScenarioFile, *, adults_only: bool) -> ScenarioFile:
    """The scenario with the operator's statement, if made, that people of unknown age are adults."""
    if not adults_only:
        return file
    return replace(file, scenario=file.scenario.model_copy(update={"adults_only": True}))


def with_reduced_margin(file: ScenarioFile, *, allowed: bool) -> ScenarioFile:
    """The scenario with the operator's permission to pass people at the reduced margin, or without."""
    return replace(file, reduced_margin=allowed)


def slowed(file: ScenarioFile, max_speed_m_s: float | None) -> ScenarioFile:
    """The scenario with the robot's maximum speed limited.

    Raises:
        InputError: The limit is not a speed.
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


def _sensed(base: MapRobot) -> tuple[Localisation, Sequence[PersonTrack]]:
    """Pose and tracks of the robot, once both are known."""
    sleep, rounds = sleep_of(base) or time.sleep, round(PATIENCE_S / EVERY_S)
    got = ""
    for _ in range(rounds):
        try:
            here, tracks = base.localisation(), base.tracks()
        except Exception as error:
            here, tracks, got = None, None, raised(error)
        else:
            got = f"None from its `{'localisation' if here is None else 'tracks'}`"
        if here is not None and tracks is not None:
            return here, tracks
        sleep(EVERY_S)
    raise InputError(
        expected=f"a robot that knows where it is and whom it sees within {PATIENCE_S:g} s",
        got=got,
        remedy="Localise it on the map of the scenario, and start its tracker, first.",
    )


def _as_tracked(person: PlacementT, track: PersonTrack) -> PlacementT:
    heading = track.heading_rad
    if heading is None:
        heading = math.radians(person.facing_deg or 0.0)
    return _standing(person, track.x_m, track.y_m, heading)


def _standing(standing: PlacementT, x_m: float, y_m: float, heading_rad: float) -> PlacementT:
    """A placement rounded to a millimetre and a tenth of a degree, for readable run files."""
    facing_deg = round(math.degrees(math.remainder(heading_rad, math.tau)), 1)
    return standing.model_copy(
        update={"at_m": (round(x_m, 3), round(y_m, 3)), "at": None, "facing_deg": facing_deg}
    )
