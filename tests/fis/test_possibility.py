"""Inputs that are known only roughly."""

from itertools import pairwise

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from comity_fis import InputError, Interval
from comity_fis.inference.known import known
from comity_fis.inference.rough import RoughNumber, RoughWord
from comity_fis.membership.function import Bump, Categories, Trapezoid, TwoTermGaussian
from comity_fis.rules.antecedent import Literal

number = st.floats(0, 10)


@st.composite
def trapezoids(draw):
    a, b, c, d = sorted(draw(st.lists(number, min_size=4, max_size=4)))
    assume(d - a > 1e-3)
    return Trapezoid(a, b, c, d)


gaussians = st.builds(
    TwoTermGaussian,
    st.builds(Bump, st.floats(0.1, 1), number, st.floats(0.5, 5)),
    st.builds(Bump, st.floats(0, 1), number, st.floats(0.5, 5)),
)
terms = trapezoids() | gaussians
exponents = st.sampled_from([0.5, 1.0, 2.0, 3.0])


def literal(term, exponent, negated, x):
    degree = term(x) ** exponent
    return 1 - degree if negated else degree


def wanted(negated=False, exponent=1.0):
    """A literal about some variable's term."""
    return Literal("x", "t", exponent, negated)


@given(terms, exponents, st.booleans(), number, number)
def test_an_interval_is_as_possible_as_its_most_favourable_number(term, exponent, negated, one, other):
    low, high = sorted((one, other))
    assume(low < high)
    degree = RoughNumber(Interval(low, high), low, high).possibility(term, wanted(negated, exponent))
    edges = [x for knot in term.knots for x in (knot - 1e-9, knot, knot + 1e-9) if low <= x <= high]
    grid = sorted([min(low + (high - low) * i / 200, high) for i in range(201)] + edges)
    best = max(literal(term, exponent, negated, x) for x in grid)
    assert best - 1e-12 <= degree <= 1
    widest = max(
        abs(literal(term, exponent, negated, x) - literal(term, exponent, negated, y))
        for x, y in pairwise(grid)
    )
    assert degree <= best + widest + 1e-9


@given(terms, terms, exponents, st.booleans(), number)
def test_a_fuzzy_set_is_at_least_as_possible_as_each_number_in_it(term, given_set, exponent, negated, x):
    degree = RoughNumber(given_set, 0, 10).possibility(term, wanted(negated, exponent))
    assert degree >= min(literal(term, exponent, negated, x), given_set(x)) - 1e-9
    assert degree <= given_set.height(0, 10) + 1e-9


@given(trapezoids())
def test_a_set_meets_itself_fully(term):
    assert RoughNumber(term, 0, 10).possibility(term, wanted()) == pytest.approx(1)


def test_two_slopes_meet_where_they_cross():
    falling, rising = Trapezoid(0, 0, 2, 6), Trapezoid(2, 6, 10, 10)
    assert RoughNumber(falling, 0, 10).possibility(rising, wanted()) == pytest.approx(0.5)
    assert RoughNumber(falling, 0, 10).possibility(falling, wanted(True)) == pytest.approx(0.5)


@given(st.dictionaries(st.sampled_from("abc"), st.floats(0.01, 1), min_size=1), st.booleans())
def test_categories_by_the_definition(degrees, negated):
    term = Categories(frozenset("ab"))
    matching = [degree for category, degree in degrees.items() if (category in "ab") is not negated]
    assert RoughWord(degrees).possibility(term, wanted(negated)) == max(matching, default=0.0)


@given(st.booleans(), st.booleans())
def test_what_excludes_nothing_was_not_disclosed(small, by_interval, with_mood):
    everything = Interval(0, 10) if by_interval else Trapezoid(-1, -1, 11, 11)
    mood = {"mood": {"calm": 1, "lively": 1.0}} if with_mood else {}
    assert small.infer({"warmth": everything, **mood}) == small.infer({})


@given(number, st.sampled_from(["calm", "lively"]))
def test_a_rough_input_that_is_precise_after_all(small, warmth, mood):
    precise = small.infer({"warmth": warmth, "mood": mood})
    assert small.infer({"warmth": [warmth, warmth], "mood": {mood: 1}}) == precise


@given(number, number, number)
def test_a_wider_interval_never_makes_a_rule_weaker(small, one, other, more):
    low, high = sorted((one, other))
    assume(low < high)
    narrow = small.infer({"warmth": Interval(low, high), "mood": "lively"})
    wide = small.infer({"warmth": Interval(min(low, more), max(high, more)), "mood": "lively"})
    strengths = {fired.rule.number: fired.strength for fired in wide["distance"].fired}
    for fired in narrow["distance"].fired:
        assert strengths[fired.rule.number] >= fired.strength - 1e-9


def test_inputs_may_be_precise_rough_and_unknown_at_once(bruno2017):
    inference = bruno2017.infer(
        {"age": (60, 70), "gender": {"female": 1.0, "male": 0.3}, "individualism": 38}
    )
    assert inference["approach_speed"].number < 0.4
    assert inference.as_json()["inputs"]["age"] == [60.0, 70.0]
    assert inference.as_json()["inputs"]["gender"] == {"female": 1.0, "male": 0.3}
    assert bruno2017.infer(inference.inputs) == inference


def test_a_mixed_input_lies_between_its_parts(case2):
    woman, man = (
        case2.infer({"individualism": 38, "gender": g})["conversational_distance"].number
        for g in ("female", "male")
    )
    mixed = case2.infer({"individualism": 38, "gender": {"female": 1.0, "male": 0.3}})
    assert woman < mixed["conversational_distance"].number < man


def test_consent_that_is_only_possible_is_no_consent(small):
    for consent in ({"given": 1.0, "withheld": 0.2}, {"given": 0.9}):
        assert small.infer({"warmth": 9, "touch_consent": consent})["gesture"].word != "hug"


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("age", (60, 200)),
        ("age", (70, 60)),
        ("age", (float("nan"), 60)),
        ("age", [1, 2, 3]),
        ("age", {"female": 1}),
        ("age", Trapezoid(200, 210, 220, 230)),
        ("gender", {"femal": 1.0}),
        ("gender", {"female": 1.5}),
        ("gender", {"female": "much"}),
        ("gender", {}),
        ("gender", {"female": 0}),
        ("gender", (60, 70)),
        ("gender", Interval(0, 1)),
    ],
)
def test_what_is_no_rough_value_is_refused(bruno2017, name, value):
    with pytest.raises(InputError):
        known(bruno2017.variables[name], value)
