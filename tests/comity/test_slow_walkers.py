"""A person who walks slowly, and agreed to be accompanied, is greeted on the way."""

from __future__ import annotations

import random
from pathlib import Path

import pytest

from comity.episode import Episode
from comity.live_episode import execute
from comity.preparation import prepare
from comity.scenario import load_scenario
from comity.system import library

PROFILES = sorted(library.shipped("profile"))
SENSORS = ("noise_m: 0.0", "noise_m: 0.03, delay_s: 0.1")


def met(folder: Path, seed: int, sensor: str, speed_m_s: float) -> Episode:
    """The robot visits somebody who walks round and round between four random points of an empty room."""
    dice = random.Random(seed)
    start, *route = [[round(dice.uniform(1.5, 8.5), 2), round(dice.uniform(1.5, 6.5), 2)] for _ in range(4)]
    scenario = folder / f"{seed}.scenario.yaml"
    scenario.write_text(f"""\
schema_version: 1
name: slow-walker
place: {{width_m: 10.0, height_m: 8.0}}
robot: {{at_m: [1.0, 1.0], sensor: {{{sensor}}}}}
people:
  anna:
    profile: {dice.choice(PROFILES)}
    at_m: {start}
    walks: {{route: {route}, loop: true, speed_m_s: {speed_m_s}, accompanied: true}}
goals: [{{greet: anna}}]
""")
    return execute(prepare(load_scenario(str(scenario))), seed=seed)


@pytest.mark.parametrize("sensor", SENSORS)
def test_who_walks_at_a_fifth_of_a_metre_a_second_is_greeted_and_mostly_within_a_minute(
    sensor: str, tmp_path: Path
) -> None:
    """Of 24 such walks with each sensor 1 and 3 took longer; the medians were 30 and 32 s."""
    episodes = [met(tmp_path, seed, sensor, 0.2) for seed in range(4)]
    assert [episode.visits[0].outcome for episode in episodes] == ["greeted"] * 4
    assert sum(episode.frames.time_s[-1] < 60.0 for episode in episodes) >= 3


@pytest.mark.study
@pytest.mark.parametrize("sensor", SENSORS)
def test_of_a_hundred_three_are_missed_at_most(sensor: str, tmp_path: Path) -> None:
    """A person who turns every few steps has turned again when the robot has got before them.

    None was missed with perfect sensors, and three with noise.
    """
    episodes = (met(tmp_path, seed, sensor, 0.2) for seed in range(100))
    missed = [seed for seed, episode in enumerate(episodes) if episode.visits[0].outcome != "greeted"]
    assert len(missed) <= 3, missed
