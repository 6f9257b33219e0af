"""An episode in another process, or kept for later: pickled, it is what it was."""

from __future__ import annotations

import pickle
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context
from pathlib import Path

import numpy as np
import pytest

import comity

ORACLE = Path(__file__).parents[1] / "oracle" / "scenarios"
SMALL_BYTES = 125_000
"""A visit of twelve seconds; its frames alone take 14,000."""


@pytest.mark.parametrize(
    "name", ["door-opens", "plans-that-change", "tea-for-two", "walled-in", "wheel-sticks"]
)
def test_a_pickled_episode_says_what_it_said_before(name):
    """Doors, replanning, errands, a person out of reach and a fault: each brings objects of its own."""
    episode = comity.run(ORACLE / f"{name}.yaml")
    again = pickle.loads(pickle.dumps(episode))
    for part in ("outcome", "visits", "events", "acts", "metrics", "steps", "revisions", "trace_sha256"):
        assert getattr(again, part) == getattr(episode, part)
    assert np.array_equal(again.frames.poses, episode.frames.poses)
    assert again.prepared.unmet == episode.prepared.unmet


def test_a_pickled_episode_is_small():
    assert len(pickle.dumps(comity.run("johanna"))) < SMALL_BYTES


def test_episodes_come_back_from_other_processes():
    with ProcessPoolExecutor(2, get_context("spawn")) as pool:
        playing = [pool.submit(comity.run, "johanna", seed=seed) for seed in range(2)]
        episodes = [one.result() for one in playing]
    assert [episode.seed for episode in episodes] == [0, 1]
    assert {episode.outcome for episode in episodes} == {"success"}
