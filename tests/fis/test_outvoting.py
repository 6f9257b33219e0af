"""An undisclosed fact that outvotes a disclosed one is found, and is said first where the reason is given."""

from __future__ import annotations

from dataclasses import replace

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from comity.report.values.inference import because, in_brief, outvoted_text
from comity_fis import kept_back, load_rulebook, outvoting
from comity_fis.explanation.what_if import leading

FACTS = {
    "culture": st.sampled_from(["DEU", "JPN", "IND", "GBR", "SWE", "CHN", "East Africa"]),
    "gender": st.sampled_from(["female", "male"]),
    "age": st.integers(0, 117),
    "posture": st.sampled_from(["standing", "seated"]),
    "robot_experience": st.sampled_from(["low", "high"]),
    "formality": st.sampled_from(["informal", "formal"]),
    "touch_consent": st.sampled_from(["given", "withheld"]),
}
BOOK = load_rulebook("bruno2017")


def without_undisclosed(inputs):
    """The rulebook without the rules that read anything that was not disclosed."""
    book = BOOK
    for rule in BOOK.rules:
        if kept_back(rule, inputs):
            book = book.with_rule(rule.number, replace(rule, enabled=False))
    return book


@settings(max_examples=150, deadline=None)
@given(st.fixed_dictionaries({}, optional=FACTS))
def test_what_outvotes_is_what_leads_only_because_something_was_not_disclosed(facts):
    inference = BOOK.infer(facts)
    bare = without_undisclosed(inference.inputs).infer(facts)
    for name, value in inference.items():
        found = outvoting(value, inference.inputs)
        parameter, alone = BOOK.parameters[name], bare[name]
        told = [one for one in value.fired if not kept_back(one.rule, inference.inputs)]
        if found is None:
            continue
        assert found.hidden
        assert all(inference.inputs[hidden] is None for hidden in found.hidden)
        assert found.outvoted in told
        assert leading(value, parameter) != leading(alone, parameter)
        reason = outvoted_text(value, inference.inputs)
        assert because(value, inference.inputs).startswith(reason)
        assert in_brief(value, inference.inputs).startswith(reason)


@settings(max_examples=100, deadline=None)
@given(st.fixed_dictionaries(FACTS))
def test_where_everything_is_disclosed_nothing_is_outvoted(facts):
    inference = BOOK.infer(facts)
    assert not any(outvoting(value, inference.inputs) for value in inference.values())


@pytest.mark.parametrize(
    ("facts", "parameter", "hidden", "rules", "outvoted"),
    [
        ({"culture": "DEU"}, "approach_speed", ("age", "robot_experience"), {"slow"}, "medium"),
        ({"culture": "DEU", "age": 30}, "approach_speed", ("robot_experience",), {"slow"}, "medium"),
        (
            {"culture": "DEU", "touch_consent": "given"},
            "greeting_gesture",
            ("formality",),
            {"handshake"},
            "wave",
        ),
    ],
)
def test_the_facts_that_decide_though_nobody_disclosed_them(facts, parameter, hidden, rules, outvoted):
    inference = BOOK.infer(facts)
    found = outvoting(inference[parameter], inference.inputs)
    assert found is not None
    assert found.hidden == hidden
    assert {is_.term for one in found.rules for is_ in one.rule.consequents} == rules
    assert {is_.term for is_ in found.outvoted.rule.consequents} == {outvoted}


@pytest.mark.parametrize(
    ("facts", "parameter"),
    [
        ({"culture": "DEU"}, "conversational_distance"),  # every rule needs the gender, too
        ({"culture": "DEU"}, "greeting_gesture"),  # no handshake without consent
        ({"culture": "DEU", "robot_experience": "low"}, "approach_speed"),  # a disclosed fact says the same
        ({}, "approach_speed"),
    ],
)
def test_what_says_the_same_or_cannot_be_outvotes_nothing(facts, parameter):
    inference = BOOK.infer(facts)
    assert outvoting(inference[parameter], inference.inputs) is None
