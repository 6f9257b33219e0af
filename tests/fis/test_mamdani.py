import dataclasses

import pytest
from hypothesis import given
from hypothesis import strategies as st

from comity_fis import Rulebook
from comity_fis.centroid import Cut
from comity_fis.interval import Interval
from comity_fis.mamdani import AggregatedSet, holds, strength
from comity_fis.membership import Trapezoid
from comity_fis.rule import And, Is, Not, Or

warmth = st.none() | st.floats(0, 10)
mood = st.none() | st.sampled_from(["calm", "lively"])

NAMES = ["a", "b", "c"]
conditions = st.recursive(
    st.builds(Is, st.sampled_from(NAMES), st.just("t")),
    lambda inner: (
        st.builds(Not, inner)
        | st.builds(And, st.lists(inner, min_size=2, max_size=3).map(tuple))
        | st.builds(Or, st.lists(inner, min_size=2, max_size=3).map(tuple))
    ),
    max_leaves=8,
)
degrees = st.fixed_dictionaries({name: st.floats(0, 1) for name in NAMES})


@given(conditions, degrees)
def test_not_is_the_complement_where_all_is_known(condition, known):
    def lookup(name: str, term: str) -> float:
        return known[name]

    assert strength(Not(condition), lookup) == pytest.approx(1 - strength(condition, lookup))


@given(conditions)
def test_of_a_person_of_whom_nothing_is_known_everything_and_its_opposite_holds(condition):
    def lookup(name: str, term: str) -> None:
        return None

    assert strength(condition, lookup) == strength(Not(condition), lookup) == 1
    assert not holds(condition, lookup)
    assert not holds(Not(condition), lookup)


@given(conditions, degrees, st.sampled_from(NAMES))
def test_hiding_a_value_never_makes_a_rule_weaker(condition, known, hidden):
    shown = strength(condition, lambda name, term: known[name])
    assert strength(condition, lambda name, term: None if name == hidden else known[name]) >= shown


@given(warmth, mood, st.randoms(use_true_random=False))
def test_the_order_of_rules_does_not_matter(small: Rulebook, warmth, mood, random):
    rules = list(small.rules)
    random.shuffle(rules)
    shuffled = dataclasses.replace(small, rules=tuple(rules))
    inputs = {"warmth": warmth, "mood": mood}
    one, other = small.infer(inputs), shuffled.infer(inputs)
    assert other["distance"].number == pytest.approx(one["distance"].number, abs=1e-12)
    assert other["gesture"].word == one["gesture"].word
    assert other["gesture"].desirability == one["gesture"].desirability


@given(warmth, mood)
def test_a_rule_that_does_not_fire_changes_nothing(small: Rulebook, warmth, mood):
    inputs = {"warmth": warmth, "mood": mood}
    before = small.infer(inputs)
    fired = {firing.rule.number for value in before.parameters.values() for firing in value.fired}
    without = dataclasses.replace(small, rules=tuple(rule for rule in small.rules if rule.number in fired))
    after = without.infer(inputs)
    for name, value in before.parameters.items():
        assert after[name].value == value.value


@given(warmth, mood, st.sampled_from(["exact", "matlab", "skfuzzy"]))
def test_values_stay_in_their_domain(small: Rulebook, warmth, mood, mode):
    inference = small.infer({"warmth": warmth, "mood": mood}, mode=mode)
    for name in ("distance", "volume"):
        low, high = inference[name].desirability.domain
        assert low <= inference[name].number <= high


def test_max_and_not_sum():
    """Two rules for one term: the stronger one counts alone."""
    term = Trapezoid(0, 0, 1, 2)
    both = AggregatedSet(Interval(0, 4), (Cut(term, 0.4), Cut(term, 0.7)))
    assert both(0.5) == 0.7
    assert both.centroid(0, 4) == AggregatedSet(Interval(0, 4), (Cut(term, 0.7),)).centroid(0, 4)


def test_a_curve_is_0_outside_its_domain():
    curve = AggregatedSet(Interval(0, 4), (Cut(Trapezoid(0, 0, 4, 4), 1),))
    assert (curve(-0.1), curve(4.1), curve.height(5, 6), curve.centroid(5, 6)) == (0, 0, 0, None)
    assert (curve(0), curve(4), curve.height(3, 9), curve.centroid(3, 9)) == (1, 1, 1, 3.5)


def test_the_curves_centroid_over_its_domain_is_the_exact_value(case2):
    value = case2.infer({"individualism": 38, "gender": "female"})["conversational_distance"]
    assert value.desirability.centroid(*value.desirability.domain) == value.number
