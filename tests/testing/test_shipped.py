"""The shipped library: the project's own acceptance tests, and the examples that users start from."""

from __future__ import annotations

from pathlib import Path

import pytest

from comity.system.library import shipped
from comity.testing.collection.cases import claims_in
from comity.testing.judging.verdict import judged
from comity.testing.runner.telling import failure_text
from comity.testing.trials.case import Across

SCENARIOS = shipped("scenario")
SLOW = ("reception", "busy-reception", "ward-round")
"""Many people and long ways: seconds each."""


def test_there_are_at_least_thirty_and_each_expects_something():
    assert len(SCENARIOS) >= 30
    for name, path in SCENARIOS.items():
        claims = claims_in(path)
        assert claims[0].expectations, name
        profiles = {claim.case.profile_name for claim in claims if not isinstance(claim.case, Across)}
        assert len(profiles) >= 4 or not claims[0].case.file.scenario.matrix.profiles, name


@pytest.mark.parametrize("name", [name for name in SCENARIOS if name not in SLOW])
def test_a_shipped_scenario_holds_for_one_of_its_profiles(name):
    """Another one for each scenario; `comity test --shipped` tries all."""
    claims = [claim for claim in claims_in(SCENARIOS[name]) if not isinstance(claim.case, Across)]
    _hold(claims[list(SCENARIOS).index(name) % len(claims)])


@pytest.mark.study
@pytest.mark.parametrize("name", SCENARIOS)
def test_a_shipped_scenario_holds_for_all_of_its_profiles(name):
    for claim in claims_in(SCENARIOS[name]):
        _hold(claim)


def _hold(claim):
    verdict = judged(claim)
    assert verdict.passed, failure_text(claim, verdict.failures)


def test_the_node_ids_of_shipped_scenarios_are_short():
    (claim, *_) = claims_in(Path(SCENARIOS["johanna"]))
    assert claim.expectations[0].where.file == "johanna"
