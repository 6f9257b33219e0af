"""What an explanation says is so: its parts add up, and what it predicts happens."""

from __future__ import annotations

import math
from dataclasses import replace

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from comity_fis import Explanation, InputError, Rulebook, explain
from comity_fis.explanation.attribution import attribute
from comity_fis.explanation.what_if import flipped, leading
from comity_fis.membership.function import Bump, TwoTermGaussian

warmth = st.floats(0, 10) | st.sampled_from([0.0, 2.0, 4.0, 6.0, 10.0])
mood = st.none() | st.sampled_from(["calm", "lively"])
inputs = st.fixed_dictionaries({"warmth": st.none() | warmth, "mood": mood})
numbers = st.sampled_from(["distance", "volume"])
some = settings(max_examples=40, deadline=None)
"""An explanation is some hundred inferences."""


def without(rulebook: Rulebook, number: int) -> Rulebook:
    return replace(rulebook, rules=tuple(rule for rule in rulebook.rules if rule.number != number))


def number_at(rulebook: Rulebook, parameter: str, known: dict, **changed: float) -> float:
    return rulebook.infer({**known, **changed})[parameter].number


@some
@given(inputs, numbers)
def test_contributions_add_up_to_the_value_and_shares_to_one(wide: Rulebook, known, parameter):
    explanation = explain(wide, known, parameter)
    if explanation.decided_by_rules:
        total = sum(account.contribution for account in explanation.rules)
        assert total == pytest.approx(explanation.value.number, abs=1e-9)
        assert sum(account.share for account in explanation.rules) == pytest.approx(1, abs=1e-9)
        assert all(0 <= account.share <= 1 for account in explanation.rules)
    else:
        assert explanation.rules == ()


@some
@given(inputs, st.sampled_from(["distance", "volume", "gesture"]))
def test_without_a_rule_means_with_the_rule_really_removed(wide: Rulebook, known, parameter):
    for account in explain(wide, known, parameter).rules:
        really = without(wide, account.rule.number).infer(known)[parameter]
        assert account.without.value == really.value
        assert (account.without.origin, account.without.note) == (really.origin, really.note)


@some
@given(inputs, numbers)
def test_a_rule_without_a_share_can_go(wide: Rulebook, known, parameter):
    explanation = explain(wide, known, parameter)
    for account in explanation.rules:
        decides_what_others_read = any(is_.name != parameter for is_ in account.rule.consequents)
        if account.share == 0 and not decides_what_others_read:
            assert account.without.value == pytest.approx(explanation.value.number, abs=1e-9)


@some
@given(warmth, mood, numbers)
def test_derivatives_agree_with_finite_differences_on_each_side(wide: Rulebook, x, mood, parameter):
    known = {"warmth": x, "mood": mood}
    explanation = explain(wide, known, parameter)
    step = 1e-5
    for one in explanation.sensitivities:
        for derivative, side in ((one.below, -1), (one.above, 1)):
            if derivative is None or not 0 <= x + 2 * side * step <= 10:
                continue
            near, far = (number_at(wide, parameter, known, warmth=x + k * side * step) for k in (1, 2))
            here = explanation.value.number
            if abs(near - here) > 1e-2:
                assert math.isinf(derivative)
                continue
            slopes = [(near - here) / (side * step), (far - near) / (side * step)]
            if abs(slopes[0] - slopes[1]) < 1e-2:  # otherwise a corner lies within the steps
                assert derivative == pytest.approx(2 * slopes[0] - slopes[1], abs=1e-3, rel=1e-3)


@some
@given(warmth, mood, numbers)
def test_where_it_says_flat_nothing_changes(wide: Rulebook, x, mood, parameter):
    known = {"warmth": x, "mood": mood}
    explanation = explain(wide, known, parameter)
    for one in explanation.sensitivities:
        if one.flat and one.flat_over is not None:
            assert one.flat_over.low <= x <= one.flat_over.high
            for place in (one.flat_over.low, one.flat_over.high, (x + one.flat_over.low) / 2):
                value = number_at(wide, parameter, known, warmth=place)
                assert value == pytest.approx(explanation.value.number, abs=1e-6)


@some
@given(warmth, mood, st.sampled_from(["distance", "volume", "gesture"]))
def test_the_nearest_flip_flips_and_a_smaller_change_does_not(wide: Rulebook, x, mood, parameter):
    known = {"warmth": x, "mood": mood}
    explanation = explain(wide, known, parameter)

    def leads_at(place: float) -> tuple[str, ...]:
        return leading(wide.infer({**known, "warmth": place})[parameter], wide.parameters[parameter])

    for flip in explanation.flips:
        assert flip.leads == leads_at(flip.to)
        assert flipped(explanation.leading, flip.leads)
        reach = abs(flip.to - x) - 1e-8
        for share in (1.0, 0.99, 0.5):
            for side in (-1, 1):
                place = x + side * reach * share
                if reach > 0 and 0 <= place <= 10:
                    assert not flipped(explanation.leading, leads_at(place))


@some
@given(inputs, st.sampled_from(["distance", "volume", "gesture"]))
def test_alternatives_are_what_inference_gives(wide: Rulebook, known, parameter):
    for other in explain(wide, known, parameter).alternatives:
        for given_ in other.given if isinstance(other.given, tuple) else (other.given,):
            assert wide.infer({**known, other.input: given_})[parameter].value == other.value.value


def test_the_papers_german_woman(case2):
    explanation = explain(case2, {"individualism": 67, "gender": "female"}, "conversational_distance")
    assert [account.rule.number for account in explanation.rules] == [2, 1]
    assert [account.contribution for account in explanation.rules] == pytest.approx(
        [0.8411, 0.0057], abs=1e-4
    )
    assert explanation.leading == ("medium",)
    assert explanation.sensitivities[0].derivative == pytest.approx(0.000737764, abs=1e-8)
    (flip,) = explanation.flips
    # Both terms are equally true there.
    terms = case2.variables["individualism"].terms
    assert terms["LC1"](flip.to) == pytest.approx(terms["LC2"](flip.to), abs=1e-6)
    assert flip.leads == ("close",)
    (man,) = explanation.alternatives
    assert (man.given, man.leads, man.flips) == (("male",), ("far",), True)


def test_rules_that_tie_own_equal_parts(wide):
    """Two rules hold fully for the same term."""
    explanation = explain(wide, {"warmth": 0, "mood": "calm"}, "distance")
    assert [account.share for account in explanation.rules] == [0.5, 0.5]
    assert {account.without.value for account in explanation.rules} == {explanation.value.value}


def test_a_weaker_rule_for_the_same_term_owns_half_of_what_lies_below_it(small):
    """Near is cut at 0.75 by one rule and at 0.25 by another: the slope below 0.25 is common to both."""
    rules = list(small.rules)
    rules[1] = replace(rules[1], consequents=rules[0].consequents)
    both = replace(small, rules=tuple(rules[:2]))
    strong, weak = explain(both, {"warmth": 5}, "distance").rules
    assert (strong.strength, weak.strength) == (0.75, 0.25)
    # The term falls over [1, 2]: it is below 0.25 from 1.75 on, where a triangle of area 0.03125 is left.
    area = 1 * 0.75 + (1.25 - 1) * 0.75 + (2 - 1.25) * 0.75 / 2
    assert weak.share == pytest.approx(0.03125 / 2 / area)


def test_nothing_left_is_the_neutral_value_and_says_so(small):
    (account,) = explain(small, {"warmth": 0, "mood": "calm"}, "distance").rules
    assert (account.without.value, account.without.origin) == (3.5, "neutral")
    assert account.without.note == "no rule fires"


def test_flat_says_over_which_interval(small):
    """Below 2 it is fully cold and not warm at all."""
    (one,) = explain(small, {"warmth": 1, "mood": "calm"}, "distance").sensitivities
    assert one.flat
    assert one.flat_over.ends == pytest.approx((0, 2), abs=1e-6)


def test_a_corner_has_two_slopes(small):
    (one,) = explain(small, {"warmth": 2, "mood": "calm"}, "distance").sensitivities
    assert one.kink
    assert one.derivative is None
    assert one.below == 0
    assert one.above < -0.5


def test_at_an_end_of_the_domain_there_is_one_side(small):
    (one,) = explain(small, {"warmth": 10, "mood": "lively"}, "distance").sensitivities
    assert one.above is None
    assert one.derivative == one.below == 0


def test_where_the_value_jumps_there_is_no_derivative(small):
    """Nothing fires at 2; just above, near does."""
    rulebook = replace(small, rules=(small.rules[0],))
    explanation = explain(rulebook, {"warmth": 2, "mood": "calm"}, "distance")
    assert explanation.value.origin == "neutral"
    (one,) = explanation.sensitivities
    assert math.isinf(one.above)
    assert one.below == 0


def test_a_setting_has_no_rules_and_says_what_they_would_have_given(small):
    explanation = explain(small, {"warmth": 9}, "distance", {"distance": 7.5})
    assert explanation.value.origin == "safety"
    assert (explanation.rules, explanation.flips, explanation.alternatives, explanation.variables) == (
        (),
    ) * 4
    assert explanation.unasked == small.infer({"warmth": 9})["distance"]


def test_behind_a_setting_nothing_is_read(small):
    explanation = explain(small, {"warmth": 9}, "volume", {"distance": 1})
    assert explanation.variables == ()
    assert [value.origin for value in explanation.reads] == ["setting"]


def test_a_neutral_value_has_no_rules_and_says_what_disclosing_would_give(small):
    explanation = explain(small, {}, "distance")
    assert (explanation.value.origin, explanation.rules, explanation.leading) == ("neutral", (), ())
    assert [(other.input, other.given) for other in explanation.alternatives] == [
        ("warmth", 0.0),
        ("warmth", 10.0),
        ("mood", ("calm",)),
        ("mood", ("lively",)),
    ]


def test_a_category_that_is_out_keeps_its_rules_and_its_requirement(small):
    explanation = explain(small, {"warmth": 9, "mood": "calm"}, "gesture")
    hug = next(category for category in explanation.categories if category.name == "hug")
    assert (hug.permitted, hug.desirability, str(hug.requires)) == (False, 0.0, "touch_consent is given")
    assert [firing.rule.text for firing in hug.fired] == ["if warmth is warm then gesture is hug"]
    consent = next(other for other in explanation.alternatives if other.given == ("given",))
    assert (consent.value.word, consent.flips) == ("hug", True)


def test_a_parameter_that_reads_another_is_explained_through_it(small):
    explanation = explain(small, {"warmth": 5, "mood": "calm"}, "volume")
    assert [value.name for value in explanation.reads] == ["distance"]
    assert [variable.name for variable in explanation.variables] == ["warmth", "mood"]
    assert explanation.sensitivities[0].derivative < 0


def test_categories_that_no_rule_tells_apart_stand_together(bruno2017):
    explanation = explain(bruno2017, {"culture": "DEU", "individualism": 67}, "greeting_gesture")
    culture = [other for other in explanation.alternatives if other.input == "culture"]
    assert {other.given: other.value.word for other in culture if len(other.given) == 1} == {
        ("GBR",): "wave",
        ("IND",): "palms_together",
        ("JPN",): "bow",
    }
    assert sum(len(other.given) for other in culture) == len(bruno2017.variables["culture"].categories) - 1


@settings(max_examples=25, deadline=None)
@given(warmth, st.floats(0.05, 1), st.floats(0.3, 3))
def test_curved_output_terms_add_up_too(small: Rulebook, x, height, width):
    curved = TwoTermGaussian(Bump(height, 1, width), Bump(1, 3.5, 0.4))
    distance = replace(
        small.parameters["distance"], terms={**small.parameters["distance"].terms, "near": curved}
    )
    rulebook = replace(small, parameters={**small.parameters, "distance": distance})
    value = rulebook.infer({"warmth": x})["distance"]
    portions = attribute(value.fired, distance).portions().values()
    assert sum(portion.contribution for portion in portions) == pytest.approx(value.number, abs=1e-8)
    assert sum(portion.share for portion in portions) == pytest.approx(1, abs=1e-9)


def test_an_unknown_parameter_is_refused_with_the_closest_name(small):
    with pytest.raises(InputError, match="Did you mean 'distance'"):
        explain(small, {}, "distanse")


def test_explaining_twice_gives_the_same(wide):
    known = {"warmth": 4.2, "mood": None}
    first, second = (explain(wide, known, "volume") for _ in range(2))
    assert isinstance(first, Explanation)
    assert first == second
