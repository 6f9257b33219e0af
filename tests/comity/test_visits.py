"""Episodes, judged from frames.csv by geometry that shares no code with the packages."""

from __future__ import annotations

import json
import math
import re

import pytest
from judging import gap, nearest_stop, read_tracks, speeds

# The exact integrals of the paper's second case, in metres: individualism 38 and 67, woman and man.
WANTED_M = {"arab_woman": 0.6402, "german_woman": 0.8469, "arab_man": 0.8753, "german_man": 1.0910}


@pytest.mark.parametrize("profile", WANTED_M)
@pytest.mark.parametrize("person", ["host", "guest"])
def test_the_robot_stops_at_the_distance_derived_from_the_persons_culture(comity, here, person, profile):
    """Within 1 cm and 5 degrees, for each of the paper's profiles, whoever bears it."""
    said = comity("run", "two-visits", "--as", f"{person}={profile}", "--out", "run", "--json")
    assert said.code == 0, said.err
    visit = next(visit for visit in said.json["visits"] if visit["person"] == person)
    assert visit["profile"] == profile
    assert visit["pose_free"]

    stop = nearest_stop(read_tracks(here / "run" / "frames.csv"), person)
    assert stop.distance_m == pytest.approx(WANTED_M[profile], abs=0.01)
    assert abs(math.remainder(stop.bearing_deg - visit["bearing_wanted_deg"], 360)) < 5.0
    assert stop.facing_error_deg < 5.0
    # The run's own figures say the same as the frames.
    assert visit["distance_reached_m"] == pytest.approx(stop.distance_m, abs=0.01)
    assert visit["centre_distance_reached_m"] == pytest.approx(stop.distance_m + 0.45, abs=0.01)
    assert visit["bearing_reached_deg"] == pytest.approx(stop.bearing_deg, abs=2.0)


@pytest.mark.parametrize(
    "scenario",
    ["johanna", "two-visits", "seated-visit", "blocked-front", "reception", "walled-in", "acquaintance"],
)
def test_every_shipped_scenario_is_safe_and_serves_whom_it_can(comity, here, scenario):
    """Nobody is touched, nobody is approached fast, and only who cannot be reached is not greeted."""
    said = comity("run", scenario, "--out", "run", "--json")
    answer = said.json
    unserved = {visit["person"] for visit in answer["visits"] if visit["outcome"] != "greeted"}
    assert unserved == ({"vera"} if scenario == "walled-in" else set())
    assert answer["outcome"] == ("partial" if unserved else "success")
    assert said.code == (1 if unserved else 0)

    tracks = read_tracks(here / "run" / "frames.csv")
    robot = tracks.pop("robot")
    for person in tracks.values():
        assert min(gap(*pair) for pair in zip(robot, person, strict=True)) > 0.25
        near = {round(body.t, 3) for body, other in zip(robot, person, strict=True) if gap(body, other) < 1.5}
        assert all(speed <= 0.5 + 0.02 for body, speed in speeds(robot) if round(body.t, 3) in near)
    assert answer["metrics"]["touches"] == 0


def test_people_who_sit_are_approached_from_the_side(comity):
    """The evidence of Dautenhahn et al. (2006) reaches the world: about 45 degrees off the front."""
    visit = comity("run", "seated-visit", "--json").json["visits"][0]
    assert 22.5 < abs(visit["bearing_reached_deg"]) < 67.5


def test_a_blocked_place_is_replaced_by_the_best_free_one_and_says_so(comity):
    """The robot still greets, from elsewhere, and names what stood in the way."""
    visit = comity("run", "blocked-front", "--json").json["visits"][0]
    assert visit["outcome"] == "greeted"
    assert visit["pose_free"] is False
    assert "blocked by the counter" in visit["deviation_reason"]
    assert visit["distance_reached_m"] > visit["distance_wanted_m"] + 0.05


def test_somebody_behind_walls_is_a_partial_outcome_with_a_reason(comity):
    said = comity("run", "walled-in", "--json")
    vera = next(visit for visit in said.json["visits"] if visit["person"] == "vera")
    assert vera["outcome"] == "unreachable"
    assert "no free and reachable place" in vera["reason"]
    assert vera["distance_reached_m"] is None


def test_the_summary_says_who_was_met_how_and_why(comity):
    said = comity("run", "two-visits")
    assert said.code == 0
    for expected in ("host", "guest", "german_man", "arab_woman", "0.640", "1.091", "individualism is LC2"):
        assert expected in said.out
    assert re.search(r"45\.[01] cm farther from host than from guest", said.out)


def test_distances_that_look_the_same_are_called_the_same(comity, here):
    (here / "alike.scenario.yaml").write_text(
        "schema_version: 1\nname: alike\nplace: {width_m: 8, height_m: 6}\nrobot: {at_m: [4, 1]}\n"
        "people:\n  left: {at_m: [2, 4], facing_deg: -90}\n  right: {at_m: [6, 4], facing_deg: -90}\n"
        "goals: [{greet: left}, {greet: right}]\n"
    )
    said = comity("run", "alike.scenario.yaml")
    assert re.search(r"The robot stopped as far from (left as from right|right as from left)\.", said.out)
    assert "0.0 cm" not in said.out


def test_a_wish_goes_before_culture(comity, here):
    """What somebody asked for replaces what their profile would have given."""
    (here / "wish.yaml").write_text(
        "schema_version: 1\nname: wish\nculture: DEU\ngender: male\n"
        "settings: {conversational_distance: 0.7}\n"
    )
    visit = comity("run", "--as", "johanna=wish.yaml", "--json").json["visits"][0]
    assert visit["distance_wanted_m"] == 0.7
    assert visit["distance_reached_m"] == pytest.approx(0.7, abs=0.01)


@pytest.mark.parametrize("profile", ["arab_woman", "german_man"])
def test_the_last_stretch_is_driven_at_the_persons_own_approach_speed(comity, here, profile):
    comity("run", "--as", f"johanna={profile}", "--out", "run", "--json")
    reach = json.loads((here / "run" / "plan.json").read_text())["steps"][0]
    robot = read_tracks(here / "run" / "frames.csv")["robot"]
    end = robot[-1]
    near = [speed for body, speed in speeds(robot) if math.hypot(body.x - end.x, body.y - end.y) < 0.7]
    assert max(near) == pytest.approx(reach["parameters"]["approach_speed"], abs=0.02)


def test_the_older_names_stand_beside_target_and_actual_for_one_release(comity):
    (visit,) = comity("run", "--out", "run", "--no-pictures", "--json").json["visits"]
    pairs = {
        "distance_target_m": "distance_wanted_m",
        "distance_actual_m": "distance_reached_m",
        "centre_distance_actual_m": "centre_distance_reached_m",
        "bearing_target_deg": "bearing_wanted_deg",
        "bearing_actual_deg": "bearing_reached_deg",
    }
    assert all(
        isinstance(visit[newer], float) and visit[newer] == visit[older] for newer, older in pairs.items()
    )


def test_a_run_folder_of_an_older_version_is_read(comity, here):
    comity("run", "--out", "run", "--no-pictures")
    file = here / "run" / "run.json"
    told = json.loads(file.read_text())
    for visit in told["visits"]:
        for newer in [key for key in visit if "_target_" in key or "_actual_" in key]:
            if not newer.startswith("approach_speed"):
                del visit[newer]
    file.write_text(json.dumps(told))
    assert comity("metrics", "run", "--json").code == 0
    assert comity("replay", "run").code == 0
