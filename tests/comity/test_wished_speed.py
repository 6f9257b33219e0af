"""A wish for an approach speed holds within 1.5 m of the person's body, from any side."""

from __future__ import annotations

import math
from pathlib import Path
from textwrap import dedent

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import comity as front_door
from comity_sim2d import Frames

NEAR_M, OVER = 1.5, 1.05
"""Distance between the bodies within which a wish holds [m], and the share of the wish that may be driven."""


def scenario(
    folder: Path, *, wish: float, at_deg: float, away_m: float, faces_deg: float, drive: str, more: str = ""
) -> str:
    """Ana in the middle of a hall, who asked for a speed, and the robot anywhere around her."""
    x, y = (6.0 + away_m * math.cos(math.radians(at_deg)), 6.0 + away_m * math.sin(math.radians(at_deg)))
    text = f"""\
        schema_version: 1
        name: slowly
        place: {{width_m: 12, height_m: 12}}
        robot: {{at_m: [{x:.3f}, {y:.3f}], drive: {drive}}}
        people:
          ana:
            profile: {{name: ana, settings: {{approach_speed: {wish}}}}}
            at_m: [6, 6]
            facing_deg: {faces_deg:.0f}
          bob: {{profile: arab_man, at_m: [9, 9], facing_deg: 225}}
        """
    path = folder / "slowly.scenario.yaml"
    path.write_text(dedent(text) + (more or "goals: [{greet: ana}]\n"), encoding="utf-8")
    return str(path)


def fastest_near_m_s(frames: Frames, person: str, since_s: float = 0.0) -> float:
    """The robot's fastest within 1.5 m of the person's body, in the whole episode."""
    i = frames.entities.index(person)
    places = frames.poses[:, :, :2]
    gaps = np.hypot(*(places[:, 0] - places[:, i]).T) - frames.radius_m[0] - frames.radius_m[i]
    speeds = np.hypot(*np.diff(places[:, 0], axis=0).T) / np.diff(frames.time_s)
    near = (np.maximum(gaps[:-1], gaps[1:]) <= NEAR_M) & (frames.time_s[:-1] >= since_s)
    return float(speeds[near].max(initial=0.0))


SIDES = st.floats(-180.0, 180.0)
WISHES = st.floats(0.1, 0.5)
DRIVES = st.sampled_from(("omnidirectional", "differential"))


@settings(max_examples=12, deadline=None)
@given(wish=WISHES, start=st.tuples(SIDES, st.floats(1.0, 5.0)), faces_deg=SIDES, drive=DRIVES)
def test_a_wished_speed_holds_from_any_side(
    tmp_path_factory: pytest.TempPathFactory,
    wish: float,
    start: tuple[float, float],
    faces_deg: float,
    drive: str,
) -> None:
    file = scenario(
        tmp_path_factory.mktemp("any side"),
        wish=wish,
        at_deg=start[0],
        away_m=start[1],
        faces_deg=faces_deg,
        drive=drive,
    )
    episode = front_door.run(file)
    assert episode.outcome == "success"
    assert fastest_near_m_s(episode.frames, "ana") <= OVER * wish
    actual = episode.metrics.stopping["ana"].speed_within_1_5_m_m_s
    assert actual is not None
    assert actual <= OVER * wish


@settings(max_examples=4, deadline=None)
@given(wish=st.floats(0.1, 0.3), at_deg=SIDES, drive=DRIVES)
def test_a_wished_speed_holds_for_a_robot_that_passes_and_one_that_leaves(
    tmp_path_factory: pytest.TempPathFactory, wish: float, at_deg: float, drive: str
) -> None:
    for goals in ("goals: [{greet: bob}]\n", "goals: [{greet: ana}, {greet: bob}]\n"):
        file = scenario(
            tmp_path_factory.mktemp("passing"),
            wish=wish,
            at_deg=at_deg,
            away_m=2.5,
            faces_deg=0.0,
            drive=drive,
            more=goals,
        )
        assert fastest_near_m_s(front_door.run(file).frames, "ana") <= OVER * wish


@settings(max_examples=4, deadline=None)
@given(wish=st.floats(0.1, 0.3), at_deg=SIDES, drive=DRIVES, at_s=st.floats(0.0, 6.0))
def test_a_speed_that_is_wished_for_on_the_way_holds_as_soon_as_the_robot_has_braked(
    tmp_path_factory: pytest.TempPathFactory, wish: float, at_deg: float, drive: str, at_s: float
) -> None:
    more = (
        "goals: [{greet: ana}]\n"
        f"changes: [{{at_s: {at_s:.2f}, person: ana, says: {{approach_speed: {wish}}}}}]\n"
    )
    file = scenario(
        tmp_path_factory.mktemp("told"),
        wish=0.5,
        at_deg=at_deg,
        away_m=3.0,
        faces_deg=180.0,
        drive=drive,
        more=more,
    )
    assert fastest_near_m_s(front_door.run(file).frames, "ana", since_s=at_s + 2.0) <= OVER * wish


def test_the_run_tells_the_speed_that_was_wished_for_and_the_fastest_that_was_driven(
    tmp_path: Path, comity
) -> None:
    file = scenario(tmp_path, wish=0.2, at_deg=180.0, away_m=3.0, faces_deg=0.0, drive="omnidirectional")
    visit = comity("run", file, "--out", tmp_path / "run", "--json").json["visits"][0]
    assert visit["approach_speed_target_m_s"] == 0.2
    assert visit["approach_speed_actual_m_s"] == pytest.approx(0.2, abs=0.01)
