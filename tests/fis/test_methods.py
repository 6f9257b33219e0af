"""Every choice of operators and of defuzzification: laws, and samples as a second opinion."""

import math
from itertools import product

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from comity_fis import InputError, explain, load_rulebook
from comity_fis.defuzzification import reference
from comity_fis.defuzzification.output_set import Layer, OutputSet
from comity_fis.errors import WrongValueError
from comity_fis.inference.rough import RoughNumber
from comity_fis.membership.arrays import degrees as degrees_of_numbers
from comity_fis.membership.curved import Gaussian, SShape
from comity_fis.membership.function import Complement, Trapezoid
from comity_fis.membership.interval import Interval
from comity_fis.rules import antecedent
from comity_fis.rules.antecedent import Literal, logic_of
from comity_fis.rules.methods import CHOICES, DUAL, OPERATORS, Methods, combined
from comity_fis.rules.rule import And, Is, Not, Or

LOW, HIGH = -4.0, 6.0
places = st.floats(LOW - 1, HIGH + 1).map(lambda x: round(x, 6))
degrees = st.floats(0.01, 1)
every = [
    Methods(implication=imp, aggregation=agg, defuzzification=defuzz)
    for imp, agg, defuzz in product(*(CHOICES[c] for c in ("implication", "aggregation", "defuzzification")))
]


@st.composite
def trapezoids(draw):
    a, b, c, d = sorted(draw(st.lists(places, min_size=4, max_size=4)))
    b, c = draw(st.sampled_from([(b, c), (a, c), (b, d), (b, b)]))
    term = Trapezoid(a, b, max(b, c), d) if d - a > 0.2 else Trapezoid(a, a, a + 1, a + 2)
    assume(term.height(LOW, HIGH) > 0.05)
    return term


curved = st.builds(Gaussian, st.floats(0.2, 3), st.floats(LOW, HIGH)) | st.builds(
    lambda foot, width: SShape(foot, foot + width), st.floats(LOW, 2), st.floats(0.5, 4)
)
straight_sets = st.lists(st.builds(Layer, trapezoids(), degrees), min_size=1, max_size=4)
mixed_sets = st.lists(
    st.builds(Layer, trapezoids() | curved | trapezoids().map(Complement), degrees),
    min_size=1,
    max_size=3,
)


def output_set(concluded, methods):
    return OutputSet(Interval(LOW, HIGH), tuple(concluded), methods)


@settings(max_examples=40, deadline=None)
@given(mixed_sets, st.sampled_from(every))
def test_values_lie_in_the_domain_and_desirability_between_0_and_1(concluded, methods):
    found = output_set(concluded, methods)
    for value in (found.value(), found.value_from_samples()):
        assert value is None or LOW <= value <= HIGH
    height = found.height(LOW, HIGH)
    for x in np.linspace(LOW - 1, HIGH + 1, 25).tolist():
        assert 0 <= found(x) <= height + 1e-9


@given(st.sampled_from(["min", "max", "prod", "probor", "sum"]), st.permutations([0.1, 0.2, 0.3, 0.7, 1 / 3]))
def test_the_order_of_conditions_does_not_matter_to_the_last_digit(method, degrees):
    assert combined(method, degrees) == combined(method, degrees[::-1])


@settings(max_examples=40, deadline=None)
@given(mixed_sets, st.sampled_from(every))
def test_the_order_of_rules_does_not_matter(concluded, methods):
    """The place of a smooth peak is known to the root of what rounding does to its height."""
    forward = output_set(concluded, methods).value()
    backward = output_set(concluded[::-1], methods).value()
    assert forward == pytest.approx(backward, abs=1e-5) if forward is not None else backward is None


@settings(max_examples=30, deadline=None)
@given(mixed_sets, st.sampled_from([m for m in every if m.defuzzification == "centroid"]))
def test_the_exact_centre_of_area_is_where_many_samples_have_it(concluded, methods):
    found = output_set(concluded, methods)
    xs = (np.arange(20_000) + 0.5) / 20_000 * (HIGH - LOW) + LOW
    weights = np.array([found.degree(x) for x in xs.tolist()])
    assume(weights.mean() > 1e-3)
    assert found.value() == pytest.approx(float((xs * weights).sum() / weights.sum()), abs=2e-3)


@settings(max_examples=30, deadline=None)
@given(mixed_sets, st.sampled_from([m for m in every if m.defuzzification == "bisector"]))
def test_the_bisector_has_half_of_the_area_on_either_side(concluded, methods):
    found = output_set(concluded, methods)
    xs = (np.arange(20_000) + 0.5) / 20_000 * (HIGH - LOW) + LOW
    weights = np.array([found.degree(x) for x in xs.tolist()])
    assume(weights.mean() > 1e-3)
    a_sample = 2 * weights.max()
    assert weights[xs < found.value()].sum() == pytest.approx(weights.sum() / 2, rel=2e-3, abs=a_sample)


@settings(max_examples=60, deadline=None)
@given(mixed_sets, st.sampled_from([m for m in every if m.defuzzification in {"som", "lom"}]))
def test_som_and_lom_are_places_of_the_largest_degree(concluded, methods):
    found = output_set(concluded, methods)
    value = found.value()
    top = max(found.degree(x) for x in np.linspace(LOW, HIGH, 2001).tolist())
    if value is None:  # no area
        assert top < 1e-8
        return
    around = (value, value - 1e-9, value + 1e-9)  # a vertical edge may stand there
    assert max(found.degree(x) for x in around) >= top - 1e-8


def test_the_maxima_of_a_plateau_as_matlab_has_them():
    """MATLAB's own example of a plateau from -8 to -2: by magnitude, som is -2 and lom is -8."""
    plateau = Layer(Trapezoid(-10, -8, -2, 2), 0.9), Layer(Trapezoid(2, 3, 8, 9), 0.1)
    values = {}
    for method in CHOICES["defuzzification"]:
        found = OutputSet(Interval(-10, 10), plateau, Methods(implication="prod", defuzzification=method))
        values[method] = found.value()
        assert found.value_from_samples(201) == pytest.approx(found.value(), abs=0.11)
    assert (values["mom"], values["som"], values["lom"]) == pytest.approx((-5, -2, -8))


def test_a_cut_curve_has_its_plateau_where_it_is_cut():
    edge = 2 * math.sqrt(2 * math.log(2))
    for method, expected in (("mom", 1), ("som", max(0, 1 - edge)), ("lom", 1 + edge)):
        found = output_set([Layer(Gaussian(2, 1), 0.5)], Methods(defuzzification=method))
        assert found.value() == pytest.approx(expected, abs=1e-6)


def test_two_equal_boxes_are_halved_at_the_end_of_the_first():
    boxes = [Layer(Trapezoid(-3, -3, -1, -1), 1), Layer(Trapezoid(2, 2, 4, 4), 1)]
    assert output_set(boxes, Methods(defuzzification="bisector")).value() == pytest.approx(-1)


def test_sum_is_not_cut_off_at_1_but_desirability_is():
    twice = [Layer(Trapezoid(0, 0, 2, 2), 0.8)] * 2
    found = output_set(twice, Methods(aggregation="sum"))
    assert found.degree(1) == pytest.approx(1.6)
    assert found(1) == 1


@settings(max_examples=20, deadline=None)
@given(straight_sets, st.sampled_from([m for m in every if m.defuzzification == "centroid"]))
def test_scikit_fuzzy_comes_near(concluded, methods):
    found = output_set(concluded, methods)
    assume(sum(found.degree(x) for x in np.linspace(LOW, HIGH, 200).tolist()) > 4)
    assert reference.value(found) == pytest.approx(found.value(), abs=0.02)


@given(st.lists(st.floats(0, 1), min_size=1, max_size=5), st.sampled_from(sorted(DUAL)))
def test_de_morgan(values, method):
    assert 1 - combined(method, values) == pytest.approx(combined(DUAL[method], [1 - v for v in values]))


@given(st.floats(0, 1), st.floats(0, 1), st.sampled_from(["min", "prod"]), st.sampled_from(["max", "probor"]))
def test_not_means_one_minus_whatever_stands_in_brackets(a, b, conjunction, disjunction):
    methods = Methods(conjunction=conjunction, disjunction=disjunction)
    parts = Is("a", "t"), Not(Is("b", "t"))
    for condition in (And(parts), Or(parts)):
        whole, opposite = (strength(c, {"a": a, "b": b}, methods) for c in (condition, Not(condition)))
        assert opposite == pytest.approx(1 - whole)


def strength(condition, known, methods):
    def degree(literal):
        return antecedent.hedged(known[literal.name], literal)

    return antecedent.strength(condition, degree, logic_of(methods, OPERATORS))


def test_an_unknown_method_cannot_be_built():
    with pytest.raises(WrongValueError, match="conjunction to be one of min, prod"):
        Methods(conjunction="lukasiewicz")


def test_a_yaml_rulebook_chooses_its_methods_weights_and_shapes(write):
    chosen = "methods: {conjunction: prod, aggregation: sum, defuzzification: bisector}\nrules:\n  -"
    path = write(
        ("rules:\n  -", chosen),
        ("near: {trapezoid: [0, 0, 1, 2]}", "near: {gaussmf: [0.5, 1]}"),
        ("middle: {trapezoid: [1, 2, 2, 3]}", "middle: {complement: {pimf: [0, 1, 3, 4]}}"),
        ("near, sources: [book], evidence: weak}", "near, sources: [book], evidence: weak, weight: 0.5}"),
    )
    rulebook = load_rulebook(path)
    assert rulebook.methods == Methods(conjunction="prod", aggregation="sum", defuzzification="bisector")
    (only,) = rulebook.infer({"warmth": 10, "mood": "calm"})["distance"].fired
    assert only.strength == 0.5
    assert rulebook.infer({"warmth": 10, "mood": "calm"})["distance"].number == pytest.approx(1, abs=0.05)


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("rules:\n  -", "methods: {conjunction: mean}\nrules:\n  -", "conjunction"),
        ("rules:\n  -", "methods: {and: min}\nrules:\n  -", "'and'"),
        ("near: {trapezoid: [0, 0, 1, 2]}", "near: {gaussmf: [0, 1]}", "gaussmf with a sigma that is not 0"),
        ("near: {trapezoid: [0, 0, 1, 2]}", "near: {gaussmf: [1]}", "gaussmf"),
        ("near: {trapezoid: [0, 0, 1, 2]}", "near: {gausmf: [1, 1]}", "Did you mean 'gaussmf'?"),
        ("near: {trapezoid: [0, 0, 1, 2]}", "near: {smf: [0, 1], zmf: [0, 1]}", "one shape"),
        ("evidence: weak}", "evidence: weak, weight: 0}", "weight"),
        ("evidence: weak}", "evidence: weak, weight: 1.5}", "weight"),
    ],
)
def test_a_mistake_in_yaml_is_refused(write, old, new, message):
    with pytest.raises(Exception, match=message.replace("?", r"\?")) as refusal:
        load_rulebook(write((old, new)))
    assert type(refusal.value).__name__ == "InputError"


others = (
    "methods: {conjunction: prod, disjunction: probor, aggregation: sum, defuzzification: lom}\nrules:\n  -"
)


def test_columns_of_people_are_each_of_them_under_any_methods(write):
    rulebook = load_rulebook(write(("rules:\n  -", others)))
    people = [(10, "calm"), (None, "lively"), (3.5, None), (None, None), (7, "lively")]
    answers = rulebook.infer_many(
        {"warmth": [math.nan if w is None else w for w, _ in people], "mood": [mood for _, mood in people]}
    )
    for row, (warmth, mood) in enumerate(people):
        alone = rulebook.infer({"warmth": warmth, "mood": mood})
        assert {name: values[row] for name, values in answers.items()} == {
            name: alone[name].value for name in rulebook.parameters
        }
        assert {name: rulebook.value(name, {"warmth": warmth, "mood": mood}) for name in answers} == {
            name: alone[name].value for name in rulebook.parameters
        }


def test_an_explanation_refuses_other_methods_and_names_them(write):
    rulebook = load_rulebook(write(("rules:\n  -", others)))
    with pytest.raises(InputError, match=r"conjunction prod, .*defuzzification lom"):
        explain(rulebook, {"warmth": 10}, "distance")


@settings(max_examples=30, deadline=None)
@given(curved | curved.map(Complement), st.lists(st.floats(LOW, HIGH), min_size=2, max_size=5, unique=True))
def test_curves_serve_columns_and_rough_inputs(term, xs):
    assert degrees_of_numbers(term, np.array(xs)) == pytest.approx([term(x) for x in xs], abs=1e-15)
    low, high = min(xs), max(xs)
    assume(high - low > 1e-3)
    rough = RoughNumber(Interval(low, high), low, high)
    assert rough.possibility(term, Literal("x", "t")) == pytest.approx(term.height(low, high), abs=1e-9)
