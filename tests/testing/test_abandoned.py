"""Which folders hold golden episodes of a scenario that is not there, and which are no concern of ours."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from comity.testing.collection.cases import claims_in
from comity.testing.golden.file import store
from comity.testing.golden.place import abandoned
from comity.testing.trials.attempt import attempted


@pytest.fixture
def golden(write) -> Path:
    """A folder of golden episodes whose scenario was removed."""
    path = write("duration at most 60 s")
    case = claims_in(path)[0].case
    folder = store(case, attempted(case)).parent
    path.unlink()
    return folder


def test_golden_episodes_without_a_scenario_are_abandoned(golden):
    assert list(abandoned([golden])) == [golden]


@pytest.mark.parametrize(
    "scenario", ["not: a scenario", None], ids=["one that cannot be used", "a link to nowhere"]
)
def test_a_scenario_that_cannot_be_used_is_there_all_the_same(golden, scenario):
    path = golden.with_name("room.scenario.yaml")
    path.write_text(scenario) if scenario else path.symlink_to("nowhere")
    assert list(abandoned([golden])) == []


def test_what_others_keep_in_such_a_folder_is_left_alone(tmp_path):
    folder = tmp_path / "theirs.golden"
    folder.mkdir()
    (folder / "answer.json").write_text('{"format": "another-1"}')
    (folder / "binary.json").write_bytes(bytes(range(256)))
    (folder / "nowhere.json").symlink_to("missing")
    os.mkfifo(folder / "pipe.json")
    assert list(abandoned([folder])) == []
