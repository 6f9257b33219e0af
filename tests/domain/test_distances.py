"""Where the target distance does not fit, the robot may come nearer than any rule wants."""

from __future__ import annotations

from dataclasses import replace

import pytest
from hypothesis import given
from hypothesis import strategies as st

from comity_domain import distance_desirability
from comity_fis import load_rulebook
from comity_fis.inference.value import Contribution, ParameterValue

FLOOR_M = 0.30


def distance(culture: str) -> ParameterValue:
    return load_rulebook("bruno2017").infer({"culture": culture})["conversational_distance"]


@given(st.floats(0.0, 2.0))
def test_distances_below_what_rules_give_are_possible_and_not_desirable(x: float):
    value = distance("JPN")
    found, (lowest, highest) = distance_desirability(value, FLOOR_M), value.desirability.domain
    low, high = found.domain
    assert FLOOR_M < low < FLOOR_M + 0.02
    assert high == highest
    assert found(x) == (value.desirability(x) if x >= lowest else 0.0)


@pytest.mark.parametrize("culture", ["DEU", "EGY", "JPN"])
def test_the_distances_that_are_possible_do_not_depend_on_culture(culture: str):
    domains = [distance_desirability(distance(one), FLOOR_M).domain for one in (culture, "SWE")]
    assert domains[0] == domains[1]


@pytest.mark.parametrize("origin", ["setting", "learnt"])
def test_what_a_person_asked_for_or_showed_is_not_shortened(origin):
    theirs = replace(distance("JPN"), contributions=(Contribution(origin, 0.7, "as they said"),))
    assert distance_desirability(theirs, FLOOR_M) is theirs.desirability
