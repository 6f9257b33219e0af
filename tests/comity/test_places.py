"""Scenarios on maps: doors as the scenario has them, people at named and random places."""

from __future__ import annotations

import json
import math
from importlib.resources import files
from pathlib import Path

import pytest
import yaml
from hypothesis import given, settings
from hypothesis import strategies as st

from comity.preparation import prepare
from comity.recording import record
from comity.scenario import load_scenario
from comity.simulation.place import map_of
from comity.simulation.placement import placed
from comity_fis import InputError

WARD = """\
schema_version: 1
name: rounds
place: {map: ward}
robot: {at: entrance}
people:
  ada: {at: bed 1a}
  bob: {at: {random_in: day room}}
  eve: {at: random, facing_deg: 30}
goals:
  - greet: ada
"""

MAP = """\
schema_version: 1
name: two-rooms
rooms:
  kitchen: {box_m: [0, 0, 4, 4]}
  hall: {box_m: [4, 0, 4, 4]}
doors:
  kitchen: {at_m: [4, 2], width_m: 1.0}
locations:
  stove: {at_m: [1, 1], facing_deg: 90}
"""


def scenario(folder: Path, text: str = WARD):
    path = folder / "rounds.scenario.yaml"
    path.write_text(text, encoding="utf-8")
    return load_scenario(str(path))


def test_a_name_of_the_map_is_a_point_and_a_facing(tmp_path: Path) -> None:
    file = placed(scenario(tmp_path))
    bed = map_of(file).location("bed 1a")
    ada = file.scenario.people["ada"]
    assert ada.at_m == bed.xy
    assert math.radians(ada.facing_deg) == pytest.approx(bed.heading_rad)


@settings(max_examples=15, deadline=None)
@given(seed=st.integers(0, 2**32))
def test_random_places_are_the_seeds_and_nobody_overlaps(seed: int, tmp_path_factory) -> None:
    file = scenario(tmp_path_factory.mktemp("seeded"))
    once, again = placed(file, seed), placed(file, seed)
    assert once.scenario == again.scenario
    people = once.scenario.people
    at = [once.scenario.robot.at_m, *(person.at_m for person in people.values())]
    assert min(math.dist(a, b) for i, a in enumerate(at) for b in at[:i]) > 0.7
    assert people["eve"].facing_deg == 30
    x, y = people["bob"].at_m
    assert 16 < x < 24
    assert 0 < y < 4.4


def test_a_run_on_a_map_runs_again_from_its_folder_alone(tmp_path: Path) -> None:
    first = record(prepare(scenario(tmp_path), seed=5), seed=5, out=tmp_path / "a", views=())
    resolved = load_scenario(str(tmp_path / "a" / "scenario.yaml"))
    again = record(prepare(resolved, seed=9), seed=5, out=tmp_path / "b", views=())
    assert first.answer.outcome == "success"
    assert first.answer.trace_sha256 == again.answer.trace_sha256
    assert (tmp_path / "a/frames.csv").read_bytes() == (tmp_path / "b/frames.csv").read_bytes()
    content = yaml.safe_load((tmp_path / "a/scenario.yaml").read_text())
    assert content["place"]["map"]["name"] == "ward"
    assert "at" not in content["people"]["bob"]
    assert len(content["people"]["bob"]["at_m"]) == 2


def test_a_closed_door_is_named_where_it_makes_somebody_unreachable(tmp_path: Path) -> None:
    closed = WARD.replace("{map: ward}", "{map: ward, doors: {room 1: closed}}")
    prepared = prepare(scenario(tmp_path, closed))
    (unmet,) = prepared.unmet
    assert unmet.person == "ada"
    assert [(each.kind, each.name) for each in unmet.conditions] == [("door", "room 1")]
    assert unmet.conditions[0].text == "the door 'room 1' were open"


def test_somebody_out_of_reach_is_told_of_also_where_others_stand_in_a_group(tmp_path: Path) -> None:
    """Each of the group is tried elsewhere, too; who can be reached is served."""
    text = """\
schema_version: 1
name: corner
place: {width_m: 8, height_m: 6, walls_m: [[[6, 0], [6, 2]], [[6, 2], [8, 2]]]}
robot: {at_m: [1, 1]}
people:
  vera: {at_m: [7, 1], facing_deg: 90}
  omar: {at_m: [6, 4.5], facing_deg: 180}
  ann: {at_m: [2.5, 5], facing_deg: 0}
  ben: {at_m: [3.9, 5], facing_deg: 180}
groups: {talk: [ann, ben]}
goals: [{greet: vera}, {greet: omar}]
"""
    prepared = prepare(scenario(tmp_path, text))
    (unmet,) = prepared.unmet
    assert unmet.person == "vera"
    assert [each.name for each in unmet.conditions] == ["wall 1", "wall 2"]
    assert {step.person for step in prepared.plan.steps} == {"omar"}


def test_a_map_beside_the_scenario_is_found(tmp_path: Path) -> None:
    (tmp_path / "flat.map.yaml").write_text(MAP)
    text = "schema_version: 1\nname: flat\nplace: {map: flat.map.yaml}\nrobot: {at_m: [6, 2]}\n"
    file = scenario(tmp_path, f"{text}people:\n  ada: {{at: stove}}\ngoals:\n  - greet: ada\n")
    assert placed(file).scenario.people["ada"].at_m == (1.0, 1.0)


BAD = {
    "an unknown map": (("map: ward", "map: wrd"), 3, "Did you mean 'ward'?"),
    "a map file that is not there": (("map: ward", "map: no.map.yaml"), None, "no such file"),
    "an unknown door": (("{map: ward}", "{map: ward, doors: {romo 1: open}}"), 3, "Did you mean 'room 1'?"),
    "an opening that is closed": (
        ("{map: ward}", "{map: ward, doors: {reception hall: closed}}"),
        3,
        "opening",
    ),
    "a door that is ajar": (("{map: ward}", "{map: ward, doors: {room 1: ajar}}"), 3, "'open' or 'closed'"),
    "an unknown location": (("at: bed 1a", "at: bed 9a"), 6, "expected a location of the map ward"),
    "an unknown room": (("random_in: day room", "random_in: dai room"), 7, "Did you mean 'day room'?"),
    "no place at all": (("{at: bed 1a}", "{facing_deg: 3}"), 6, "either `at_m` or `at`, got neither"),
    "two places": (("{at: bed 1a}", "{at: bed 1a, at_m: [1, 1]}"), 6, "either `at_m` or `at`, got both"),
    "an unknown key beside the map": (("{map: ward}", "{map: ward, width_m: 5}"), 3, "'width_m'"),
    "a person in a wall": (("{at: bed 1a}", "{at_m: [4, 2]}"), 6, "the wall between room 1 and room 2"),
    "two in one location": (("{at: bed 1a}", "{at: entrance}"), 4, "different places"),
    "a map that is a list": (("map: ward", "map: [1, 2]"), 3, "map"),
}


@pytest.mark.parametrize("case", BAD)
def test_what_cannot_be_is_refused_with_its_line(case: str, tmp_path: Path) -> None:
    (old, new), line, text = BAD[case]
    assert old in WARD
    with pytest.raises(InputError) as caught:
        prepare(scenario(tmp_path, WARD.replace(old, new)))
    message = str(caught.value)
    assert text in message, message
    if line:
        assert f"rounds.scenario.yaml:{line}:" in message, message


def test_the_plan_of_a_seed_is_the_one_that_a_run_with_it_carries_out(comity, here) -> None:
    (here / "rounds.scenario.yaml").write_text(WARD.replace("ada: {at: bed 1a}", "ada: {at: random}"))
    costs = [comity("plan", "rounds.scenario.yaml", "--seed", seed, "--json").json["cost"] for seed in (3, 4)]
    assert costs[0] != costs[1]
    comity("run", "rounds.scenario.yaml", "--seed", 4, "--out", "run")
    assert json.loads((here / "run" / "plan.json").read_text())["cost"] == costs[1]


@pytest.mark.parametrize("name", ["ward", "reception"])
def test_a_picture_of_a_map_or_a_scenario_is_the_same_twice(comity, here, name: str) -> None:
    said = comity("draw", name, "--out", "one.png")
    assert said.code == 0, said.err
    assert said.out.split() == ["Picture", "one.png"]
    comity("draw", name, "--out", "two.png")
    assert (here / "one.png").read_bytes()[:4] == b"\x89PNG"
    assert (here / "one.png").read_bytes() == (here / "two.png").read_bytes()


INDIVIDUALISM = str(files("comity_fis").joinpath("data/individualism.csv"))


@pytest.mark.parametrize("name", ["y", "y.", "y.jpg", ".png"])
@pytest.mark.parametrize(
    "command",
    [
        ("draw", "ward", "--out"),
        ("draw", "ward", "--graph", "--out"),
        ("explain", "conversational_distance", "--picture"),
        ("run", "johanna", "--out", "runs/one", "--picture"),
        ("evaluate", "bruno2017", "--picture"),
        ("fit", INDIVIDUALISM, "--column", "individualism", "--out", "fit.yaml", "--picture"),
        ("visits", "german_woman", "--picture"),
        ("profile", "show", "one_life", "--years", "2003..2022", "--picture"),
    ],
)
def test_a_picture_without_the_ending_of_a_picture_is_refused_before_anything_is_written(
    comity, here: Path, command: tuple[str, ...], name: str
) -> None:
    said = comity(*command, name)
    assert (said.code, said.out) == (2, "")
    assert "a picture that ends with .png, .svg or .pdf" in said.err
    assert not list(here.iterdir())


@pytest.mark.parametrize("name", ["one.png", "one.svg", "one.pdf"])
@pytest.mark.parametrize(
    "command",
    [
        ("evaluate", "bruno2017"),
        ("fit", INDIVIDUALISM, "--column", "individualism"),
        ("visits", "german_woman", "--times", "1"),
        ("profile", "show", "one_life", "--years", "2003..2005"),
    ],
)
def test_a_picture_has_the_format_of_its_ending(
    comity, here: Path, command: tuple[str, ...], name: str
) -> None:
    assert comity(*command, "--picture", name).code == 0
    first = (here / name).read_bytes()
    assert first.startswith({"one.png": b"\x89PNG", "one.svg": b"<?xml", "one.pdf": b"%PDF"}[name])
    assert comity(*command, "--picture", name).code == 0, "it replaces its own picture"


def test_a_drawing_replaces_its_own_picture_and_nothing_else(comity, here) -> None:
    (here / "mine.svg").write_text("<svg>my own</svg>")
    assert comity("draw", "office", "--out", "mine.svg").code == 2
    assert (here / "mine.svg").read_text() == "<svg>my own</svg>"
    for _ in range(2):
        assert comity("draw", "office", "--out", "office.svg").code == 0


CROSSING = "rooms: {a: {polygon_m: [[0, 0], [4, 4], [4, 0], [0, 4]]}}"


@pytest.mark.parametrize("command", [["draw"], ["run"]])
def test_a_bad_map_ends_with_2_and_nothing_written(comity, here, command: list[str]) -> None:
    """What else may be bad about a map is told in `tests/sim2d/test_maps.py`."""
    (here / "bad.map.yaml").write_text(f"schema_version: 1\nname: bad\n{CROSSING}\n")
    text = WARD.replace("map: ward", "map: bad.map.yaml")
    (here / "on.scenario.yaml").write_text(text)
    said = comity(*command, "on.scenario.yaml")
    assert said.code == 2
    assert said.err.startswith("comity: bad.map.yaml:"), said.err
    assert said.out == ""
    assert sorted(path.name for path in here.iterdir()) == ["bad.map.yaml", "on.scenario.yaml"]


def test_maps_lists_what_each_map_has(comity) -> None:
    listed = {row["name"]: row for row in comity("maps", "--json").json["maps"]}
    assert set(listed) == {"apartment", "living-room", "office", "reception-hall", "ward"}
    assert listed["ward"]["doors"]["bath"] == "closed"
    assert "bed 1a" in listed["ward"]["locations"]


REFUSED = {
    "a door that is not there": "faults: [{at_s: 2, fault: door closes, door: cellar}]",
    "somebody sent into a wall": "changes: [{at_s: 2, person: ada, moves_to_m: [0, 0]}]",
    "a wish out of range": "changes: [{at_s: 2, person: ada, says: {conversational_distance: 9}}]",
    "a thing that is fetched nowhere": None,
}


@pytest.mark.parametrize("case", REFUSED)
def test_what_no_plan_is_needed_to_refuse_is_refused_by_draw_as_by_run(comity, here: Path, case: str) -> None:
    more = REFUSED[case] or "  - {offer: tea, to: ada, from: cellar}"
    (here / "bad.scenario.yaml").write_text(f"{WARD}{more}\n")
    drawn, ran = (comity(command, "bad.scenario.yaml") for command in ("draw", "run"))
    assert drawn.code == ran.code == 2
    assert drawn.err == ran.err
    assert [path.name for path in here.iterdir()] == ["bad.scenario.yaml"]
