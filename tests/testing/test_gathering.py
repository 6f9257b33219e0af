"""Which tests are meant by paths and ids, however they are named."""

from __future__ import annotations

import shlex
from pathlib import Path

import pytest

from comity.system.library import shipped
from comity.testing.collection.cases import claims_in
from comity.testing.collection.gathering import gathered
from comity.testing.runner.telling import again
from comity_fis import InputError

SEEDS = "matrix: {seeds: [0, 1]}\n"


@pytest.fixture
def here(write, tmp_path, monkeypatch) -> Path:
    """A folder with a scenario of two tests below it."""
    (tmp_path / "five").mkdir()
    write(more=SEEDS, name="five/room.scenario.yaml")
    monkeypatch.chdir(tmp_path)
    return tmp_path


ONE = "five/room.scenario.yaml::two-in-a-room[arab_woman-seed1]"


def test_what_is_named_is_given_to_pytest_as_an_absolute_path_once(here):
    """In whatever ways it is named."""
    assert gathered(["five", f"{here}/five", "five/../five"]) == (str(here / "five"),)
    assert gathered([]) == (str(here),)
    assert gathered([ONE, f"./{ONE}"]) == (str(here / ONE),)


def test_what_ships_is_named_as_the_user_calls_it(here):
    (path,) = gathered(["empty-room"])
    assert path == str(shipped("scenario")["empty-room"])


def test_a_test_that_the_file_does_not_have_is_refused_with_the_closest(here):
    with pytest.raises(InputError, match="Did you mean 'two-in-a-room"):
        gathered([ONE.replace("seed1", "seed7")])


def test_a_folder_that_was_removed_is_told_as_such_and_not_as_an_empty_one(tmp_path, monkeypatch):
    gone = tmp_path / "gone"
    gone.mkdir()
    monkeypatch.chdir(gone)
    gone.rmdir()
    with pytest.raises(FileNotFoundError):
        gathered([])


@pytest.mark.parametrize("name", ["-dash.scenario.yaml", "it's $HOME/z.scenario.yaml", "a b.scenario.yaml"])
def test_the_command_of_a_failure_names_its_test_whatever_the_file_is_called(name, here, write):
    """Also where the test's own name has colons."""
    Path(name).parent.mkdir(exist_ok=True)
    path = write(more=SEEDS, name=name, room=lambda room: room.replace("two-in-a-room", "'a::b'"))
    wanted = claims_in(path)[1]
    words = shlex.split(again(wanted))
    assert words[:2] == ["comity", "test"]
    assert not words[2].startswith("-")
    assert gathered(words[2:]) == (f"{path}::{wanted.id}",)


def test_a_folder_has_no_tests_of_its_own(here):
    with pytest.raises(InputError) as refused:
        gathered(["five::two-in-a-room[arab_woman-seed1]"])
    assert refused.value.got.startswith("a folder: five::")


@pytest.mark.parametrize(
    ("word", "remedy"),
    [
        ("foldr", "Did you mean 'folder'?"),
        ("foldr/one.scenario.yaml", "Did you mean 'folder'?"),
        ("folder/oen.scenario.yaml", "Did you mean 'folder/one.scenario.yaml'?"),
        ("folder/oen.scenario.yaml::room[seed0]", "Did you mean 'folder/one.scenario.yaml'?"),
        ("empty-rom", "Did you mean 'empty-room'?"),
        ("bedside", "It is in a set now: write 'comity-bench-1/bedside'."),
        ("nope/x.scenario.yaml", "Check the path."),
        ("nope.scenario.yaml", "Check the path."),
        ("/nowhere/at/all", "Check the path."),
        ("nope", "`comity scenarios` lists what ships."),
        ("notes.yaml", "Let its name end in `.scenario.yaml`, or name another."),
    ],
)
def test_a_path_that_is_misspelt_is_told_with_what_is_there(word, remedy, write, tmp_path, monkeypatch):
    (tmp_path / "folder").mkdir()
    write(name="folder/one.scenario.yaml")
    (tmp_path / "notes.yaml").write_text("")
    monkeypatch.chdir(tmp_path)
    with pytest.raises(InputError) as refused:
        gathered([word])
    assert refused.value.remedy == remedy
