"""What was edited since a golden episode was written is named: the key, what it was, what it is, its line."""

from __future__ import annotations

import json
import re
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st
from rooms import ROOM

import comity_fis
from comity.people.store import Store
from comity.testing.collection.cases import claims_in
from comity.testing.golden.edit import MOST
from comity.testing.golden.place import place_of
from comity.testing.runner.result import result_of
from comity.testing.verdict import judged
from comity_fis import InputError

HALL = """\
schema_version: 1
name: hall
about: Where people wait.
rooms:
  hall: {box_m: [0, 0, 8, 6]}
furniture:
  - {name: column 1, circle_m: [6.4, 3.4, 0.3]}
  - {name: column 2, circle_m: [3.4, 3.4, 0.3]}
  - {name: desk, polygon_m: [[0.2, 2.2], [1.0, 2.2], [1.0, 3.0], [0.2, 3.0]]}
"""
MIRA = """\
schema_version: 1
name: mira
about: Who lives here.
culture: DEU
gender: male
settings: {greeting_gesture: nod}
"""
IN_HALL = ROOM.replace("place: {width_m: 8.0, height_m: 6.0}", "about: A visit.\nplace: {map: hall.map.yaml}")
IN_HALL = IN_HALL.replace("arab_woman", "mira.yaml")
NEARER = ("robot: {at_m: [1.0, 1.0]}", "robot: {at_m: [2.0, 1.0]}")


@pytest.fixture
def edited(write, tmp_path):
    """The lines about edits, after these: file, old, new; golden episodes are written before."""
    (tmp_path / "hall.map.yaml").write_text(HALL)
    (tmp_path / "mira.yaml").write_text(MIRA)

    def lines(*edits, room=IN_HALL):
        path = write(room=lambda _: room)
        (claim,) = claims_in(path)
        assert judged(claim, update=True).passed
        for name, old, new in edits:
            text = (tmp_path / name).read_text()
            assert old in text
            (tmp_path / name).write_text(text.replace(old, new))
        (claim,) = claims_in(path)
        (failure,) = judged(claim).failures
        return [line.replace(f"{tmp_path}/", "") for line in failure.finding.because]

    return lines


@pytest.mark.parametrize(
    ("edit", "told"),
    [
        (
            ("room.scenario.yaml", *NEARER),
            "edited    scenario: robot at_m [1.0, 1.0] -> [2.0, 1.0] (room.scenario.yaml:5)",
        ),
        (
            ("room.scenario.yaml", "[6.8, 1.2], facing_deg: 180", "[6.8, 1.2], facing_deg: 90"),
            "edited    scenario: people guest facing_deg 180 -> 90 (room.scenario.yaml:8)",
        ),
        (
            ("hall.map.yaml", "[3.4, 3.4, 0.3]", "[2.0, 3.0, 0.3]"),
            "edited    map hall.map.yaml: furniture column 2 circle_m [3.4, 3.4, 0.3] -> [2.0, 3.0, 0.3] "
            "(hall.map.yaml:8)",
        ),
        (
            ("hall.map.yaml", "[1.0, 2.2], [1.0, 3.0]", "[2.0, 2.2], [1.0, 3.0]"),
            "edited    map hall.map.yaml: furniture desk polygon_m 2 [1.0, 2.2] -> [2.0, 2.2] "
            "(hall.map.yaml:9)",
        ),
        (
            ("mira.yaml", "nod", "bow"),
            "edited    profile of host: settings greeting_gesture nod -> bow (mira.yaml:6)",
        ),
        (
            ("mira.yaml", "gender: male", "gender: female"),
            "edited    profile of host: gender male -> female (mira.yaml:5)",
        ),
        (
            ("mira.yaml", "gender: male\n", ""),
            "edited    profile of host: gender male -> - (mira.yaml)",
        ),
        (
            ("room.scenario.yaml", NEARER[0], "robot: {at_m: [1.0, 1.0], max_speed_m_s: 0.4}"),
            "edited    scenario: robot max_speed_m_s - -> 0.4 (room.scenario.yaml:5)",
        ),
    ],
)
def test_an_edit_is_named_with_its_key_what_it_was_what_it_is_and_its_line(edit, told, edited):
    assert edited(edit)[-1:] == [told]


def test_a_piece_is_new_or_gone_as_a_whole(edited):
    desk = "  - {name: desk, polygon_m: [[0.2, 2.2], [1.0, 2.2], [1.0, 3.0], [0.2, 3.0]]}\n"
    table = "  - {name: table, box_m: [2.0, 2.4, 1.0, 1.0], angle_deg: 10}\n"
    assert edited(("hall.map.yaml", desk, table)) == [
        "edited    map hall.map.yaml: furniture desk is gone (hall.map.yaml:6)",
        "edited    map hall.map.yaml: furniture table is new (hall.map.yaml:9)",
    ]


def test_of_many_edits_the_first_are_named_and_the_others_counted(edited, tmp_path):
    moved = [
        ("room.scenario.yaml", f"at_m: [{x}, {y}]", f"at_m: [{float(x) + 0.1:.1f}, {y}]")
        for x, y in re.findall(r"at_m: \[(.*?), (.*?)\]", IN_HALL)
    ]
    turned = [
        ("room.scenario.yaml", f"facing_deg: {deg}}}", f"facing_deg: {deg + 5}}}") for deg in (-90, 180, 0)
    ]
    found = edited(*moved, *turned)
    assert len(moved) + len(turned) == MOST + 1
    assert [line.startswith("edited    scenario: ") for line in found] == [True] * (MOST + 1)
    assert found[-1] == "edited    scenario: and 1 more"
    numbers = [int(line.rpartition(":")[2][:-1]) for line in found[:-1]]
    assert numbers == sorted(numbers)


def test_prose_is_not_kept_and_an_edit_of_it_is_told_as_such(edited, tmp_path):
    found = edited(
        ("room.scenario.yaml", *NEARER),
        ("mira.yaml", "Who lives here.", "Somebody."),
        ("hall.map.yaml", "Where people wait.", "A hall."),
    )
    assert found == [
        "edited    scenario: robot at_m [1.0, 1.0] -> [2.0, 1.0] (room.scenario.yaml:5)",
        "edited    map hall.map.yaml, in what nothing is computed with",
        "edited    profile of host, in what nothing is computed with",
    ]
    (golden,) = (tmp_path / "room.golden").iterdir()
    for prose in ("Who lives here", "Where people wait", "A visit"):
        assert prose not in golden.read_text()


def test_an_edit_behind_a_divergence_that_only_the_trace_has_is_told_below_its_links(edited, tmp_path):
    seen_late = "robot: {at_m: [1.0, 1.0], sensor: {delay_s: 0.2}}"
    golden, now, reading, *rest = edited(("room.scenario.yaml", NEARER[0], seen_late))
    assert (golden, now) == (f"golden    {START}", f"now       {START}")
    assert reading.endswith("-> host is not seen")
    assert rest[-1] == "edited    scenario: robot sensor delay_s - -> 0.2 (room.scenario.yaml:5)"
    assert not any(link.startswith("edited") for link in rest[:-1])


START = "t=0.00 s docked?(host) failure"
WRITTEN_OUT = "profile: {name: kim, culture: DEU, gender: male, settings: {greeting_gesture: nod}}"


def test_a_profile_that_stands_in_the_scenario_is_told_once(edited):
    room = IN_HALL.replace("profile: mira.yaml", WRITTEN_OUT)
    assert edited(("room.scenario.yaml", "gesture: nod", "gesture: bow"), room=room) == [
        "edited    scenario: people host profile settings greeting_gesture nod -> bow (room.scenario.yaml:7)"
    ]


def test_what_the_store_holds_of_somebody_stays_there(write, tmp_path, monkeypatch):
    """Golden episodes are shared: they name whose profile is another, and not what it says."""
    monkeypatch.setenv("COMITY_HOME", str(tmp_path / "home"))
    person = {"schema_version": 1, "name": "sam", "culture": "DEU", "gender": "male", "education": 7}
    Store().change_profile("sam", lambda _: person)
    path = write(
        room=lambda room: (
            room.replace("sam: {profile: german_man", "sam: {profile: sam") + "rulebook: bruno2017\n"
        )
    )
    (claim,) = claims_in(path)
    assert judged(claim, update=True).passed
    written = json.loads(place_of(claim.case).read_text())["written"]
    assert "profile of host" in written
    assert "profile of sam" not in written
    Store().change_profile("sam", lambda _: {**person, "gender": "female"})
    (claim,) = claims_in(path)
    (failure,) = judged(claim).failures
    (edit,) = [line for line in failure.finding.because if line.startswith("edited")]
    assert edit.startswith("edited    profile of sam: sam of the store, whom people sam profile names in ")
    assert edit.endswith("room.scenario.yaml:8; which of its keys stays there, as golden episodes are shared")


def test_somebody_of_the_store_whom_the_matrix_names_has_the_line_of_the_matrix(write, tmp_path, monkeypatch):
    monkeypatch.setenv("COMITY_HOME", str(tmp_path / "home"))
    person = {"schema_version": 1, "name": "mira", "culture": "DEU", "gender": "male"}
    Store().change_profile("mira", lambda _: person)
    path = write(more="matrix: {people: [guest], profiles: [mira]}\n")
    assert judged(claims_in(path)[0], update=True).passed
    Store().change_profile("mira", lambda _: {**person, "culture": "JPN"})
    (failure,) = judged(claims_in(path)[0]).failures
    told = "\n".join(failure.finding.because)
    assert re.search(
        r"edited    profile of guest: mira of the store, whom matrix profiles names in .*:12;", told
    )


def test_a_profile_that_the_matrix_replaces_is_no_cause(edited):
    room = IN_HALL + "matrix: {people: [host], profiles: [arab_woman]}\n"
    found = edited(
        ("room.scenario.yaml", "profile: mira.yaml", "profile: german_man"),
        ("room.scenario.yaml", *NEARER),
        room=room,
    )
    assert found == ["edited    scenario: robot at_m [1.0, 1.0] -> [2.0, 1.0] (room.scenario.yaml:5)"]


def test_what_differs_besides_is_told_below_the_cause_and_not_as_one(edited, tmp_path):
    edited(("room.scenario.yaml", *NEARER))
    (claim,) = claims_in(tmp_path / "room.scenario.yaml")
    heads = [line[2:11].strip() for line in result_of(claim).text.splitlines() if line.startswith("  ")]
    assert [head for head in heads if head] == ["expected", "got", "because", "also", "again"]


@given(st.data())
def test_each_value_of_a_file_has_a_line_of_its_own_in_a_golden_episode(golden_text, data):
    """So that a version control shows what changed."""
    text = golden_text
    record = json.loads(text)
    name = data.draw(st.sampled_from(sorted(record["written"])))
    place = data.draw(st.sampled_from(sorted(record["written"][name])))
    assert f"\n   {json.dumps(place)}: {json.dumps(record['written'][name][place])}" in text


@pytest.fixture(scope="module")
def golden_text(tmp_path_factory):
    path = tmp_path_factory.mktemp("golden") / "room.scenario.yaml"
    path.write_text(ROOM)
    (claim,) = claims_in(path)
    assert judged(claim, update=True).passed
    return place_of(claim.case).read_text()


def test_what_bears_on_a_parameter_comes_first_and_the_rest_with_what_else_differs(write, tmp_path):
    (tmp_path / "hall.map.yaml").write_text(HALL)
    (tmp_path / "mira.yaml").write_text(MIRA)
    path = write(room=lambda _: IN_HALL)
    (claim,) = claims_in(path)
    assert judged(claim, update=True).passed
    for name, old, new in (
        ("hall.map.yaml", "[3.4, 3.4, 0.3]", "[3.4, 3.5, 0.3]"),
        ("mira.yaml", "greeting_gesture: nod", "greeting_gesture: bow"),
    ):
        text = (tmp_path / name).read_text()
        (tmp_path / name).write_text(text.replace(old, new))
    (claim,) = claims_in(path)
    finding = judged(claim).failures[0].finding
    assert "of host" in finding.got
    assert "mira.yaml" in "".join(finding.because)
    assert "hall.map.yaml" not in "".join(finding.because)
    assert "hall.map.yaml" in "".join(finding.also)


@pytest.mark.parametrize(
    ("name", "old", "new"),
    [
        ("room.scenario.yaml", *NEARER),
        ("room.scenario.yaml", "  - greet: guest", "  - {greet: guest, priority: 2}"),
        ("rules.yaml", "slow: {trapezoid: [0.2, 0.2, 0.3, 0.4]}", "slow: {trapezoid: [0.2, 0.2, 0.25, 0.4]}"),
        (
            "rules.yaml",
            "elderly: {trapezoid: [60, 70, 117, 117]}",
            "elderly: {trapezoid: [50, 70, 117, 117]}",
        ),
    ],
)
def test_what_no_rule_behind_a_parameter_reads_is_not_said_to_be_behind_it(name, old, new, edited, tmp_path):
    """The distance is another one for its rule, whatever else was edited in the same file or another."""
    rules = (Path(comity_fis.__path__[0]) / "rulebooks" / "bruno2017.yaml").read_text()
    (tmp_path / "rules.yaml").write_text(rules)
    rule = "gender is female then conversational_distance is {}"
    because = edited(
        (name, old, new),
        ("rules.yaml", rule.format("close"), rule.format("medium")),
        room=ROOM.replace("place:", "rulebook: rules.yaml\nplace:"),
    )
    assert len(because) == 1
    assert because[0].startswith("edited    rule 1: ")


def test_a_folder_that_nobody_may_look_into_is_refused_by_its_name(write, monkeypatch):
    (claim,) = claims_in(write())
    assert judged(claim, update=True).passed
    lstat = Path.lstat

    def barred(self):
        if self == place_of(claim.case):
            raise PermissionError(13, "Permission denied")
        return lstat(self)

    monkeypatch.setattr(Path, "lstat", barred)
    with pytest.raises(InputError, match=r"room\.golden: expected a folder of golden episodes"):
        judged(claim)
