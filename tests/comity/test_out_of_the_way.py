"""A robot in the path of a person who walks into a corner gets out of it, and greets them if they stop."""

from __future__ import annotations

import math
from itertools import groupby
from pathlib import Path

import numpy as np
import pytest

from comity.episode import Episode
from comity.live_episode import execute
from comity.preparation import prepare
from comity.scenario import load_scenario

CORNER, BODIES_M = (0.6, 0.6), 0.45
NEAR_M, LONG_S, TICK_S = 0.1, 2.0, 0.05


def walked(folder: Path, drive: str, at: tuple[float, float], start: tuple[float, float]) -> Episode:
    """Carla walks from the start to the corner, at 1 m/s; the robot is to greet her."""
    scenario = folder / "corner.scenario.yaml"
    scenario.write_text(f"""\
schema_version: 1
name: corner
place: {{width_m: 6, height_m: 5}}
robot: {{at_m: [{at[0]:.3f}, {at[1]:.3f}], drive: {drive}}}
people: {{carla: {{at_m: [{start[0]}, {start[1]}], facing_deg: 180}}}}
goals: [{{greet: carla}}]
changes: [{{at_s: 1, person: carla, moves_to_m: [{CORNER[0]}, {CORNER[1]}], facing_deg: 60}}]
""")
    return execute(prepare(load_scenario(str(scenario))), seed=0)


@pytest.mark.parametrize("drive", ["omnidirectional", "differential"])
@pytest.mark.parametrize("start", [(5.0, 4.0), (5.0, 0.6)])
@pytest.mark.parametrize("share", [0.3, 0.55, 0.8, 0.95])
@pytest.mark.parametrize("beside_m", [-0.4, 0.0, 0.4])
def test_a_person_who_walks_into_a_corner_is_let_by_and_greeted_unless_they_pass_by(
    drive: str, start: tuple[float, float], share: float, beside_m: float, tmp_path: Path
) -> None:
    dx, dy = CORNER[0] - start[0], CORNER[1] - start[1]
    across = beside_m / math.hypot(dx, dy)
    at = (
        max(0.35, start[0] + share * dx - across * dy),
        max(0.35, start[1] + share * dy + across * dx),
    )
    episode = walked(tmp_path, drive, at, start)
    robot, carla = (episode.frames.of(name)[:, :2] for name in ("robot", "carla"))
    gaps = np.hypot(*(robot - carla).T) - BODIES_M
    near = [len(list(ticks)) * TICK_S for is_near, ticks in groupby(gaps < NEAR_M - 1e-9) if is_near]
    assert max(near, default=0.0) <= LONG_S
    assert episode.frames.time_s[-1] < 30.0
    if episode.visits[0].outcome == "greeted":
        assert math.dist(carla[-1], CORNER) < 0.01
    else:  # Carla walked by the robot that stood in her path, and the episode ended with that
        assert episode.visits[0].outcome == "declined"
