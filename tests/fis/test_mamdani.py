import dataclasses

import pytest
from hypothesis import given
from hypothesis import strategies as st

from comity_fis import Rulebook
from comity_fis.defuzzification.output_set import Layer, OutputSet
from comity_fis.membership.function import Trapezoid
from comity_fis.membership.interval import Interval

warmth = st.none() | st.floats(0, 10)
mood = st.none() | st.sampled_from(["calm", "lively"])


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
    both = OutputSet(Interval(0, 4), (Layer(term, 0.4), Layer(term, 0.7)))
    assert both(0.5) == 0.7
    assert both.value() == pytest.approx(OutputSet(Interval(0, 4), (Layer(term, 0.7),)).value())


def test_a_curve_is_0_outside_its_domain():
    curve = OutputSet(Interval(0, 4), (Layer(Trapezoid(0, 0, 4, 4), 1),))
    assert (curve(-0.1), curve(4.1), curve.height(5, 6), curve.centroid(5, 6)) == (0, 0, 0, None)
    assert (curve(0), curve(4), curve.height(3, 9), curve.centroid(3, 9)) == (1, 1, 1, 3.5)


def test_the_curves_centroid_over_its_domain_is_the_exact_value(case2):
    value = case2.infer({"individualism": 38, "gender": "female"})["conversational_distance"]
    assert value.desirability.centroid(*value.desirability.domain) == pytest.approx(value.number, abs=1e-12)
