"""What a failure's text says of its file."""

from __future__ import annotations

from pathlib import Path

from comity.library import shipped
from comity.testing.cases import Claim, claims_in
from comity.testing.expectation import Finding
from comity.testing.shaping import HEAD
from comity.testing.telling import failure_text
from comity.testing.verdict import Failure
from comity_fis import Where


def lines(claim: Claim) -> list[str]:
    """The text of a failure in the first sentence."""
    where = claim.case.file.where("expect", 0)
    return failure_text(claim, [Failure("finishes within 1 s", where, Finding("1 s", "2 s"))]).splitlines()


def test_what_ships_is_called_by_its_name_with_a_path_that_can_be_opened():
    path = shipped("scenario")["empty-room"]
    told = lines(claims_in(path)[0])
    assert told[0].startswith("empty-room:")
    (file,) = [line for line in told if line.startswith("  file ")]
    assert Path(file.split(maxsplit=1)[1]) == path


def test_a_file_of_ones_own_is_named_in_every_place(write, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    told = lines(claims_in(write("finishes within 1 s"))[0])
    assert told[0] == "room.scenario.yaml:13: finishes within 1 s"
    assert not [line for line in told if line.startswith("  file ")]


def told(claim: Claim, *findings: tuple[int, Finding]) -> str:
    """The text of failures, each in a line of the file, without the command."""
    failures = [Failure("a sentence", Where("room", line), finding) for line, finding in findings]
    return failure_text(claim, failures).rpartition("\n\n")[0]


def test_a_reason_of_several_failures_in_a_row_is_told_once(write):
    """Every one keeps its line, what is expected, and what came."""
    (claim,) = claims_in(write("finishes within 1 s"))
    one, other = Finding("1 s", "2 s", ("it was late",)), Finding("1 m", "3 m", ("it was late",))
    assert told(claim, (7, one), (8, other), (9, Finding("1", "2", ("a wall",))), (10, one)) == (
        "room:7: a sentence\n  expected   1 s\n  got        2 s\n"
        "room:8: a sentence\n  expected   1 m\n  got        3 m\n"
        "  because    for both of these\n             it was late\n\n"
        "room:9: a sentence\n  expected   1\n  got        2\n  because    a wall\n\n"
        "room:10: a sentence\n  expected   1 s\n  got        2 s\n  because    as of room:8"
    )


def test_a_parameter_is_told_once_also_behind_two_figures_of_one_sentence(write):
    (claim,) = claims_in(write("finishes within 1 s"))
    parameter = f"{HEAD}speed of host 0.3 m/s"
    text = told(
        claim,
        (7, Finding("1 s", "2 s", ("a", parameter))),
        (7, Finding("1 m", "2 m", ("b", parameter))),
        (7, Finding("1 cm", "2 cm", (parameter,))),
    )
    assert text.count(parameter) == 1
    assert text.endswith("  expected   1 cm\n  got        2 cm\n  because    as of room:7")


def test_failures_without_a_reason_do_not_take_that_of_others(write):
    (claim,) = claims_in(write("finishes within 1 s"))
    late = Finding("1 m", "3 m", ("it was late",))
    assert told(claim, (7, Finding("1", "2")), (8, late)) == (
        "room:7: a sentence\n  expected   1\n  got        2\n\n"
        "room:8: a sentence\n  expected   1 m\n  got        3 m\n  because    it was late"
    )


def test_what_the_robot_does_at_the_same_time_stands_in_one_line(judge):
    """With how far it went, where it went at all."""
    (verdict,) = judge("duration at most 1 s")
    did = [line for line in verdict.failures[0].finding.because if line.startswith("did ")]
    begun = [line.rpartition("from t=")[2] for line in did]
    assert len(set(begun)) == len(begun)
    assert any("nod(host) for 1.50 s, " in line and "Keep_distance(host) for" in line for line in did)
    assert not any("and 0.00 m" in line for line in did)
    assert all(" m, from" in line for line in did if "Navigate_to_user" in line)
