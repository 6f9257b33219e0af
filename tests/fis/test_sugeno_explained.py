"""Sugeno systems of order 0 explained: constants, weighted by the strengths of their rules."""

from __future__ import annotations

from dataclasses import replace

import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from comity_fis import InputError, Interval, Level, NumericVariable, Source, explain
from comity_fis.membership.function import Singleton, Trapezoid
from comity_fis.rulebook.rulebook import Rulebook
from comity_fis.rules.methods import Methods
from comity_fis.rules.rule import And, Is, Not, Or, Rule
from comity_fis.variables.parameter import NumericParameter

SOURCE = Source("book", "A book", "read")
LOW, HIGH = -8, 8
corner = st.integers(LOW * 8, HIGH * 8).map(lambda eighths: eighths / 8)
"""Corners lie on eighths and inputs on sixty-fourths: an input is at a corner, or well beside it."""
value = st.integers(LOW * 64 + 1, HIGH * 64 - 1).map(lambda steps: steps / 64)
leaf = st.builds(Is, st.sampled_from(["x", "y"]), st.sampled_from(["low", "high"]))
part = st.one_of(leaf, leaf.map(Not))
several = st.lists(part, min_size=2, max_size=3).map(tuple)
conditions = st.one_of(
    part, several.map(And), several.map(Or), several.map(And).map(Not), several.map(Or).map(Not)
)


@st.composite
def slopes(draw):
    """A trapezoid whose edges are at least half a unit wide."""
    first = draw(st.integers(LOW * 8, (HIGH - 2) * 8))
    a, d = first / 8, draw(st.integers(first + 2 * 8, HIGH * 8)) / 8
    return Trapezoid(a, a + 0.5, d - 0.5, d)


@st.composite
def sugeno(draw, conditions=conditions):
    constants = {f"k{i}": Singleton(draw(corner)) for i in range(3)}
    rules = tuple(
        rule(
            number,
            draw(conditions),
            draw(st.sampled_from(sorted(constants))),
            draw(st.sampled_from([1.0, 0.5])),
        )
        for number in range(1, draw(st.integers(1, 5)) + 1)
    )
    terms = {name: {"low": draw(slopes()), "high": draw(slopes())} for name in ("x", "y")}
    methods = Methods(
        conjunction=draw(st.sampled_from(["min", "prod"])),
        disjunction=draw(st.sampled_from(["max", "probor"])),
        implication="prod",
        aggregation="sum",
    )
    return book(terms, constants, rules, methods)


def rule(number, antecedent, term, weight=1.0):
    return Rule(
        number=number, text=f"if {antecedent} then u is {term}", antecedent=antecedent,
        consequents=(Is("u", term),), sources=(SOURCE,), evidence="weak", weight=weight,
    )  # fmt: skip


def book(terms, constants, rules, methods):
    domain = Interval(LOW, HIGH)
    variables = {
        name: NumericVariable(
            name=name, kind="situation", level=Level.INTERVAL, domain=domain, terms=of, reason="made up"
        )
        for name, of in terms.items()
    }
    reasons = dict.fromkeys(("ranges", "terms", "neutral", "spread"), "made up")
    made = NumericParameter(
        name="u", kind="behaviour", unit="1", rules=domain, ask=domain, safe=domain, terms=constants,
        neutral=0.0, spread=1.0, reasons=reasons,
    )  # fmt: skip
    return Rulebook(
        name="made", description="Made up.", variables=variables, parameters={"u": made}, rules=rules,
        sources={"book": SOURCE}, methods=methods,
    )  # fmt: skip


def told(x, y):
    return {"x": x, "y": y}


@given(sugeno(), value, value)
def test_contributions_add_up_to_the_value_and_shares_are_those_of_the_strengths(rulebook, x, y):
    explanation = explain(rulebook, told(x, y), "u")
    assume(explanation.decided_by_rules)
    strengths = sum(account.strength for account in explanation.rules)
    assert sum(a.contribution for a in explanation.rules) == pytest.approx(explanation.value.number, abs=1e-9)
    for account in explanation.rules:
        (term,) = account.terms
        place = rulebook.parameters["u"].terms[term].place
        assert account.share == pytest.approx(account.strength / strengths)
        assert account.contribution == pytest.approx(account.share * place)


@given(sugeno(), value, value)
def test_without_a_rule_stands_what_the_others_infer(rulebook, x, y):
    for account in explain(rulebook, told(x, y), "u").rules:
        rest = replace(rulebook, rules=tuple(r for r in rulebook.rules if r.number != account.rule.number))
        assert account.without.value == pytest.approx(rest.infer(told(x, y))["u"].number)


STEP = 1e-9
STRONG = 0.1
"""Of all rules together: where they are weaker, the value is too steep for differences."""


@settings(max_examples=200)
@given(sugeno(), value, value)
def test_derivatives_are_those_of_small_differences_on_each_side(rulebook, x, y):
    explanation = explain(rulebook, told(x, y), "u")
    assume(sum(account.strength for account in explanation.rules) >= STRONG)
    for one in explanation.sensitivities:
        for side, found in ((-STEP, one.below), (STEP, one.above)):
            near = rulebook.infer({**told(x, y), one.input: one.at + side})["u"].number
            assert found == pytest.approx((near - explanation.value.number) / side, rel=1e-3, abs=1e-3)


def test_where_no_rule_fires_the_neutral_value_stands_and_a_rule_that_begins_is_a_jump():
    high = Trapezoid(0, 0.5, 7, 8)
    made = book(
        {"x": {"high": high}, "y": {"high": high}},
        {"k": Singleton(4)},
        (rule(1, Is("x", "high"), "k"),),
        Methods(implication="prod", aggregation="sum"),
    )
    explanation = explain(made, told(0, 0), "u")
    assert explanation.rules == ()
    assert [(one.input, one.below, one.above) for one in explanation.sensitivities] == [
        ("x", 0.0, float("inf"))
    ]


def test_rules_at_one_place_stand_one_upon_the_other():
    wide = Trapezoid(-8, -7, 7, 8)
    made = book(
        {"x": {"wide": wide}, "y": {"wide": wide}},
        {"k": Singleton(4), "l": Singleton(4)},
        (rule(1, Is("x", "wide"), "k"), rule(2, Is("y", "wide"), "l", 0.5)),
        Methods(implication="prod", aggregation="sum"),
    )
    pieces = explain(made, told(0, 0), "u").attribution.pieces
    assert [piece.outline[:2] for piece in pieces] == [((4, 0), (4, 1)), ((4, 1), (4, 1.5))]


@pytest.mark.parametrize("methods", [Methods(aggregation="sum"), Methods(conjunction="prod")])
def test_sums_of_terms_with_an_area_are_still_refused(methods):
    wide = Trapezoid(-8, -7, 7, 8)
    made = book({"x": {"wide": wide}}, {"k": wide}, (rule(1, Is("x", "wide"), "k"),), methods)
    with pytest.raises(InputError, match="or a Sugeno system"):
        explain(made, {"x": 0}, "u")
