"""The oracle: random episodes of changed software against those of the original."""

from __future__ import annotations

import json
import shutil
from multiprocessing import get_context
from pathlib import Path

import pytest
import yaml

from tests.mutants import telling_apart
from tests.mutants.bench import PACKAGES, ROOT
from tests.mutants.mutation import Mutation
from tests.mutants.outcome import Outcome, table
from tests.mutants.random_scenarios import random_scenario
from tests.mutants.telling_apart import Apart, measure, read, tell_apart

NUMBERS = range(6, 8)
PLANS = "domain/comity_domain/choices/side.py"


@pytest.mark.parametrize("number", range(5))
def test_a_number_gives_the_same_scenario_each_time(number):
    assert random_scenario(number) == random_scenario(number)
    assert random_scenario(number) != random_scenario(number + 1)


def test_random_scenarios_expect_nothing_and_name_none_that_ships():
    texts = [random_scenario(number) for number in range(50)]
    assert not any("expect" in yaml.safe_load(text) for text in texts)
    wanted = (
        "by_s",
        "priority",
        "skip",
        "groups",
        "offer",
        "take_leave",
        "changes",
        "faults",
        "differential",
    )
    assert [word for word in wanted if not any(word in text for text in texts)] == []


@pytest.fixture(name="folder", scope="module")
def measured_folder(tmp_path_factory) -> Path:
    """The software as it is, a changed copy, and what random episodes of the original came to."""
    folder = tmp_path_factory.mktemp("apart")
    for name in PACKAGES:
        shutil.copytree(ROOT / name, folder / "original" / name)
    (folder / "known").mkdir()
    shutil.copytree(folder / "original", folder / "changed")
    text = (folder / "changed" / PLANS).read_text(encoding="utf-8")
    assert '"left"' in text
    changed = text.replace('"left"', '"LEFT"').replace('"right"', '"left"').replace('"LEFT"', '"right"')
    (folder / "changed" / PLANS).write_text(changed, encoding="utf-8")
    _in_a_process(measure, folder / "original", folder / "known", NUMBERS)
    return folder


def _in_a_process(*task: object) -> None:
    process = get_context("spawn").Process(target=task[0], args=task[1:])
    process.start()
    process.join()
    assert process.exitcode == 0


def _asked(folder: Path, name: str, line: int | None) -> Apart:
    scratch = folder / f"scratch-{name}-{line}"
    scratch.mkdir()
    _in_a_process(tell_apart, folder / name, scratch, folder / "known", PLANS, line)
    return Apart(**json.loads((scratch / telling_apart.ANSWER).read_text(encoding="utf-8")))


def test_the_same_software_cannot_be_told_apart(folder):
    assert [known.number for known in read(folder / "known")] == [*NUMBERS]
    assert _asked(folder, "original", None) == Apart(None, "", 2)


def test_sides_that_are_exchanged_are_told_apart(folder):
    answer = _asked(folder, "changed", None)
    assert answer.by in NUMBERS
    assert answer.what


def test_only_episodes_that_execute_the_line_are_tried(folder):
    assert _asked(folder, "changed", 100_000) == Apart(None, "", 0)


@pytest.mark.parametrize(("one", "other"), [(0.1 + 0.2, 0.3), (-1e-17, 0.0), (1e16, 1e16), ("a", "a")])
def test_rounding_tells_nothing_apart(one, other):
    assert telling_apart._digest({"cost": (one,)}) == telling_apart._digest({"cost": (other,)})


@pytest.mark.parametrize(("one", "other"), [(0.3, 0.300001), (1e-8, 2e-8), (-0.5, 0.5), ("a", "b"), (1, 2)])
def test_what_is_more_than_rounding_does(one, other):
    assert telling_apart._digest({"cost": (one,)}) != telling_apart._digest({"cost": (other,)})


def test_what_cannot_be_told_apart_is_counted_apart_from_what_was_missed():
    change = Mutation("domain", "domain/near.py", 1, "sign", 0, 1, "+", "-", ())
    outcomes = [
        Outcome(change, "a-test", "", 1, ()),
        Outcome(change, None, "", 1, (), Apart(None, "", 90)),
        Outcome(change, None, "", 1, ("hall[ann]",), Apart(7, "plan", 3)),
        Outcome(change, None, "", 1, (), Apart(None, "", 0)),
    ]
    text = table(outcomes, 0, {}, 3, {})
    assert "1 of those that survived cannot be told from the original" in text
    assert "of the 3 others 33% are caught" in text
    assert "2 are noticed (50%; 67% of the others)" in text
    assert "| domain | - | 4 | 1 | 0 | 2 | 2 | 1 |" in text
    assert "not one of 90 random ones" in text
    assert "random episode 7 does (plan)" in text
    assert "no random episode comes to it" in text
