"""Rule weights, and one rule in another's place."""

import dataclasses

import pytest
from hypothesis import given
from hypothesis import strategies as st

from comity_fis import InputError, load_rulebook
from comity_fis.errors import WrongValueError

TEXT = "if individualism is very LC1 then approach_speed is fast"


def test_a_replaced_rule_acts_and_the_old_rulebook_does_not_change(small):
    before = small.infer({"warmth": 10, "mood": "calm"})
    changed = small.with_rule(1, "if warmth is very warm then distance is away")
    assert changed.infer({"warmth": 10, "mood": "calm"})["distance"].number > 3
    assert small.infer({"warmth": 10, "mood": "calm"}) == before
    assert [rule.number for rule in changed.rules] == list(range(1, 8))


@given(st.integers(1, 7), st.none() | st.floats(0, 10), st.sampled_from([None, "calm", "lively"]))
def test_replacing_is_the_same_as_building_anew(small, number, warmth, mood):
    rule = dataclasses.replace(small.rules[(number + 2) % 7], weight=0.5)
    try:
        replaced = small.with_rule(number, rule)
    except InputError:
        return  # the rule that it replaced kept a parameter from reading itself
    rules = list(small.rules)
    rules[number - 1] = dataclasses.replace(rule, number=number)
    anew = dataclasses.replace(small, rules=tuple(rules))
    assert replaced == anew
    inputs = {"warmth": warmth, "mood": mood}
    assert replaced.infer(inputs) == anew.infer(inputs)


def test_a_text_brings_no_evidence_with_it(bruno2017):
    rule = bruno2017.with_rule(1, TEXT).rules[0]
    assert (rule.sources, rule.evidence, rule.weight) == ((), "design", 1.0)
    assert bruno2017.rules[0].text in rule.note


@pytest.mark.parametrize("number", [0, -1, 8])
def test_there_must_be_a_rule_to_replace(small, number):
    with pytest.raises(InputError, match=r"1\.\.7"):
        small.with_rule(number, TEXT)


def test_a_replacement_is_checked_like_a_file(small):
    with pytest.raises(InputError, match="Did you mean 'warm'"):
        small.with_rule(1, "if warmth is warn then distance is near")
    with pytest.raises(InputError, match="do not depend on themselves"):
        small.with_rule(1, "if volume is loud then distance is near")


@given(st.floats(0.01, 1), st.floats(0, 10))
def test_a_weight_scales_the_strength(small, weight, warmth):
    weighted = dataclasses.replace(
        small, rules=tuple(dataclasses.replace(rule, weight=weight) for rule in small.rules)
    )
    inputs = {"warmth": warmth, "mood": "calm"}
    for whole, part in zip(
        small.infer(inputs)["gesture"].fired, weighted.infer(inputs)["gesture"].fired, strict=True
    ):
        assert part.strength == pytest.approx(weight * whole.strength)


def test_a_weight_is_written_beside_the_rule(write):
    rule = "{rule: if warmth is warm then distance is near, sources: [book], evidence: weak"
    rulebook = load_rulebook(write((rule, f"{rule}, weight: 0.25")))
    assert rulebook.rules[0].weight == 0.25
    assert rulebook.infer({"warmth": 10, "mood": "calm"})["distance"].desirability(0.5) == 0.25


@pytest.mark.parametrize("weight", ["0", "-0.5", "1.5", "much", ".nan"])
def test_what_is_no_weight_is_refused(write, weight):
    rule = "{rule: if warmth is warm then distance is near, sources: [book], evidence: weak"
    with pytest.raises(InputError, match="weight"):
        load_rulebook(write((rule, f"{rule}, weight: {weight}")))


def test_a_rule_of_no_weight_cannot_be_built(small):
    with pytest.raises(WrongValueError):
        dataclasses.replace(small.rules[0], weight=0.0)
