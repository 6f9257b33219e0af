"""Every scenario holds: for one of its profiles here, and for all of them in the studies."""

from __future__ import annotations

import pytest

from comity.episode import fingerprint
from comity.system.scenario_sets import taught_scenarios
from comity.testing.collection.cases import claims_in
from comity.testing.runner.telling import failure_text
from comity.testing.trials.attempt import attempted
from comity.testing.verdict import judged
from tests.scenarios import golden
from tests.scenarios.every import SCENARIOS, sample_of

FINGERPRINT, GOLDEN = golden.read()


@pytest.mark.parametrize("name", SCENARIOS)
def test_a_scenario_holds_for_one_of_its_profiles_and_moves_as_it_did(name):
    claim = sample_of(name)
    _hold(claim)
    values = dict(GOLDEN[name])
    assert values.pop("case") == claim.id, "another case is sampled: run `make golden`"
    if fingerprint() == FINGERPRINT:
        assert not golden.moved(values, golden.values_of(attempted(claim.case)))


@pytest.mark.study
@pytest.mark.parametrize("name", SCENARIOS)
def test_a_scenario_holds_for_all_of_its_profiles(name):
    for claim in claims_in(SCENARIOS[name]):
        _hold(claim)


def _hold(claim):
    verdict = judged(claim)
    assert verdict.passed, failure_text(claim, verdict.failures)


def test_golden_numbers_are_of_the_scenarios_that_there_are():
    assert set(GOLDEN) == set(SCENARIOS)


def test_a_number_that_is_off_by_more_than_it_may_is_told_and_no_other():
    golden_values = {"path_length_m": 3.99, "duration_s": 11.9, "min_clearance_m": 0.64}
    now = {"path_length_m": 4.04, "duration_s": 12.15, "stalled_s": 0.0}
    assert golden.moved(golden_values, now) == {
        "duration_s": (11.9, 12.15),
        "stalled_s": (None, 0.0),
        "min_clearance_m": (0.64, None),
    }


@pytest.mark.parametrize("name", taught_scenarios())
def test_a_scenario_to_learn_from_is_short_and_says_what_it_shows(name):
    path = SCENARIOS[name]
    text = path.read_text(encoding="utf-8")
    scenario = claims_in(path)[0].case.file.scenario
    assert 2 <= len(scenario.expect) <= 6
    assert 20 <= len(scenario.about) <= 160
    assert text.count("\n") <= 45


def test_scenarios_have_names_of_their_own_in_all_sets():
    names = [name.rpartition("/")[2] for name in SCENARIOS]
    assert len(set(names)) == len(names)
    assert 25 <= len(taught_scenarios()) <= 40
    for name, path in SCENARIOS.items():
        assert claims_in(path)[0].case.file.scenario.name == name.rpartition("/")[2]
