"""People have a size, and may sit on furniture: the robot keeps its distance from all of it."""

from __future__ import annotations

import math

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from judging import contacts_with_people, nearest_stop, read_tracks

import comity
from comity.preparation import prepare
from comity.scenario import load_scenario
from comity_fis import InputError

SCENARIO = """schema_version: 1
name: seats
place:
  width_m: 8
  height_m: 6
  furniture: [{{name: sofa, box_m: [5.5, 2.4, 1.0, 1.2]}}]
robot: {{at_m: [0.8, 3], sensor: {{noise_m: {noise}}}}}
people:
  host: {{profile: german_woman, at_m: [{x}, 3], facing_deg: {facing}, {more}}}
goals: [{{greet: host}}]
"""


def seats(folder, *, x=4.0, facing=180, noise=0.0, more="posture: standing"):
    path = folder / "seats.scenario.yaml"
    path.write_text(SCENARIO.format(x=x, facing=facing, noise=noise, more=more), encoding="utf-8")
    return path


@settings(max_examples=12)
@given(radius=st.floats(0.1, 1.0), facing=st.integers(-180, 180))
def test_the_distance_counts_from_the_outline_whatever_its_size(tmp_path_factory, radius, facing):
    """As the frames have it, which the judge reads: with a wheelchair the robot stands farther off."""
    folder = tmp_path_factory.mktemp("w")
    path = seats(folder, x=3.0, facing=facing, more=f"radius_m: {radius:.3f}")
    episode = comity.run(path, out=folder / "run")
    (visit,) = episode.visits
    assert visit.outcome == "greeted"
    tracks = read_tracks(folder / "run" / "frames.csv")
    assert tracks["host"][0].radius_m == pytest.approx(radius, abs=1e-3)
    stop = nearest_stop(tracks, "host")
    assert stop.distance_m == pytest.approx(visit.pose.distance_m, abs=0.02)
    apart_m = visit.docked_at.centre_distance_m - visit.docked_at.distance_m
    assert apart_m == pytest.approx(radius + 0.25, abs=1e-3)
    assert not contacts_with_people(tracks)
    assert episode.metrics.furniture_contacts == 0


@settings(max_examples=12)
@given(
    x=st.floats(5.25, 6.2),
    facing=st.sampled_from([90, 180, -90, 150]),
    noise=st.sampled_from([0.0, 0.05]),
)
def test_who_is_seated_may_sit_on_furniture(tmp_path_factory, x, facing, noise):
    """They are greeted from before it, at their distance or the next one that is free, and nothing is hit."""
    folder = tmp_path_factory.mktemp("s")
    episode = comity.run(seats(folder, x=x, facing=facing, noise=noise, more="posture: seated"))
    (visit,) = episode.visits
    assert visit.outcome == "greeted"
    assert visit.docked_at.distance_m >= 0.30
    assert episode.metrics.furniture_contacts == 0
    assert episode.metrics.person_contacts == 0


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"x": 6.0, "more": "posture: standing"}, "or let host be seated"),
        ({"x": 7.95, "more": "posture: seated"}, "is not inside the room"),
        ({"x": 4.9, "more": "radius_m: 0.7"}, "overlaps the sofa"),
        ({"more": "radius_m: 0.05"}, "radius_m"),
        ({"more": "radius_m: wide"}, "radius_m"),
    ],
)
def test_who_cannot_be_there_is_told_where_it_is_written(here, changes, words):
    with pytest.raises(InputError) as refused:
        prepare(load_scenario(str(seats(here, **changes))))
    said = str(refused.value)
    assert words in said
    assert "seats.scenario.yaml:9" in said


def test_a_random_place_has_room_for_all_of_a_person(here):
    text = SCENARIO.replace("at_m: [{x}, 3], facing_deg: {facing}", "at: random")
    path = here / "seats.scenario.yaml"
    path.write_text(text.format(noise=0.0, more="radius_m: 1.2"), encoding="utf-8")
    for seed in range(5):
        host = prepare(load_scenario(str(path)), seed=seed).scene.person("host")
        assert 1.2 <= host.x_m <= 6.8
        beside = max(5.5 - host.x_m, 0.0, host.x_m - 6.5), max(2.4 - host.y_m, 0.0, host.y_m - 3.6)
        assert math.hypot(*beside) >= 1.2
