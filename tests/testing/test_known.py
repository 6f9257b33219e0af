"""What passed before is known by all that it depends on, and by nothing less."""

from __future__ import annotations

import pickle
import shutil
from pathlib import Path

import pytest

import comity_fis
from comity.testing.collection.cases import claims_in
from comity.testing.golden.file import place_of
from comity.testing.judging.verdict import judged
from comity.testing.runner import result
from comity.testing.runner.known import Known, key_of
from comity.testing.runner.result import known_or_result, result_of
from comity.testing.runner.running import results


def key(path):
    return key_of(claims_in(path)[0])


def test_the_same_test_has_the_same_key(write):
    path = write("duration at most 60 s")
    assert key(path) == key(path)


@pytest.mark.parametrize(
    ("was", "becomes"),
    [
        ("at_m: [1.0, 1.0]", "at_m: [1.0, 1.1]"),
        ("profile: arab_woman", "profile: arab_man"),
        ("duration at most 60 s", "duration at most 61 s"),
        ("facing_deg: 180", "facing_deg: 170"),
    ],
)
def test_whatever_matters_changes_the_key(was, becomes, write):
    path = write("duration at most 60 s")
    before = key(path)
    path.write_text(path.read_text().replace(was, becomes))
    assert key(path) != before


def test_a_rule_changes_the_key_only_of_those_whose_values_it_moves(write, tmp_path):
    """The rule about Japan moves nobody here; the one about women of low individualism does."""
    text = (Path(comity_fis.__path__[0]) / "rulebooks" / "bruno2017.yaml").read_text()
    (tmp_path / "rules.yaml").write_text(text)
    path = write(room=lambda room: "rulebook: rules.yaml\n" + room)
    before = key(path)
    (tmp_path / "rules.yaml").write_text(
        text.replace(
            "culture is JPN then greeting_gesture is bow", "culture is JPN then greeting_gesture is nod"
        )
    )
    assert key(path) == before
    (tmp_path / "rules.yaml").write_text(
        text.replace(
            "gender is female then conversational_distance is close",
            "gender is female then conversational_distance is far",
        )
    )
    assert key(path) != before


MAP = """\
schema_version: 1
name: flat
rooms:
  hall: {box_m: [0, 0, 8, 6]}
  store: {box_m: [8, 0, 2, 6]}
doors:
  store: {at_m: [8, 5.4], width_m: 0.8}
"""
GUEST = "schema_version: 1\nname: guest\nculture: DEU\ngender: male\n"


@pytest.mark.parametrize(
    ("name", "text", "scenario", "edit"),
    [
        (
            "flat.map.yaml",
            MAP,
            ("place: {width_m: 8.0, height_m: 6.0}", "place: {map: flat.map.yaml}"),
            ("5.4", "5.3"),
        ),
        (
            "g.profile.yaml",
            GUEST,
            ("profile: german_man, at_m: [6.8", "profile: g.profile.yaml, at_m: [6.8"),
            ("male", "female"),
        ),
    ],
)
def test_what_a_scenario_names_counts_with_its_content(name, text, scenario, edit, write):
    path = write("duration at most 60 s", room=lambda room: room.replace(*scenario))
    path.with_name(name).write_text(text)
    before = key(path)
    path.with_name(name).write_text(text.replace(*edit))
    assert key(path) != before


def test_a_map_whose_door_moved_is_tried_again(write, tmp_path):
    (tmp_path / "flat.map.yaml").write_text(MAP)
    known = Known(tmp_path / "known")
    path = write(room=lambda room: room.replace("width_m: 8.0, height_m: 6.0", "map: flat.map.yaml"))
    assert known_or_result(claims_in(path)[0], known).status == "passed"
    (tmp_path / "flat.map.yaml").write_text(MAP.replace("[0, 0, 8, 6]", "[3, 0, 5, 6]"))
    assert known_or_result(claims_in(path)[0], known).status == "refused"


def test_a_rule_changes_the_key_of_those_whose_values_it_moves_on_the_way(write, tmp_path):
    """Nobody here is Japanese; but whoever sits down is approached by other rules."""
    text = (Path(comity_fis.__path__[0]) / "rulebooks" / "bruno2017.yaml").read_text()
    (tmp_path / "rules.yaml").write_text(text)
    more = "changes: [{at_s: 3, person: guest, situation: {posture: seated}}]\n"
    path = write(room=lambda room: "rulebook: rules.yaml\n" + room, more=more)
    before = key(path)
    japanese = "culture is JPN then greeting_gesture is "
    (tmp_path / "rules.yaml").write_text(text.replace(f"{japanese}bow", f"{japanese}nod"))
    assert key(path) == before
    seated = "posture is seated then approach_direction is front"
    (tmp_path / "rules.yaml").write_text(text.replace(f"{seated}_side", seated))
    assert key(path) != before


def test_tests_cross_to_another_process_as_they_are(write):
    """A comparison is still about the very cases that are tested before it."""
    more = "matrix: {people: [guest], profiles: [arab_woman, german_man], seeds: [0, 1]}\n"
    path = write("duration at most 60 s", "same for all: safety", more=more)
    claims = claims_in(path)
    there = pickle.loads(pickle.dumps(claims))
    assert [claim.id for claim in there] == [claim.id for claim in claims]
    assert [key_of(claim) for claim in there] == [key_of(claim) for claim in claims]
    assert {*there[-1].case.cases} <= {claim.case for claim in there}


def test_a_comparison_hangs_on_profiles_outside_the_matrix(write, tmp_path):
    (tmp_path / "g.profile.yaml").write_text(GUEST)
    sentence = "'differs between arab_woman and g.profile.yaml: conversational_distance'"
    path = write(sentence, more="matrix: {people: [host], profiles: [arab_woman, german_man]}\n")
    before = key_of(claims_in(path)[-1])
    (tmp_path / "g.profile.yaml").write_text(GUEST.replace("male", "female"))
    assert key_of(claims_in(path)[-1]) != before


@pytest.mark.parametrize(
    "content", ["", "{}", "null", "[]", "5", '"x"', "[" * 200_000, "\xff", "cut", "altered"]
)
def test_whatever_is_not_as_it_was_written_is_not_known(content, write, tmp_path):
    known = Known(tmp_path / "known")
    (claim,) = claims_in(write("duration at most 60 s"))
    assert known_or_result(claim, known).status == "passed"
    kept = tmp_path / "known" / key_of(claim)
    whole = kept.read_bytes()
    spoilt = {"cut": whole[:-9], "altered": whole.replace(b"success", b"partial")}
    kept.write_bytes(spoilt.get(content, content.encode("latin-1")))
    assert known.recall(key_of(claim)) is None
    assert known_or_result(claim, known).status == "passed"
    assert kept.read_bytes() == whole


def test_a_pipe_in_the_place_of_what_is_known_is_not_waited_for(write, tmp_path, piped):
    known = Known(tmp_path / "known")
    (claim,) = claims_in(write("duration at most 60 s"))
    assert known_or_result(claim, known).status == "passed"
    piped(tmp_path / "known" / key_of(claim))
    assert known.recall(key_of(claim)) is None


def test_a_folder_in_the_place_of_what_is_known_leaves_nothing_behind(write, tmp_path):
    known = Known(tmp_path / "known")
    (claim,) = claims_in(write("duration at most 60 s"))
    folder = tmp_path / "known" / key_of(claim)
    folder.mkdir(parents=True)
    assert known_or_result(claim, known).status == "passed"
    assert list(known.folder.iterdir()) == [folder]


def test_a_pipe_in_the_place_of_a_golden_episode_is_not_waited_for(write, piped):
    path = write("duration at most 60 s")
    (claim,) = claims_in(path)
    assert result_of(claim, update=True).status == "passed"
    before = key(path)
    piped(place_of(claim.case))
    assert key(path) != before


def test_what_passes_afresh_is_known_too(write, tmp_path, monkeypatch):
    monkeypatch.setenv("COMITY_CACHE", str(tmp_path / "cache"))
    claims = claims_in(write("duration at most 60 s"))
    assert [one.status for one in results(claims, jobs=1, update=True)] == ["passed"]
    assert Known.of_this_machine().recall(key_of(claims[0]))


def test_only_what_passed_is_known(write, tmp_path):
    known = Known(tmp_path / "known")
    (passing,) = claims_in(write("duration at most 60 s"))
    first = known_or_result(passing, known)
    again = known_or_result(passing, known)
    assert (first.status, again.status) == ("passed", "passed")
    assert first.measured == again.measured
    (failing,) = claims_in(write("duration at most 1 s"))
    assert known_or_result(failing, known).status == "failed"
    assert len(list((tmp_path / "known").iterdir())) == 1


@pytest.mark.parametrize("within_s", [60, 1])
def test_a_file_that_goes_while_its_test_runs_is_told_of_that_test_alone(
    write, tmp_path, monkeypatch, within_s
):
    """It was there for the run, and is not when the rules behind it are cited or its content is noted."""
    rules = tmp_path / "own.yaml"
    shutil.copy(Path(comity_fis.__path__[0]) / "rulebooks" / "bruno2017.yaml", rules)
    (claim,) = claims_in(write(f"duration at most {within_s} s", more=f"rulebook: {rules}\n"))

    def judged_then_gone(*args, **others):
        verdict = judged(*args, **others)
        rules.unlink()
        return verdict

    monkeypatch.setattr(result, "judged", judged_then_gone)
    found = result.known_or_result(claim, Known(tmp_path / "known"))
    assert found.status == ("passed" if within_s == 60 else "refused")
    assert "own.yaml" in found.text or found.status == "passed"
