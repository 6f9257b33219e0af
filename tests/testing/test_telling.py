"""What a failure's text says of its file."""

from __future__ import annotations

import re
from datetime import date
from pathlib import Path

import pytest

from comity.commands.test import test as command_test
from comity.people.consents import give
from comity.people.learnt_file import Stated
from comity.people.remembered import remember_answer
from comity.people.store import Store
from comity.system.library import shipped
from comity.testing.amounts.shaping import HEAD
from comity.testing.collection.cases import Claim, claims_in
from comity.testing.expectation import Finding
from comity.testing.runner.telling import failure_text
from comity.testing.trials.case import DAY
from comity.testing.verdict import Failure, judged
from comity_fis import Where


def lines(claim: Claim) -> list[str]:
    """The text of a failure in the first sentence."""
    where = claim.case.file.where("expect", 0)
    return failure_text(claim, [Failure("duration at most 1 s", where, Finding("1 s", "2 s"))]).splitlines()


def test_what_ships_is_called_by_its_name_with_a_path_that_can_be_opened():
    path = shipped("scenario")["empty-room"]
    told = lines(claims_in(path)[0])
    assert told[0].startswith("empty-room:")
    (file,) = [line for line in told if line.startswith("  file ")]
    assert Path(file.split(maxsplit=1)[1]) == path


def test_a_file_of_ones_own_is_named_in_every_place(write, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    told = lines(claims_in(write("duration at most 1 s"))[0])
    assert told[0] == "room.scenario.yaml:13: duration at most 1 s"
    assert not [line for line in told if line.startswith("  file ")]


def told(claim: Claim, *findings: tuple[int, Finding]) -> str:
    """The text of failures, each in a line of the file, without the command."""
    failures = [Failure("a sentence", Where("room", line), finding) for line, finding in findings]
    return failure_text(claim, failures).rpartition("\n\n")[0]


def test_a_reason_of_several_failures_in_a_row_is_told_once(write):
    """Every one keeps its line, what is expected, and what came."""
    (claim,) = claims_in(write("duration at most 1 s"))
    one, other = Finding("1 s", "2 s", ("it was late",)), Finding("1 m", "3 m", ("it was late",))
    assert told(claim, (7, one), (8, other), (9, Finding("1", "2", ("a wall",))), (10, one)) == (
        "room:7: a sentence\n  expected   1 s\n  got        2 s\n"
        "room:8: a sentence\n  expected   1 m\n  got        3 m\n"
        "  because    for both of these\n             it was late\n\n"
        "room:9: a sentence\n  expected   1\n  got        2\n  because    a wall\n\n"
        "room:10: a sentence\n  expected   1 s\n  got        2 s\n  because    as for room:8"
    )


def test_a_parameter_is_told_once_also_behind_two_figures_of_one_sentence(write):
    (claim,) = claims_in(write("duration at most 1 s"))
    parameter = f"{HEAD}speed of host 0.3 m/s"
    text = told(
        claim,
        (7, Finding("1 s", "2 s", ("a", parameter))),
        (7, Finding("1 m", "2 m", ("b", parameter))),
        (7, Finding("1 cm", "2 cm", (parameter,))),
    )
    assert text.count(parameter) == 1
    assert text.endswith("  expected   1 cm\n  got        2 cm\n  because    as for room:7")


def test_failures_without_a_reason_do_not_take_that_of_others(write):
    (claim,) = claims_in(write("duration at most 1 s"))
    late = Finding("1 m", "3 m", ("it was late",))
    assert told(claim, (7, Finding("1", "2")), (8, late)) == (
        "room:7: a sentence\n  expected   1\n  got        2\n\n"
        "room:8: a sentence\n  expected   1 m\n  got        3 m\n  because    it was late"
    )


def test_reasons_that_were_told_in_two_places_are_told_to_be_in_both(write):
    (claim,) = claims_in(write("duration at most 1 s"))
    speed, side = f"{HEAD}speed of host 0.3 m/s", f"{HEAD}side of host front"
    failures = [("1 s", (speed, "a")), ("1 m", (side, "b")), ("1 cm", (speed, side))]
    text = told(claim, *((7 + n, Finding(wanted, "2", why)) for n, (wanted, why) in enumerate(failures)))
    assert text.endswith("  because    as for room:7 and room:8")


def test_reasons_that_another_sentence_of_the_same_line_told_are_found_by_its_words(write):
    (claim,) = claims_in(write("duration at most 1 s"))
    late, wall = Finding("1 s", "2 s", ("it was late",)), Finding("1", "2", ("a wall",))
    sentences = {"duration at most 1 s": late, "touches at most 0": wall, "docking_time at most 1 s": late}
    failures = [Failure(sentence, Where("room", 7), finding) for sentence, finding in sentences.items()]
    assert "  because    as for `duration at most 1 s`\n" in failure_text(claim, failures)


@pytest.mark.parametrize(
    "sentence", ["{} is halted because 'docked?' at least once", "{} fails because 'a wall' at least once"]
)
def test_that_nothing_happened_to_two_nodes_is_no_common_reason(sentence, write):
    """Each has what it did last, or its name."""
    (claim,) = claims_in(write(*map(sentence.format, ("Navigate_to_user", "say", "nod"))))
    text = failure_text(claim, judged(claim).failures)
    assert not re.search("as for|for both|for all", text)
    for node in ("Navigate_to_user", "say", "nod"):
        assert re.search(rf"because +.*{node}", text)


def test_what_the_robot_does_at_the_same_time_stands_in_one_line(judge):
    """With how far it went, where it went at all."""
    (verdict,) = judge("duration at most 1 s")
    did = [line for line in verdict.failures[0].finding.because if line.startswith("did ")]
    begun = [line.rpartition("from t=")[2] for line in did]
    assert len(set(begun)) == len(begun)
    assert any("nod(host) for 1.50 s, " in line and "Keep_distance(host) for" in line for line in did)
    assert not any("and 0.00 m" in line for line in did)
    assert all(" m, from" in line for line in did if "Navigate_to_user" in line)


def day_told(path: Path) -> list[str]:
    """What the failure of a file's last test says of the day."""
    return [line.split(maxsplit=1)[1] for line in lines(claims_in(path)[-1]) if line.startswith("  day ")]


SAM = "sam: {profile: german_man"
NO_AT = [f"{DAY}, as `comity test` takes it where the scenario has no `at`"]


@pytest.mark.parametrize(
    ("profile", "expected"),
    [
        ("{name: born, birth_date: 1946-03-09}", NO_AT),
        ("{name: born, birth_year: 1946}", NO_AT),
        ("{name: taught, education: [{from: 2004, value: 3}]}", NO_AT),
        ("{name: moved, culture: [{name: SWE, from: 2004}]}", NO_AT),
        ("{name: aged, age: 79, culture: {SWE: 1}, education: 3}", []),
    ],
)
def test_the_day_is_told_where_a_fact_of_anybody_depends_on_it(profile, expected, write):
    """Also of somebody who only stands by."""
    own = profile.replace("{", "{schema_version: 1, ", 1)
    path = write("duration at most 1 s", room=lambda room: room.replace(SAM, SAM.replace("german_man", own)))
    assert day_told(path) == expected


def test_a_day_that_the_scenario_names_is_told_as_its_own(write):
    dated = "at: 2019-05-01\nplace:"
    path = write("duration at most 1 s", room=lambda room: room.replace("place:", dated))
    assert day_told(path) == []
    path.write_text(path.read_text().replace("arab_woman", "one_life"))
    assert day_told(path) == ["2019-05-01, the scenario's `at`"]


def test_a_comparison_tells_the_day_where_one_of_its_profiles_has_dated_facts(write):
    for profiles, expected in (("arab_woman, german_man", []), ("arab_woman, one_life", NO_AT)):
        assert (
            day_told(write("same for all: safety", more=f"matrix: {{profiles: [{profiles}]}}\n")) == expected
        )


def test_what_was_learnt_drifts_from_day_to_day(write, tmp_path, monkeypatch):
    """But not what the scenario says that was learnt: it holds as it stands there."""
    monkeypatch.setenv("COMITY_HOME", str(tmp_path / "home"))
    give("sam", ["remember", "learn"], by="a_test")
    Store().change_profile("sam", lambda _: {"schema_version": 1, "name": "sam", "culture": "DEU"})
    path = write("duration at most 1 s", room=lambda room: room.replace(SAM, "sam: {profile: sam"))
    assert day_told(path) == []
    said = Stated(day=date(2025, 12, 1), situation={"posture": "standing"}, model_m=0.9, likes_m=0.6)
    assert remember_answer("sam", said)
    assert day_told(path) == NO_AT
    learnt = "learnt: {conversational_distance: {offset: 0.2, spread: 0.1, text: learnt}}"
    path.write_text(path.read_text().replace("profile: sam", f"profile: sam, {learnt}"))
    assert day_told(path) == []


def test_the_day_is_said_wherever_somebody_looks_for_it():
    docs = Path(__file__).parents[2] / "docs"
    pages = ("reference.md", "how-to/describe-a-person.md", "how-to/test-for-different-people.md")
    said = {page: (docs / page).read_text(encoding="utf-8") for page in pages}
    said["help"] = command_test.__doc__ or ""
    assert {name for name, text in said.items() if str(DAY) in text} == {*pages, "help"}
