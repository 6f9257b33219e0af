"""The picture of a failed test: one place for each case, and a reason where there is none."""

from __future__ import annotations

from pathlib import Path

import pytest

from comity.testing import evidence
from comity.testing.cases import claims_in
from comity.testing.evidence import kept, place_of
from comity.testing.result import result_of


@pytest.fixture
def failing(write, tmp_path, monkeypatch):
    """A test that fails, seen from its folder."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(evidence, "_kept", [])
    return claims_in(write("finishes within 1 s"))[0]


def test_scenarios_of_the_same_name_in_two_folders_have_a_picture_each(write, tmp_path, monkeypatch):
    for name in ("a", "b"):
        (tmp_path / name).mkdir()
    files = ("a/room.scenario.yaml", "b/room.scenario.yaml", "a/other.scenario.yaml", "room.scenario.yaml")
    cases = [claims_in(write(name=name))[0].case for name in files]
    for here in (tmp_path, tmp_path / "a"):
        monkeypatch.chdir(here)
        places = [place_of(case) for case in cases]
        assert len(set(places)) == len(cases)
        assert not any(place.is_absolute() or ".." in place.parts for place in places)


def test_a_case_has_its_picture_in_one_place_however_its_file_is_named(write, tmp_path, monkeypatch):
    for name in ("a", "b"):
        (tmp_path / name).mkdir()
    path = write(name="b/room.scenario.yaml")
    monkeypatch.chdir(tmp_path / "a")
    named = (path, Path("../b/room.scenario.yaml"), tmp_path / "a" / ".." / "b" / "room.scenario.yaml")
    assert len({place_of(claims_in(each)[0].case) for each in named}) == 1


@pytest.mark.parametrize("failed", ["ff", "ff/deeper", "ff/deeper/still"])
def test_a_file_in_the_place_of_the_folder_is_a_reason_and_no_loop(failed, failing, tmp_path):
    (tmp_path / "ff").write_text("a file")
    result = result_of(failing, failed=tmp_path / failed)
    assert (result.status, result.picture) == ("failed", None)
    assert "  picture    none: " in result.text
    assert "directory" in result.text or "is a file" in result.text


def test_a_folder_in_the_place_of_the_picture_is_a_reason(failing, tmp_path):
    (tmp_path / "runs" / place_of(failing.case) / "picture.png").mkdir(parents=True)
    told = kept(failing, tmp_path / "runs")
    assert told.picture is None
    assert "picture.png" in told.missing or "other things" in told.missing


def test_who_breaks_everything_is_told_that_not_all_are_drawn(failing, tmp_path, monkeypatch):
    monkeypatch.setattr(evidence, "MOST", 1)
    first, second = kept(failing, tmp_path / "runs"), kept(failing, tmp_path / "runs")
    assert first.picture
    assert first.picture.is_file()
    assert str(second) == "none: 1 are drawn at most by one process; run this one alone"
