"""Who owns what: the parts add up however many rules there are."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from comity_fis import FiredRule, Rule, load_rulebook
from comity_fis.defuzzification.closed_form import closed_form
from comity_fis.explanation.attribution import attribute
from comity_fis.rules.rule import Is

PARAMETER = load_rulebook("bruno2017-case2").parameters["conversational_distance"]
FORM = closed_form(PARAMETER.terms, PARAMETER.rules)
strengths = st.floats(1e-3, 1) | st.sampled_from([0.25, 0.5, 0.75, 1.0])
firings = st.lists(st.tuples(st.sampled_from(list(PARAMETER.terms)), strengths), min_size=1, max_size=8)


def given_by(fired):
    """Rules with these terms and strengths, strongest first."""
    ordered = sorted(enumerate(fired, 1), key=lambda one: -one[1][1])
    return [
        FiredRule(
            Rule(
                number=number,
                text="",
                antecedent=Is("x", "t"),
                consequents=(Is(PARAMETER.name, term),),
                sources=(),
                evidence="design",
            ),
            strength,
        )
        for number, (term, strength) in ordered
    ]


@given(firings)
def test_contributions_add_up_to_the_centre_of_area(fired):
    heights: dict[str, float] = {}
    for term, strength in fired:
        heights[term] = max(strength, heights.get(term, 0.0))
    portions = attribute(given_by(fired), PARAMETER).portions().values()
    assert sum(portion.contribution for portion in portions) == pytest.approx(FORM.centre(heights), abs=1e-12)
    assert sum(portion.share for portion in portions) == pytest.approx(1, abs=1e-12)


@given(firings)
def test_a_weaker_rule_never_owns_more_than_a_stronger_one_for_the_same_term(fired):
    owned = attribute(given_by(fired), PARAMETER).portions()
    share = {number: portion.share for number, portion in owned.items()}
    numbered = list(enumerate(fired, 1))
    for number, (term, strength) in numbered:
        for other, (its_term, its_strength) in numbered:
            if term == its_term and strength < its_strength:
                assert share.get(number, 0) <= share.get(other, 0) + 1e-12


@pytest.mark.parametrize("height", [0.1, 0.3, 0.49])
def test_neighbours_of_one_height_share_the_flat_between_them(height):
    """Close and medium overlap over 0.65..0.75; below the crossing at 0.5 both are flat there together."""
    attribution = attribute(given_by([("close", height), ("medium", height)]), PARAMETER)
    (shared,) = [piece for piece in attribution.pieces if len(piece.owners) == 2]
    assert (shared.left, shared.right) == pytest.approx((0.65 + 0.1 * height, 0.75 - 0.1 * height))
    assert shared.area == pytest.approx(height * (shared.right - shared.left))
