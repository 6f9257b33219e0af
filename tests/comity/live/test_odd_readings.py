"""What a robot reads that looks like a mistake in its code is noted once, and used all the same."""

from __future__ import annotations

import math
from dataclasses import replace

import pytest
from gliding import SCENARIO, gliding, written

from comity.live.odd_readings import OddReadings
from comity.live.start import as_seen
from comity.live_episode import LiveEpisode
from comity.preparation import prepare
from comity.scenario import load_scenario
from comity_executor import Localisation, PersonTrack


def noted(here: Localisation | None, *tracks: PersonTrack) -> list[str]:
    odd = OddReadings({"anna", "ben"}, "robot")
    for t in range(3):
        odd.take_in(float(t), here, tracks)
    assert {(one.t, one.kind, one.about) for one in odd.notes} <= {(0.0, "reading", "robot")}
    return [one.text for one in odd.notes]


@pytest.mark.parametrize(
    ("heading_rad", "is_odd"), [(math.tau, False), (-3.0, False), (200.0, True), (-90.0, True)]
)
def test_a_heading_of_more_than_a_turn_is_noted_of_the_robot_and_of_people(heading_rad, is_odd):
    here = Localisation(1.0, 1.0, heading_rad, 0.0, 0.0)
    tracks = [PersonTrack(i, 2.0, 2.0, 0.0, heading_rad, person="anna") for i in range(2)]
    calls = [text.split(":")[0] for text in noted(here, *tracks)]
    assert calls == (["localisation", "tracks"] if is_odd else [])


@pytest.mark.parametrize(
    ("person", "like"), [("Anna", "'anna'"), ("BEN", "'ben'"), ("Carla", None), ("anna", ""), (None, "")]
)
def test_a_name_that_the_scenario_does_not_have_is_noted_with_the_one_that_may_be_meant(person, like):
    """The name itself is not: it may be a passer-by's."""
    texts = noted(None, PersonTrack(7, 2.0, 2.0, 0.0, person=person))
    if like == "":
        assert texts == []
    else:
        (text,) = texts
        assert "track 7" in text
        assert person not in text
        assert [name for name in ("'anna'", "'ben'") if name in text] == ([like] if like else [])


def carried_out(here, robot):
    file = load_scenario(written(here, SCENARIO))
    live = LiveEpisode(prepare(as_seen(file, robot)), robot=robot)
    live.run()
    return live.so_far()


def test_the_run_has_each_note_once(here):
    robot = gliding()
    robot.called["guest"] = "Guest"
    robot.tells = lambda said: replace(said, heading_rad=math.degrees(said.heading_rad) + 720.0)
    readings = [one for one in carried_out(here, robot).disturbances if one.kind == "reading"]
    assert [one.t for one in readings] == [0.0, 0.0]
    assert ["'guest'" in one.text for one in readings] == [False, True]


def test_why_a_sense_is_silent_is_told_with_the_line_that_raised(here):
    robot = gliding()
    tracks = robot.tracks
    robot.tracks = lambda: 1 / 0 if 102.0 <= robot.t < 104.0 else tracks()
    (halt,) = [one for one in carried_out(here, robot).disturbances if one.kind == "fault"]
    assert "tracker" in halt.text
    assert "ZeroDivisionError" in halt.text
    assert "test_odd_readings.py:" in halt.text
    assert halt.end_s == pytest.approx(4.0, abs=0.2)
