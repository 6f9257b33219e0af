"""The study of crowds: how fast people walk in a dense stream, and how many pass a door.

`python tests/crowd_study.py [SEEDS]` prints the tables of docs/reference/crowd.md, and `python
tests/crowd_picture.py` draws them.

Streams are compared with Weidmann 1993 ("Transporttechnik der Fussgaenger", ETH Zurich), doors with the 1.9
people per second and metre that Seyfried et al. 2009 measured ("New insights into pedestrian flow through
bottlenecks", Transportation Science 43, 395-406).
"""

from __future__ import annotations

import argparse
import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from comity_sim2d import RobotBody, Room, Scene, Wall
from comity_sim2d.people.crowd import Bodies, Crowd
from comity_sim2d.people.itinerary import Itinerary
from comity_sim2d.people.outlines import Outlines
from comity_sim2d.people.pedestrian_behaviour import PedestrianBehaviour, Stroller
from comity_sim2d.scene.footpath import Footpaths
from comity_sim2d.scene.obstacles import floor_plan
from comity_sim2d.scene.robot_reaction import RobotSeen

STEP_S = 0.1
RADIUS_M, THICK_M = 0.2, 0.2
PACE_M_S, SPREAD_M_S = 1.34, 0.26
"""Free walking speed of adults, mean and standard deviation (Weidmann 1993)."""
LENGTH_M, WIDTH_M = 10.0, 2.0
"""The stretch of corridor that is repeated before and behind itself."""
HALL_M = 6.0
LEAVING = 60
"""People in the hall, as in the experiments of Seyfried et al. 2009."""
SEYFRIED_S_M = 1.9
"""People per second and metre of width that pass a door (Seyfried et al. 2009)."""
DENSITIES = (0.5, 1.0, 1.5, 2.0, 2.5, 3.0)
DOORS_M = (0.7, 0.8, 1.0, 1.2, 1.6, 2.0)


def weidmann_m_s(per_m2: float) -> float:
    """Mean speed in a stream of this density [people per square metre], up to 5.4 of them."""
    return PACE_M_S * (1.0 - math.exp(-1.913 * (1.0 / per_m2 - 1.0 / 5.4)))


def crowd(
    scene: Scene, starts: Sequence[complex], goals: Sequence[complex], paces: Sequence[float], seed: int
) -> Crowd:
    """People who go from here to there at their own pace, in a scene whose robot is out of the way."""
    plan = floor_plan(scene)
    paths = Footpaths(plan, RADIUS_M)
    strollers = tuple(
        Stroller(i, float(pace), Itinerary([((goal.real, goal.imag), 0.0)], loop=False, paths=paths))
        for i, (goal, pace) in enumerate(zip(goals, paces, strict=True))
    )
    at = np.array([*starts, complex(scene.robot.x_m, scene.robot.y_m)])
    bodies = Bodies(at, np.zeros(len(at)), np.array([*[RADIUS_M] * len(starts), scene.robot.radius_m]))
    strolling = PedestrianBehaviour(strollers, at, plan, STEP_S)
    outlines = Outlines.of(scene)
    return Crowd(bodies, strollers, strolling, outlines, step_s=STEP_S, decision_s=STEP_S, seed=seed)


def decide(people: Crowd, scene: Scene) -> None:
    """One step, with the robot where it stands."""
    robot = scene.robot
    people.decide(RobotSeen(complex(robot.x_m, robot.y_m), 0j, 0.0, robot.radius_m))
    people.advance()


def spread(
    count: int, corner: complex, width_m: float, height_m: float, rng: np.random.Generator
) -> list[complex]:
    """Places on a grid that fills a rectangle, in random order."""
    columns = math.ceil(math.sqrt(count * width_m / height_m))
    rows = math.ceil(count / columns)
    cells = [
        corner + complex((i + 0.5) * width_m / columns, (j + 0.5) * height_m / rows)
        for i in range(columns)
        for j in range(rows)
    ]
    return [cells[i] for i in rng.permutation(len(cells))[:count]]


def paces(count: int, rng: np.random.Generator) -> Any:
    """Free speeds, within what adults walk."""
    return rng.normal(PACE_M_S, SPREAD_M_S, count).clip(0.6, 2.0)


def stream_m_s(per_m2: float, seed: int, *, lasts_s: float = 30.0, settles_s: float = 12.0) -> float:
    """Mean speed along a corridor of this density, once the stream has settled.

    The people of one stretch are repeated in the stretch before and behind; whoever leaves it comes in again.
    """
    rng, count = np.random.default_rng(seed), round(per_m2 * LENGTH_M * WIDTH_M)
    stretch = spread(count, complex(2 * LENGTH_M, 1.0 + RADIUS_M), LENGTH_M, WIDTH_M - 2 * RADIUS_M, rng)
    end_m = 6 * LENGTH_M
    sides = (1.0 - THICK_M / 2, 1.0 + WIDTH_M + THICK_M / 2)
    walls = tuple(Wall((0.0, y), (end_m - 2.0, y), THICK_M) for y in sides)
    scene = Scene(Room.rectangle(end_m, WIDTH_M + 2.0), RobotBody(end_m - 0.5, 0.4), (), walls)
    shifts = (0.0, -LENGTH_M, LENGTH_M)
    everyone = [place + shift for shift in shifts for place in stretch]
    goals = [complex(end_m - 3.0, place.imag) for place in everyone]
    people = crowd(scene, everyone, goals, [*paces(count, rng)] * 3, seed)
    speeds = []
    for step in range(round(lasts_s / STEP_S)):
        decide(people, scene)
        here = people.at[:count]
        here -= LENGTH_M * np.floor(here.real / LENGTH_M - 2.0)
        for image, shift in enumerate(shifts):
            part = slice(image * count, (image + 1) * count)
            people.at[part] = here + shift
            people.velocity[part], people.heading[part] = people.velocity[:count], people.heading[:count]
        if step * STEP_S >= settles_s:
            speeds.append(people.velocity[:count].real.mean())
    return float(np.mean(speeds))


@dataclass(frozen=True)
class Leaving:
    """How a hall empties through one door."""

    out: int
    flow_s: float
    """People per second, from the tenth to the fiftieth; not a number where fewer come out."""
    last_s: float


def leaving(door_m: float, seed: int, *, lasts_s: float = 150.0) -> Leaving:
    """Sixty people leave a hall of 6 x 6 m by a door of this clear width [m]."""
    rng = np.random.default_rng(seed)
    post_m = (door_m + THICK_M) / 2  # walls have round ends, so that the clear width is the door's
    middle, at_m = HALL_M / 2, HALL_M + THICK_M / 2
    walls = (
        Wall((at_m, 0.0), (at_m, middle - post_m), THICK_M),
        Wall((at_m, middle + post_m), (at_m, HALL_M), THICK_M),
    )
    scene = Scene(Room.rectangle(13.0, HALL_M), RobotBody(12.7, 0.3), (), walls)
    starts = spread(LEAVING, complex(0.3, 0.3), HALL_M - 1.1, HALL_M - 0.6, rng)
    goals = [complex(12.4, y) for y in rng.uniform(0.8, HALL_M - 0.5, LEAVING)]
    people = crowd(scene, starts, goals, paces(LEAVING, rng), seed)
    out_s: dict[int, float] = {}
    for step in range(round(lasts_s / STEP_S)):
        decide(people, scene)
        for i in np.flatnonzero(people.at[:LEAVING].real > HALL_M + THICK_M).tolist():
            out_s.setdefault(i, step * STEP_S)
        for i in np.flatnonzero(people.at[:LEAVING].real > 10.0).tolist():
            people.hold(i)  # far from the door, and out of everyone's way
            people.put(i, complex(1000.0 + 3.0 * i, 1000.0), 0.0)
        if len(out_s) == LEAVING:
            break
    times = sorted(out_s.values())
    flow_s = 40.0 / (times[49] - times[9]) if len(times) >= 50 else math.nan
    return Leaving(len(times), flow_s, times[-1] if times else math.nan)


def streams(seeds: range) -> dict[float, float]:
    """Mean speed by density."""
    return {each: float(np.mean([stream_m_s(each, seed) for seed in seeds])) for each in DENSITIES}


def doors(seeds: range) -> dict[float, list[Leaving]]:
    """How the hall empties, by the width of its door."""
    return {each: [leaving(each, seed) for seed in seeds] for each in DOORS_M}


def tables(speeds: dict[float, float], found: dict[float, list[Leaving]]) -> Iterator[str]:
    """The tables of the docs."""
    yield "| people per m² | Weidmann 1993 [m/s] | Comity [m/s] | difference |"
    yield "|---|---|---|---|"
    for per_m2, speed in speeds.items():
        known = weidmann_m_s(per_m2)
        yield f"| {per_m2:g} | {known:.2f} | {speed:.2f} | {100 * (speed / known - 1):+.0f} % |"
    yield ""
    yield "| door [m] | Seyfried 2009 [1/s] | Comity [1/s], range of seeds | out | last [s], slowest seed |"
    yield "|---|---|---|---|---|"
    for door_m, each in found.items():
        flows = [one.flow_s for one in each]
        out = min(one.out for one in each)
        yield (
            f"| {door_m:g} | {SEYFRIED_S_M * door_m:.2f} | {np.mean(flows):.2f}, {min(flows):.2f} to "
            f"{max(flows):.2f} | {out} of {LEAVING} | {max(one.last_s for one in each):.0f} |"
        )


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.split("\n", 1)[0])
    parser.add_argument("seeds", nargs="?", type=int, default=10)
    told = parser.parse_args()
    by_density, by_door = streams(range(told.seeds)), doors(range(told.seeds))
    print("\n".join(tables(by_density, by_door)))
