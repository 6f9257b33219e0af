"""The picture of a failed test: one place for each case, and a reason where there is none."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from comity.testing.collection.cases import Claim, claims_in
from comity.testing.runner import evidence
from comity.testing.runner.evidence import kept, place_of
from comity.testing.runner.result import result_of


@pytest.fixture
def failing(write, tmp_path, monkeypatch):
    """A test that fails, seen from its folder."""
    monkeypatch.chdir(tmp_path)
    return claims_in(write("duration at most 1 s"))[0]


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


@pytest.fixture
def mended(failing, write) -> Callable[[], Claim]:
    """The same test, after what is expected was put right."""
    return lambda: claims_in(write("duration at most 100 s"))[0]


def test_what_was_kept_of_a_failure_goes_once_the_case_passes(failing, mended, tmp_path):
    failed = tmp_path / "runs" / "failed"
    assert result_of(failing, failed=failed).picture
    assert result_of(mended(), failed=failed).status == "passed"
    assert list((tmp_path / "runs").rglob("*")) == [failed]


@pytest.mark.parametrize("mine", ["notes.txt", "../notes.txt", "deeper/notes.txt"])
def test_what_somebody_put_beside_it_stays(mine, failing, mended, tmp_path):
    folder = tmp_path / "failed" / place_of(failing.case)
    result_of(failing, failed=tmp_path / "failed")
    (folder / mine).parent.mkdir(exist_ok=True)
    (folder / mine).write_text("mine")
    result_of(mended(), failed=tmp_path / "failed")
    assert [path.name for path in (tmp_path / "failed").rglob("*") if path.is_file()] == ["notes.txt"]


def test_a_folder_that_is_no_run_stays_as_it_is(failing, mended, tmp_path):
    folder = tmp_path / "failed" / place_of(failing.case)
    folder.mkdir(parents=True)
    (folder / "run.json").write_text("{}")
    (folder / "picture.png").write_bytes(b"mine")
    assert result_of(mended(), failed=tmp_path / "failed").status == "passed"
    assert sorted(path.name for path in folder.iterdir()) == ["picture.png", "run.json"]


def test_a_run_to_which_somebody_linked_stays(failing, mended, tmp_path):
    failed, folder = tmp_path / "failed", place_of(failing.case)
    result_of(failing, failed=failed)
    (failed / folder).rename(tmp_path / "precious")
    (failed / folder).symlink_to(tmp_path / "precious")
    result_of(mended(), failed=failed)
    assert (tmp_path / "precious" / "picture.png").is_file()


def test_who_goes_on_failing_keeps_it(failing, tmp_path):
    for _ in range(2):
        picture = result_of(failing, failed=tmp_path / "failed").picture
        assert picture
        assert picture.is_file()
