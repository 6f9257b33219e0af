"""What a failure's text says of its file."""

from __future__ import annotations

from pathlib import Path

from comity.library import shipped
from comity.testing.cases import Claim, claims_in
from comity.testing.expectation import Finding
from comity.testing.telling import failure_text
from comity.testing.verdict import Failure


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
