"""Several cultures in one person: what they give together lies between what each gives alone."""

from __future__ import annotations

from dataclasses import replace
from math import fsum

import pytest
from hypothesis import given
from hypothesis import strategies as st

from comity_fis import Choice, MixedFact, Part, individualism_scores, load_rulebook, mixed
from comity_fis.errors import WrongValueError

BOOK = load_rulebook("bruno2017")
SCORES = [row.value for row in individualism_scores()]

weights = st.floats(0.01, 100)
someone = st.fixed_dictionaries(
    {},
    optional={
        "gender": st.sampled_from(["female", "male"]),
        "age": st.floats(0, 117),
        "robot_experience": st.sampled_from(["low", "high"]),
        "posture": st.sampled_from(["standing", "seated"]),
        "formality": st.sampled_from(["informal", "formal"]),
    },
)
scores = st.none() | st.sampled_from(SCORES)


def parts_of(facts, cultures):
    """A part for each individualism and weight; None is a culture without a score."""
    return [
        Part(f"{score} no. {i}", weight, BOOK.infer({**facts, "individualism": score}))
        for i, (score, weight) in enumerate(cultures)
    ]


cultures = st.lists(st.tuples(scores, weights), min_size=1, max_size=4)


@given(someone, cultures)
def test_a_number_lies_between_its_parts_and_is_the_sum_of_its_contributions(facts, chosen):
    parts = parts_of(facts, chosen)
    answer = mixed(parts, BOOK.parameters)
    for name, value in answer.parameters.items():
        if isinstance(value.value, str):
            continue
        numbers = [part.inference[name].number for part in parts]
        assert min(numbers) <= value.number <= max(numbers)
        assert fsum(step.value for step in value.contributions) == pytest.approx(value.number, abs=1e-12)
        assert value.spread >= min(part.inference[name].spread for part in parts) - 1e-12


@given(someone, cultures, st.floats(0, 1))
def test_desirability_lies_between_its_parts_and_its_outline_runs_along_it(facts, chosen, where):
    parts = parts_of(facts, chosen)
    curve = mixed(parts, BOOK.parameters)["conversational_distance"].desirability
    curves = [part.inference["conversational_distance"].desirability for part in parts]
    low, high = curve.domain
    x = low + where * (high - low)
    assert min(one(x) for one in curves) - 1e-12 <= curve(x) <= max(one(x) for one in curves) + 1e-12
    assert curve.height(low, high) >= curve(x) - 1e-12
    assert low <= curve.centroid(low, high) <= high
    for place, degree in curve.outline:
        assert degree == pytest.approx(curve(place), abs=1e-9)


@given(someone, cultures)
def test_the_mixed_curves_area_is_the_weighted_sum_of_areas(facts, chosen):
    """Held against a fine sum, which knows nothing of outlines."""
    curve = mixed(parts_of(facts, chosen), BOOK.parameters)["conversational_distance"].desirability
    points = curve.sample(1001)
    area = fsum(degree for _, degree in points)
    centre = fsum(x * degree for x, degree in points) / area
    assert curve.centroid(*curve.domain) == pytest.approx(centre, abs=3e-3)


@given(someone, cultures)
def test_a_word_is_the_most_desirable_or_the_neutral_one(facts, chosen):
    parts = parts_of(facts, chosen)
    for name, value in mixed(parts, BOOK.parameters).parameters.items():
        if isinstance(value.desirability, Choice):
            degrees = value.desirability.memberships
            best = max(degrees.values())
            assert degrees[value.word] == pytest.approx(best, abs=1e-9)
            tied = [word for word, degree in degrees.items() if best - degree < 1e-12]
            assert len(tied) == 1 or value.word == BOOK.parameters[name].neutral


@given(someone, cultures)
def test_a_word_is_no_more_and_no_less_desirable_than_in_all_parts(facts, chosen):
    parts = parts_of(facts, chosen)
    for name, value in mixed(parts, BOOK.parameters).parameters.items():
        if isinstance(value.desirability, Choice):
            for word, degree in value.desirability.memberships.items():
                degrees = [part.inference[name].desirability.memberships[word] for part in parts]
                assert min(degrees) - 1e-12 <= degree <= max(degrees) + 1e-12


@given(someone, scores, st.lists(weights, min_size=1, max_size=4))
def test_one_culture_however_often_named_is_that_culture(facts, score, shares):
    alone = BOOK.infer({**facts, "individualism": score})
    answer = mixed(parts_of(facts, [(score, weight) for weight in shares]), BOOK.parameters)
    assert answer == alone


@given(someone, cultures, st.floats(0.45, 3.0))
def test_a_setting_is_honoured_to_the_last_digit(facts, chosen, asked):
    parts = [
        Part(
            str(i),
            weight,
            BOOK.infer({**facts, "individualism": score}, settings={"conversational_distance": asked}),
        )
        for i, (score, weight) in enumerate(chosen)
    ]
    value = mixed(parts, BOOK.parameters)["conversational_distance"]
    assert (value.value, value.origin, value.parts) == (asked, "setting", ())


def test_the_parts_are_shown_with_their_shares():
    facts = {"gender": "female"}
    value = mixed(parts_of(facts, [(38, 1), (67, 3)]), BOOK.parameters)["conversational_distance"]
    alone = [
        BOOK.infer({**facts, "individualism": score})["conversational_distance"].number for score in (38, 67)
    ]
    assert [(part.share, part.value) for part in value.parts] == [(0.25, alone[0]), (0.75, alone[1])]
    assert value.number == pytest.approx(0.25 * alone[0] + 0.75 * alone[1])
    assert value.origin == "culture"
    assert "(25%)" in value.contributions[0].text


def test_what_differs_between_the_parts_is_a_mixed_fact():
    answer = mixed(parts_of({"gender": "female"}, [(38, 1), (None, 1)]), BOOK.parameters)
    assert answer.inputs["gender"] == "female"
    fact = answer.inputs["individualism"]
    assert isinstance(fact, MixedFact)
    assert str(fact) == "38 (38 no. 0, 50%) and not disclosed (None no. 1, 50%)"


def test_a_tie_goes_to_the_neutral_word_and_says_so():
    """Half Japan, which bows, and half India, which puts its palms together: it is not for us to choose."""
    book = replace(BOOK, rules=tuple(rule for rule in BOOK.rules if rule.reads == ("culture",)))
    japan, india = (Part(key, 1, book.infer({"culture": key})) for key in ("JPN", "IND"))
    gestures = [part.inference["greeting_gesture"].word for part in (japan, india)]
    assert gestures == ["bow", "palms_together"]
    value = mixed([japan, india], book.parameters)["greeting_gesture"]
    assert value.word == "nod"
    assert "bow, palms_together are equally desirable; nod, the neutral value, stands" in value.note
    assert mixed([replace(japan, weight=2), india], book.parameters)["greeting_gesture"].word == "bow"


@pytest.mark.parametrize("weight", [0.0, -1.0, float("nan"), float("inf")])
def test_a_weight_is_above_0(weight):
    with pytest.raises(WrongValueError):
        Part("a", weight, BOOK.infer({}))
