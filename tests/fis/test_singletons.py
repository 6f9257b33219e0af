"""Singletons: the constants of Sugeno systems of order 0, and single values as terms of an input."""

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from comity_fis import InputError, Interval, explain, load_rulebook
from comity_fis.matlab.reader import parse_fis
from comity_fis.matlab.writer import write_fis
from comity_fis.membership.function import Singleton, Trapezoid
from comity_fis.rulebook.rulebook import Rulebook
from comity_fis.rules.methods import Methods
from comity_fis.rules.rule import Is, Rule, Source
from comity_fis.variables.measurement import Level
from comity_fis.variables.parameter import NumericParameter
from comity_fis.variables.variable import NumericVariable

SOURCE = Source("book", "A book", "read")
SUGENO = Methods(implication="prod", aggregation="sum")
HOURS = {"few": Trapezoid(0, 0, 0, 8), "some": Trapezoid(4, 8, 8, 12), "many": Trapezoid(8, 24, 24, 24)}

places = st.lists(st.floats(-9, 9).map(lambda x: round(x, 3)), min_size=3, max_size=3, unique=True)
hours = st.floats(0, 24)
modes = st.sampled_from(["exact", "matlab", "skfuzzy"])


def made(terms, methods=SUGENO, rules=None, variables=HOURS):
    """Few, some and many hours give the terms in turn; or rules as pairs of an input and an output term."""
    hours = NumericVariable(
        name="hours", kind="situation", level=Level.INTERVAL, domain=Interval(0, 24), terms=variables,
        reason="made up",
    )  # fmt: skip
    domain = Interval(-10, 10)
    reasons = dict.fromkeys(("ranges", "terms", "neutral", "spread"), "made up")
    play = NumericParameter(
        name="play", kind="behaviour", unit="1", rules=domain, ask=domain, safe=domain, terms=terms,
        neutral=0.0, spread=1.0, reasons=reasons,
    )  # fmt: skip
    pairs = rules or list(zip(HOURS, terms, strict=True))
    return Rulebook(
        name="game", description="Made up.", variables={"hours": hours}, parameters={"play": play},
        rules=tuple(
            Rule(
                number=number, text=f"if hours is {said} then play is {term}", antecedent=Is("hours", said),
                consequents=(Is("play", term),), sources=(SOURCE,), evidence="weak",
            )
            for number, (said, term) in enumerate(pairs, 1)
        ),
        sources={"book": SOURCE}, methods=methods,
    )  # fmt: skip


def singletons(xs):
    return {f"at {x}": Singleton(x) for x in xs}


@given(places, hours, modes, st.sampled_from(["max", "probor", "sum"]), st.sampled_from(["min", "prod"]))
def test_constants_are_averaged_by_the_strengths_of_their_rules(xs, at, mode, aggregation, implication):
    rulebook = made(singletons(xs), Methods(implication=implication, aggregation=aggregation))
    weights = [term(at) for term in HOURS.values()]
    assume(sum(weights) > 0)
    expected = sum(w * x for w, x in zip(weights, xs, strict=True)) / sum(weights)
    assert rulebook.infer({"hours": at}, mode)["play"].number == pytest.approx(expected, abs=1e-12)
    assert rulebook.infer_many({"hours": [at]})["play"][0] == pytest.approx(expected, abs=1e-12)


@given(st.floats(-9, 9), st.floats(-9, 9), hours)
def test_rules_that_share_a_constant_add_up_under_sum_and_the_strongest_counts_under_max(x, y, at):
    few, some, many = (term(at) for term in HOURS.values())
    assume(x != y and few + some + many > 0)
    rules = [("few", f"at {x}"), ("some", f"at {x}"), ("many", f"at {y}")]
    for methods, weight in ((SUGENO, few + some), (Methods(), max(few, some))):
        rulebook = made(singletons([x, y]), methods, rules)
        expected = pytest.approx((weight * x + many * y) / (weight + many), abs=1e-12)
        assert rulebook.value("play", {"hours": at}) == expected
        assert rulebook.infer_many({"hours": [at]})["play"][0] == expected


@settings(deadline=None)
@given(places, hours, st.sampled_from(["max", "sum", "probor"]))
def test_singletons_are_what_equally_narrow_rectangles_become(xs, at, aggregation):
    assume(min(b - a for a, b in pairwise(sorted(xs))) > 1e-3)
    narrow = {f"at {x}": Trapezoid(x - 1e-7, x - 1e-7, x + 1e-7, x + 1e-7) for x in xs}
    methods = Methods(aggregation=aggregation)
    values = [made(t, methods).value("play", {"hours": at}) for t in (singletons(xs), narrow)]
    assert values[0] == pytest.approx(values[1], abs=1e-6)


@given(places, hours, st.sampled_from(["bisector", "mom", "som", "lom"]))
def test_other_methods_take_the_weighted_median_or_the_highest_places(xs, at, method):
    weights = {x: term(at) for x, term in zip(xs, HOURS.values(), strict=True)}
    top = max(weights.values())
    assume(top > 0)
    highest = [x for x in sorted(xs) if weights[x] >= top * (1 - 1e-9)]
    upto, half = 0.0, sum(weights.values()) / 2
    median = None
    for x in sorted(xs):
        upto += weights[x]
        if median is None and upto >= half * (1 - 1e-12):
            median = x
    expected = {
        "bisector": median,
        "mom": sum(highest) / len(highest),
        "som": min(highest, key=abs),
        "lom": max(highest, key=abs),
    }[method]
    rulebook = made(singletons(xs), Methods(defuzzification=method))
    assert rulebook.value("play", {"hours": at}) == pytest.approx(expected, abs=1e-9)
    assert rulebook.infer_many({"hours": [at]})["play"][0] == pytest.approx(expected, abs=1e-9)


@given(st.floats(-9, 9), st.floats(4.1, 11.9))
def test_beside_a_term_with_an_area_a_singleton_counts_for_nothing(x, at):
    wide = Trapezoid(-4, 0, 0, 8)
    alone = made({"wide": wide}, Methods(), [("some", "wide")])
    both = made({"wide": wide, "point": Singleton(x)}, Methods(), [("some", "wide"), ("few", "point")])
    assert both.value("play", {"hours": at}) == pytest.approx(alone.value("play", {"hours": at}), abs=1e-12)


def test_a_singleton_whose_rule_alone_fires_is_the_answer():
    rulebook = made(
        {"wide": Trapezoid(-4, 0, 0, 8), "point": Singleton(7)},
        Methods(),
        [("some", "wide"), ("few", "point")],
    )
    assert rulebook.value("play", {"hours": 2}) == 7
    assert rulebook.infer_many({"hours": [2.0]})["play"].tolist() == [7]


def test_a_term_that_meets_the_range_at_its_end_alone_is_that_end():
    edge = {"left": Trapezoid(-30, -10, -10, -10), "wide": Trapezoid(0, 4, 4, 8)}
    rulebook = made(edge, Methods(), [("few", "left"), ("many", "wide")])
    assert rulebook.value("play", {"hours": 2}) == -10
    assert rulebook.infer_many({"hours": [2.0, 20.0]})["play"] == pytest.approx([-10, 4])


def test_the_desirability_of_constants_is_a_line_at_each():
    curve = made(singletons([-5.0, 0.5, 5.0]), Methods()).infer({"hours": 6})["play"].desirability
    assert (curve(-5.0), curve(0.5), curve(0.4)) == (0.25, 0.5, 0)
    assert curve.height(0, 1) == 0.5
    assert (-5.0, 0.25) in curve.outline
    assert (0.5, 0.5) in curve.outline


@given(places, st.floats(0.1, 23.9).filter(lambda at: min(abs(at - k) for k in (4, 8, 12)) > 1e-3))
def test_contributions_add_up_and_the_derivative_is_that_of_the_values(xs, at):
    rulebook = made(singletons(xs), Methods())
    account = explain(rulebook, {"hours": at}, "play")
    assert sum(rule.contribution for rule in account.rules) == pytest.approx(account.value.number, abs=1e-9)
    assert sum(rule.share for rule in account.rules) == pytest.approx(1)
    step = 1e-6
    above, below = (rulebook.value("play", {"hours": at + sign * step}) for sign in (1, -1))
    (one,) = account.sensitivities
    assert one.derivative == pytest.approx((above - below) / (2 * step), rel=1e-3, abs=1e-5)


def test_a_single_value_as_an_input_term_holds_there_and_nowhere_else():
    rulebook = made(singletons([5.0]), SUGENO, [("noon", "at 5.0")], {"noon": Singleton(12.0)})
    assert rulebook.infer_many({"hours": [12.0, 12.5]}).neutral["play"].tolist() == [False, True]
    assert rulebook.infer({"hours": Interval(11, 13)})["play"].number == 5


@settings(max_examples=30, deadline=None)
@given(places, st.sampled_from([SUGENO, Methods(), Methods(aggregation="sum", defuzzification="mom")]))
def test_a_fis_file_of_constants_reads_back_with_the_same_answers(xs, methods):
    rulebook = made(singletons(xs), methods)
    text = write_fis(rulebook).text
    assert ("Type='sugeno'" in text) == (methods == SUGENO)
    back = parse_fis(text, "game.fis")
    columns = {"hours": np.linspace(0, 24, 25)}
    assert back.infer_many(columns)["play"] == pytest.approx(rulebook.infer_many(columns)["play"], abs=1e-12)


def test_constants_between_matlabs_101_places_are_told():
    changed = write_fis(made(singletons([0.2, 1.234, 3.0]), Methods())).changed
    assert [note for note in changed if "misses" in note] == [
        "play is at 1.234: MATLAB looks at 101 places of the range, and misses 1.234"
    ]


def test_yaml_has_singletons_and_says_so_where_a_trapezoid_has_no_width(write):
    path = write(("near: {trapezoid: [0, 0, 1, 2]}", "near: {singleton: 1.5}"))
    assert load_rulebook(path).parameters["distance"].terms["near"] == Singleton(1.5)
    path = write(("near: {trapezoid: [0, 0, 1, 2]}", "near: {trapezoid: [1, 1, 1, 1]}"))
    with pytest.raises(InputError, match="singleton: 1"):
        load_rulebook(path)
