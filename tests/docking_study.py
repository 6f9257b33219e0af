"""The study of docking: how exactly the robot stands before people, over random starts.

`python tests/docking_study.py [STARTS]` prints the table of docs/reference/docking.md, 1,000 starts a case.
"""

from __future__ import annotations

import math
import sys
from collections.abc import Iterator, Mapping
from dataclasses import astuple, dataclass
from typing import Any

import numpy as np
from studying import studied

from comity_sim2d import DockingPose, Person, RobotBody, Room, Scene, Sensor, World, docked

SIZE_M = 24.0
PERFECT, NOISY = Sensor(), Sensor(sigma_m=0.03, delay_s=0.1)
FOLLOWED_S = 5.0
"""After the robot says it has arrived, every tick counts for so long."""
LIMIT_S = 30.0


@dataclass(frozen=True)
class Case:
    """A kind of visit."""

    text: str
    sensor: Sensor = PERFECT
    drift_m_s: float = 0.0
    drive: str = "omnidirectional"


CASES: Mapping[str, Case] = {
    "static": Case("nobody moves, perfect sensors"),
    "noisy": Case("nobody moves, 3 cm and 100 ms", NOISY),
    "drifting": Case("the person drifts aside or back at 0.2 m/s, 3 cm and 100 ms", NOISY, 0.2),
    "differential": Case("nobody moves, perfect sensors, differential", drive="differential"),
    "differential, noisy": Case("nobody moves, 3 cm and 100 ms, differential", NOISY, drive="differential"),
    "differential, drifting": Case(
        "the person drifts aside or back at 0.2 m/s, 3 cm and 100 ms, differential",
        NOISY,
        0.2,
        "differential",
    ),
}


@dataclass(frozen=True)
class Errors:
    """Of one visit, one row a tick."""

    distance_m: list[float]
    bearing_deg: list[float]
    facing_deg: list[float]
    arrived: bool


def visit(case: Case, seed: int) -> Errors:
    """Dock from somewhere to somebody, and stay with them."""
    rng = np.random.default_rng([seed, 7])
    middle = SIZE_M / 2
    person = Person("p0", middle, middle, rng.uniform(-math.pi, math.pi))
    away, where = rng.uniform(1.0, 4.0), rng.uniform(-math.pi, math.pi)
    robot = RobotBody(
        middle + away * math.cos(where),
        middle + away * math.sin(where),
        rng.uniform(-math.pi, math.pi),
        sensor=case.sensor,
        drive=case.drive,
    )
    pose = DockingPose(rng.uniform(0.45, 1.2), float(rng.choice([0.0, 50.0, -50.0])))
    course = person.heading_rad + rng.uniform(0.5, 1.5) * math.pi  # aside or back: who goes ahead walks
    step = (case.drift_m_s / 20 * math.cos(course), case.drift_m_s / 20 * math.sin(course))
    world = World(Scene(Room.rectangle(SIZE_M, SIZE_M), robot, (person,)), seed)
    world.robot.dock("p0", pose, speed_m_s=0.7)
    return _followed(world, pose, step)


def _followed(world: World, pose: DockingPose, step: tuple[float, float]) -> Errors:
    errors, end_s, arrived = Errors([], [], [], arrived=False), math.inf, False
    while world.time_s < end_s:
        person = world.people[0]
        if step != (0.0, 0.0):
            world.move_person("p0", person.x_m + step[0], person.y_m + step[1], person.heading_rad)
        world.step()
        if math.isinf(end_s) and (world.robot.motion().state == "succeeded" or world.time_s > LIMIT_S):
            arrived, end_s = world.robot.motion().state == "succeeded", world.time_s + FOLLOWED_S
        if math.isfinite(end_s):
            stands = docked(world.robot.pose, world.scene.robot.radius_m, world.people[0])
            errors.distance_m.append(abs(stands.distance_m - pose.distance_m))
            errors.bearing_deg.append(abs((stands.bearing_deg - pose.bearing_deg + 180) % 360 - 180))
            errors.facing_deg.append(stands.facing_error_deg)
    return Errors(errors.distance_m, errors.bearing_deg, errors.facing_deg, arrived)


@dataclass(frozen=True)
class Figures:
    """Of many visits: median, 95th percentile and maximum."""

    distance_m: tuple[float, float, float]
    bearing_deg: tuple[float, float, float]
    facing_deg: tuple[float, float, float]
    arrived: float
    """Share of the visits."""


def row(case: str, seed: int) -> tuple[Any, ...]:
    """One visit as the study's file has it."""
    return astuple(visit(CASES[case], seed))


def visits_of(case: str, starts: int) -> list[Errors]:
    """The visits of a case from the starts of the seeds from 0 on."""
    return [Errors(*each) for each in studied("docking", row, [(case, seed) for seed in range(starts)])]


def figures(visits: list[Errors]) -> Figures:
    """The figures of a case, every tick of every visit counted."""

    def spread(name: str) -> tuple[float, float, float]:
        values = np.concatenate([getattr(each, name) for each in visits])
        median, high, most = np.percentile(values, (50, 95, 100))
        return float(median), float(high), float(most)

    return Figures(
        spread("distance_m"),
        spread("bearing_deg"),
        spread("facing_deg"),
        float(np.mean([each.arrived for each in visits])),
    )


def table(starts: int) -> Iterator[str]:
    """The table of the documentation."""
    yield "| case | distance, cm | bearing, degrees | facing, degrees | arrived |"
    yield "|---|---|---|---|---|"
    for name, case in CASES.items():
        got = figures(visits_of(name, starts))
        cm = " / ".join(f"{100 * value:.2f}" for value in got.distance_m)
        bearing, facing = (
            " / ".join(f"{value:.2f}" for value in values) for values in (got.bearing_deg, got.facing_deg)
        )
        yield f"| {case.text} | {cm} | {bearing} | {facing} | {got.arrived:.1%} |"


if __name__ == "__main__":
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 1000
    print(f"Median / 95th percentile / maximum over {count} starts and every tick of 5 s after arriving")
    for line in table(count):
        print(line, flush=True)
