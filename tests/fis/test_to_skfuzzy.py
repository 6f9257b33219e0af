"""`Rulebook.to_skfuzzy`: the same answers from `skfuzzy.control`, or a refusal that says why."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from skfuzzy import control

from comity_fis import HEDGES, InputError, Interval, Level, NumericVariable, Source, load_rulebook
from comity_fis.membership.curved import CURVED
from comity_fis.membership.function import Bump, Complement, Singleton, Trapezoid, TwoTermGaussian
from comity_fis.rulebook.rulebook import Rulebook
from comity_fis.rules.methods import Methods
from comity_fis.rules.rule import And, Hedged, Is, Not, Or, Rule
from comity_fis.variables.parameter import NumericParameter

DATA = Path(__file__).parent / "data"
SOURCE = Source("book", "A book", "read")
LOW, HIGH = -8, 8
corner = st.integers(-20, 20).map(lambda halves: halves / 2)
"""Corners lie on halves and inputs on sixty-fourths: an input is at a vertical edge, or well beside it."""
value = st.integers(LOW * 64, HIGH * 64).map(lambda steps: steps / 64)
width = st.floats(1, 4)


@st.composite
def trapezoids(draw):
    a, b, c, d = sorted(draw(st.lists(corner, min_size=4, max_size=4)))
    assume(d - a >= 0.5)
    return Trapezoid(a, b, c, d)


@st.composite
def curves(draw):
    centre, size, other = draw(corner), draw(width), draw(width)
    return draw(
        st.sampled_from(
            [
                CURVED["gaussmf"](size, centre),
                CURVED["gauss2mf"](size, centre, other, centre + 2),
                CURVED["gbellmf"](size, 1.5, centre),
                CURVED["sigmf"](size, centre),
                CURVED["smf"](centre, centre + size),
                TwoTermGaussian(Bump(0.9, centre, size), Bump(0.5, centre + size, other)),
            ]
        )
    )


shapes = st.one_of(trapezoids(), curves(), curves().map(Complement))
LEAST_AREA = 0.25
"""In the range: of a sliver beside it, a grid has too few points for an area."""


def has_area(term):
    xs = np.linspace(LOW, HIGH, 401)
    return np.trapezoid([term(float(x)) for x in xs], xs) >= LEAST_AREA


@st.composite
def conditions(draw, terms):
    """A term of x or y, perhaps hedged or negated, or several of them in brackets."""
    leaf = st.builds(Is, st.sampled_from(["x", "y"]), st.sampled_from(terms))
    leaf = st.one_of(leaf, st.builds(Hedged, st.sampled_from(sorted(HEDGES)), leaf))
    several = st.builds(
        lambda kind, parts: kind(tuple(parts)),
        st.sampled_from([And, Or]),
        st.lists(st.one_of(leaf, leaf.map(Not)), min_size=2, max_size=3),
    )
    return draw(st.one_of(leaf, leaf.map(Not), several, several.map(Not)))


@st.composite
def rulebooks(draw, defuzzification="centroid"):
    names = ["low", "high"]

    def terms(of):
        return {name: draw(of) for name in names}

    rules = []
    outputs = ["u", "v"]
    for number in range(1, draw(st.integers(2, 5)) + 1):
        antecedent = draw(conditions(names))
        gives = (
            [outputs[number - 1]]
            if number <= 2
            else draw(st.lists(st.sampled_from(outputs), min_size=1, unique=True))
        )
        consequents = tuple(Is(name, draw(st.sampled_from(names))) for name in gives)
        rules.append(
            Rule(
                number=number,
                text=f"if {antecedent} then {consequents}",
                antecedent=antecedent,
                consequents=consequents,
                sources=(SOURCE,),
                evidence="weak",
                weight=draw(st.sampled_from([1.0, 0.5, 0.25])),
            )
        )
    methods = Methods(
        conjunction=draw(st.sampled_from(["min", "prod"])),
        disjunction=draw(st.sampled_from(["max", "probor"])),
        defuzzification=defuzzification,
    )
    return rulebook(
        {name: variable(name, terms(shapes)) for name in ("x", "y")},
        {name: parameter(name, terms(shapes.filter(has_area))) for name in outputs},
        tuple(rules),
        methods,
    )


def rulebook(variables, parameters, rules, methods):
    return Rulebook(
        name="made", description="Made up.", variables=variables, parameters=parameters, rules=rules,
        sources={"book": SOURCE}, methods=methods,
    )  # fmt: skip


def variable(name, terms):
    return NumericVariable(
        name=name, kind="situation", level=Level.INTERVAL, domain=Interval(LOW, HIGH), terms=terms,
        reason="made up",
    )  # fmt: skip


def parameter(name, terms):
    domain = Interval(LOW, HIGH)
    reasons = dict.fromkeys(("ranges", "terms", "neutral", "spread"), "made up")
    return NumericParameter(
        name=name, kind="behaviour", unit="1", rules=domain, ask=domain, safe=domain, terms=terms,
        neutral=0.0, spread=1.0, reasons=reasons,
    )  # fmt: skip


def computed(system, told):
    """The outputs of a fresh simulation: one that is used again may keep answers where no rule fires."""
    simulation = control.ControlSystemSimulation(system)
    read = {variable.label for variable in system.antecedents}
    simulation.inputs({name: number for name, number in told.items() if name in read})
    simulation.compute()
    return simulation.output


STRONG = 0.25
"""Where every rule is weaker, errors of the degrees are large beside the degrees themselves."""


def outputs(book, told, points):
    """Ours and theirs, of each output that some rule makes strong."""
    theirs = computed(book.to_skfuzzy(points), told)
    for name, ours in book.infer(told).parameters.items():
        strongest = max((fired.strength for fired in ours.fired), default=0.0)
        if strongest >= STRONG and ours.decided_by_rules:
            yield ours, theirs[name]


@settings(deadline=None)
@given(rulebooks(), value, value)
def test_the_answer_is_the_same_but_for_the_error_of_the_grid(book, x, y):
    for ours, theirs in outputs(book, {"x": x, "y": y}, 801):
        assert theirs == pytest.approx(ours.number, abs=0.005 * (HIGH - LOW))


@settings(deadline=None, max_examples=40)
@given(rulebooks(defuzzification="bisector"), value, value)
def test_a_bisector_halves_the_area_there_too(book, x, y):
    """It may stand anywhere in a gap between two halves, so that the halves are compared, not the places."""
    xs = np.linspace(LOW, HIGH, 4001)
    for ours, theirs in outputs(book, {"x": x, "y": y}, 801):
        if not LOW <= theirs <= HIGH:
            continue  # where its area ends in a degree of almost 0, scikit-fuzzy divides by that
        heights = np.array([ours.desirability(float(x)) for x in xs])
        left = np.trapezoid(np.where(xs <= theirs, heights, 0), xs) / np.trapezoid(heights, xs)
        assert left == pytest.approx(0.5, abs=0.05)


@pytest.mark.parametrize("individualism", range(0, 101, 10))
def test_the_papers_first_case_gives_the_same_distance(individualism):
    book, told = load_rulebook("bruno2017-case1"), {"individualism": individualism}
    ours = book.infer(told)["conversational_distance"].number
    assert computed(book.to_skfuzzy(), told)["conversational_distance"] == pytest.approx(ours, abs=1e-4)


@given(st.integers(0, 20), st.integers(0, 20))
def test_a_matlab_file_gives_the_same_answers(service, food):
    told = {"service": service / 2, "food": food / 2}
    theirs = computed(TIPPING.to_skfuzzy(), told)
    for name, ours in TIPPING.infer(told).parameters.items():
        assert theirs[name] == pytest.approx(ours.number, abs=0.02)


TIPPING = load_rulebook(DATA / "tipping.fis")


def test_where_no_rule_fires_there_is_no_output(plain):
    assert computed(plain.to_skfuzzy(), {"x": 7}) == {}
    assert plain.infer({"x": 7})["u"].value == plain.parameters["u"].neutral


def test_hedged_terms_are_terms_of_their_own(plain):
    book = plain.with_rule(1, "if x is very low then u is low")
    (x,) = book.to_skfuzzy().antecedents
    assert list(x.terms) == ["low", "very low"]


def test_rules_that_are_off_are_left_out(plain):
    rule = replace(plain.rules[0], number=2, text="off", enabled=False)
    assert len(list(replace(plain, rules=(*plain.rules, rule)).to_skfuzzy().rules)) == 1


@pytest.fixture
def plain():
    """`if x is low then u is low`."""
    low = Trapezoid(-8, -8, -4, 0)
    rule = Rule(
        number=1, text="if x is low then u is low", antecedent=Is("x", "low"), consequents=(Is("u", "low"),),
        sources=(SOURCE,), evidence="weak",
    )  # fmt: skip
    return rulebook(
        {"x": variable("x", {"low": low})}, {"u": parameter("u", {"low": low})}, (rule,), Methods()
    )


@pytest.mark.parametrize(
    ("name", "reason"),
    [
        ("bruno2017-case2", "the words of gender"),
        ("bruno2017", "the words of gender"),
        ("evidence", "for skfuzzy.control"),
    ],
)
def test_a_rulebook_over_words_is_refused(name, reason):
    with pytest.raises(InputError, match=reason):
        load_rulebook(name).to_skfuzzy()


METHODS = {
    "implication": "prod",
    "aggregation": "sum",
    "defuzzification": "mom",
}


@pytest.mark.parametrize("field", METHODS)
def test_methods_without_a_counterpart_are_refused(plain, field):
    with pytest.raises(InputError, match=f"{field} by .* for skfuzzy.control, got {METHODS[field]}"):
        replace(plain, methods=Methods(**{field: METHODS[field]})).to_skfuzzy()


def test_singletons_are_refused(plain):
    book = replace(plain, parameters={"u": parameter("u", {"low": Singleton(1)})})
    with pytest.raises(InputError, match="the singleton low of u"):
        book.to_skfuzzy()


def test_an_output_without_a_rule_is_refused(plain):
    book = replace(plain, parameters={**plain.parameters, "v": parameter("v", plain.parameters["u"].terms)})
    with pytest.raises(InputError, match="a rule that concludes v"):
        book.to_skfuzzy()


def test_rules_that_read_a_parameter_are_refused(plain):
    rule = replace(plain.rules[0], number=2, antecedent=Is("u", "low"), consequents=(Is("v", "low"),))
    parameters = {**plain.parameters, "v": parameter("v", plain.parameters["u"].terms)}
    book = replace(plain, parameters=parameters, rules=(*plain.rules, rule))
    with pytest.raises(InputError, match="the parameter u"):
        book.to_skfuzzy()


@pytest.mark.parametrize("points", [0, 10, 100_002, True, 101.0, "many", None])
def test_a_grid_is_a_whole_number_of_points(plain, points):
    with pytest.raises(InputError, match="points"):
        plain.to_skfuzzy(points)
