"""Whom the robot cannot see from where they want it, no plan serves; whom it can see, it docks to."""

from __future__ import annotations

import tempfile
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st
from sampling import sampled

from comity.live_episode import execute
from comity.planning.diagnosis import in_words
from comity.planning.eyeshot import needed_range_m
from comity.preparation import prepare
from comity.scenario import load_scenario

ROOM = """\
schema_version: 1
name: short sight
place: {width_m: 6, height_m: 5}
robot: {at_m: [1, 2], sensor: {range_m: %(range_m)r, noise_m: %(noise_m)r}}
people:
  ada: {profile: %(profile)s, at_m: [4, 2.5], facing_deg: 180}
goals:
  - greet: ada
"""
PROFILES = ("arab_woman", "german_man", "japanese_woman")


def prepared(range_m: float, profile: str = "german_man", noise_m: float = 0.0):
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "room.scenario.yaml")
        written = {"range_m": range_m, "profile": profile, "noise_m": noise_m}
        path.write_text(ROOM % written, encoding="utf-8")
        return prepare(load_scenario(str(path)))


def wanted_range_m(profile: str, noise_m: float = 0.0) -> float:
    far = prepared(10.0, profile, noise_m)
    return needed_range_m(far.scene, far.values["ada"]["conversational_distance"].number)


@given(st.sampled_from(PROFILES), st.sampled_from((0.0, 0.03)), st.floats(-0.2, 0.2))
@sampled(4)
def test_whoever_is_planned_for_is_reached_however_short_the_sight(profile, noise_m, more_m):
    found = prepared(max(0.75, wanted_range_m(profile, noise_m) + more_m), profile, noise_m)
    if found.asked.unreachable:
        assert more_m < 0.0
    else:
        episode = execute(found)
        assert episode.outcome == "success"
        assert episode.frames.time_s[-1] < 60.0


@pytest.mark.parametrize("profile", PROFILES)
def test_who_wants_it_farther_than_it_sees_is_left_out_with_what_would_do(profile):
    needed_m = wanted_range_m(profile)
    found = prepared(needed_m - 0.01, profile)
    (unmet,) = found.unmet
    told = in_words(unmet)
    assert "the robot would not surely see ada from where they want it" in told
    assert told.endswith(f"it would be possible if its sensor saw {needed_m:.2f} m far from its middle.")
    assert "bars the way" not in told
    assert not prepared(needed_m + 1e-6, profile).unmet
