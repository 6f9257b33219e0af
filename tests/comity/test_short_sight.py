"""A person whom the robot's sensor does not show from the target distance is served there all the same.

The robot stands at the target distance from where the person was last seen, slowly, and says that it did not
verify that they are there; it never comes nearer in order to see.
"""

from __future__ import annotations

import tempfile
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st
from sampling import sampled

from comity.episode import Episode
from comity.live_episode import execute
from comity.preparation import prepare
from comity.scenario import load_scenario

ROOM = """\
schema_version: 1
name: short sight
place: {width_m: 6, height_m: 5}
robot: {at_m: [1, 2], drive: %(drive)s, sensor: {range_m: %(range_m)r, noise_m: %(noise_m)r}}
people:
  ada: {profile: %(profile)s, at_m: [4, 2.5], facing_deg: 180}
goals:
  - greet: ada
"""
PROFILES = ("arab_woman", "german_man", "japanese_woman")
UNVERIFIED_M_S = 0.3


def met(range_m: float, profile: str, noise_m: float = 0.0, drive: str = "omnidirectional") -> Episode:
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "room.scenario.yaml")
        written = {"range_m": range_m, "profile": profile, "noise_m": noise_m, "drive": drive}
        path.write_text(ROOM % written, encoding="utf-8")
        return execute(prepare(load_scenario(str(path))))


def target_m(episode: Episode) -> float:
    return episode.values["ada"]["conversational_distance"].number


@given(
    st.sampled_from(PROFILES),
    st.sampled_from((0.0, 0.03)),
    st.sampled_from(("omnidirectional", "differential")),
    st.floats(0.75, 2.0),
)
@sampled(6)
def test_everybody_is_greeted_at_their_own_distance_however_short_the_sight(profile, noise_m, drive, range_m):
    episode = met(range_m, profile, noise_m, drive)
    (visit,) = episode.visits
    assert episode.outcome == "success"
    assert episode.frames.time_s[-1] < 60.0
    assert visit.docked_at is not None
    assert visit.docked_at.distance_m == pytest.approx(target_m(episode), abs=0.02)
    assert episode.metrics.stopping["ada"].stop_distance_error_m > -0.02 - 3 * noise_m, "it comes no nearer"


@pytest.mark.parametrize("profile", PROFILES)
def test_whom_it_does_not_see_from_there_it_comes_to_slowly_and_says_so(profile):
    far = met(10.0, profile)
    assert far.visits[0].unverified is None
    short = met(target_m(far) + 0.15, profile)
    (visit,) = short.visits
    assert visit.unverified is not None
    assert "not verified" in visit.unverified
    stop = short.metrics.stopping["ada"]
    assert stop.speed_within_1_5_m_m_s <= 1.05 * UNVERIFIED_M_S
    assert stop.stop_distance_error_m == pytest.approx(0.0, abs=0.01)


def test_the_plan_says_whom_the_robot_will_not_verify(comity, here):
    for range_m, notes in ((1.0, 1), (10.0, 0)):
        written = {"range_m": range_m, "profile": "german_man", "noise_m": 0.0, "drive": "omnidirectional"}
        Path("room.scenario.yaml").write_text(ROOM % written, encoding="utf-8")
        found = [
            note for note in comity("plan", "room.scenario.yaml", "--json").json["notes"] if "ada" in note
        ]
        assert len(found) == notes
        assert all("not verified" in note for note in found)


def test_the_trace_and_the_answer_say_that_it_is_not_verified(comity, here):
    written = {"range_m": 1.0, "profile": "german_man", "noise_m": 0.0, "drive": "omnidirectional"}
    Path("room.scenario.yaml").write_text(ROOM % written, encoding="utf-8")
    answer = comity("run", "room.scenario.yaml", "--out", "run", "--json").json
    (visit,) = answer["visits"]
    assert "not verified" in visit["unverified"]
    assert visit["pose_free"]
    assert "not verified: from where they were last seen" in comity("trace", "run", "--events").out


def test_somebody_who_is_known_to_have_gone_is_not_greeted_where_they_were(here):
    """From 0.9 m its sensor shows that nobody is there: that is known, and no matter of sight."""
    changes = "changes:\n  - {at_s: 1.0, person: ada, moves_to_m: [1.0, 4.5]}\n"
    written = {"range_m": 2.5, "profile": "arab_woman", "noise_m": 0.0, "drive": "omnidirectional"}
    Path("room.scenario.yaml").write_text(ROOM % written + changes, encoding="utf-8")
    episode = execute(prepare(load_scenario("room.scenario.yaml")))
    assert all(visit.unverified is None for visit in episode.visits)
