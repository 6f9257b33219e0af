"""What does not hold, and for whom: every expectation that is broken stands in the account once."""

from __future__ import annotations

from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from comity.testing.collection.cases import claims_in
from comity.testing.reporting.account import answer, summary
from comity.testing.reporting.broken import MOST, OVERVIEW, broken
from comity.testing.runner.result import Result, result_of

FILES = ("hall", "room")
PROFILES = ("arab_man", "german_man", "german_woman")
SENTENCES = tuple((f"hall.scenario.yaml:{line}", f"duration at most {line} s") for line in range(20, 24))


def result(name: str, profile: str, broken: list[tuple[str, str]]) -> Result:
    path = Path(f"{name}.scenario.yaml")
    status = "failed" if broken else "passed"
    return Result(profile, path, status, "", "", None, 0.0, None, profile=profile, broken=tuple(broken))


RESULTS = st.lists(
    st.builds(
        result,
        st.sampled_from(FILES),
        st.sampled_from(PROFILES),
        st.lists(st.sampled_from(SENTENCES), unique=True),
    )
)


@given(RESULTS)
def test_each_broken_expectation_is_told_once_with_all_whom_it_fails(found: list[Result]) -> None:
    told = broken(found)
    keys = [(one.file, one.where) for one in told]
    assert len(keys) == len(set(keys))
    assert sum(one.failed for one in told) == sum(len(result.broken) for result in found)
    for one in told:
        failing = [
            each
            for each in found
            if str(each.path) == one.file and (one.where, one.expectation) in each.broken
        ]
        assert set(one.profiles) == {each.profile for each in failing}
        assert one.failed == len(failing) <= one.tests == sum(str(each.path) == one.file for each in found)


MATRIX = "matrix: {people: [guest], profiles: [arab_man, arab_woman, german_man, german_woman]}\n"


@pytest.fixture
def told(write, tmp_path, capsys, monkeypatch):
    """What `comity test` prints of sentences below their failures."""
    monkeypatch.chdir(tmp_path)

    def of(*sentences: str) -> str:
        found = [result_of(claim) for claim in claims_in(write(*sentences, more=MATRIX))]
        summary(found, answer(found, 0.0, fairness=False))
        out: str = capsys.readouterr().out
        return out.partition("What does not hold, and for whom")[2].partition("How each profile")[0]

    return of


def test_a_change_that_fails_many_tests_is_summed_up_by_expectation(told):
    found = " ".join(
        told("duration at most 1 s", "plan_cost at most 1 m, for german_man and german_woman").split()
    )
    assert "duration at most 1 s all 4 profiles" in found
    assert "plan_cost at most 1 m, for german_man and german_woman german_man, german_woman" in found


def test_very_many_are_counted_by_scenario(told):
    (line,) = [
        line
        for line in told(*(f"duration at most {n} s" for n in range(1, MOST + 2))).splitlines()
        if "room" in line
    ]
    assert line.split() == ["room.scenario.yaml", str(MOST + 1), "all", "4", "profiles"]


def test_few_failures_can_be_read_without_a_summary(told):
    few = "conversational_distance of guest is 64 cm within 1 cm, for german_man and german_woman"
    assert OVERVIEW > 2
    assert told(few) == ""


def test_a_comparison_is_nobodys(write):
    sentence = "same for all: conversational_distance"
    found = [result_of(claim) for claim in claims_in(write(sentence, more=MATRIX))]
    (one,) = broken(found)
    assert (one.expectation, one.profiles, one.failed, one.tests) == (sentence, (), 1, 1)
