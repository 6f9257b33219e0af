"""Many people at once: the same answers as one by one."""

import dataclasses
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from comity_fis import InputError, NumericVariable, load_rulebook, shipped_rulebooks
from comity_fis.inference.columns import CHUNK
from comity_fis.membership.curved import Gaussian
from comity_fis.membership.function import Bump, Trapezoid, TwoTermGaussian
from comity_fis.rules.methods import CHOICES, Methods

score = st.none() | st.floats(0, 100)
person = st.fixed_dictionaries(
    {
        "individualism": score,
        "gender": st.sampled_from([None, "female", "male", "woman", "F", "non-binary", "agender"]),
        "age": st.none() | st.floats(0, 117),
        "culture": st.sampled_from([None, "JPN", "Germany", "GBR", "Rwanda", "RWA", "Kurdish"]),
        "posture": st.sampled_from([None, "standing", "seated"]),
        "formality": st.sampled_from([None, "formal", "informal"]),
        "touch_consent": st.sampled_from([None, "given", "withheld"]),
    }
)


def columns_of(people):
    return {name: [person[name] for person in people] for name in people[0]}


def assert_one_by_one(rulebook, people, answers):
    for row, one in enumerate(people):
        alone = rulebook.infer(one)
        for name, value in alone.parameters.items():
            got = answers[name][row]
            assert got == (
                value.value if isinstance(value.value, str) else pytest.approx(value.value, abs=1e-12)
            )


@settings(deadline=None)
@given(st.lists(person, min_size=1, max_size=6))
def test_a_column_is_its_people_one_by_one(bruno2017, people):
    assert_one_by_one(bruno2017, people, bruno2017.infer_many(columns_of(people)))


def told_of(variable):
    """Any value of a variable, or none."""
    if isinstance(variable, NumericVariable):
        return st.none() | st.floats(*variable.domain.ends)
    return st.none() | st.sampled_from(variable.categories)


@settings(deadline=None, max_examples=25)
@pytest.mark.parametrize("name", shipped_rulebooks())
@given(st.data())
def test_so_it_is_with_every_shipped_rulebook(name, data):
    """Columns and one by one are two programs for the same rules."""
    rulebook = load_rulebook(name)
    person = st.fixed_dictionaries({name: told_of(variable) for name, variable in rulebook.variables.items()})
    people = data.draw(st.lists(person, min_size=1, max_size=5))
    answers = rulebook.infer_many(columns_of(people))
    for row, one in enumerate(people):
        alone = rulebook.infer(one)
        for parameter, value in alone.items():
            got = answers[parameter][row]
            assert got == (value.value if isinstance(got, str) else pytest.approx(value.value, abs=1e-9))
            assert answers.neutral[parameter][row] == (value.origin == "neutral")


@settings(deadline=None)
@given(
    st.lists(
        st.fixed_dictionaries(
            {"warmth": st.none() | st.floats(0, 10), "mood": st.sampled_from([None, "calm", "lively"])}
        ),
        min_size=1,
        max_size=6,
    ),
    st.floats(0.1, 1),
)
def test_so_is_a_parameter_that_reads_another_and_a_weighted_rule(small, people, weight):
    weighted = small.with_rule(1, dataclasses.replace(small.rules[0], weight=weight)).with_rule(
        6, "if distance is not very away or mood is more or less lively then volume is loud"
    )
    for rulebook in (small, weighted):
        assert_one_by_one(rulebook, people, rulebook.infer_many(columns_of(people)))


@settings(deadline=None, max_examples=20)
@given(st.lists(st.fixed_dictionaries({"warmth": st.floats(0, 10)}), min_size=1, max_size=4))
def test_so_is_a_parameter_without_a_closed_form(small, people):
    distance = small.parameters["distance"]
    curved = TwoTermGaussian(Bump(1, 1, 0.5), Bump(0, 1, 1))
    nested = Trapezoid(0.2, 0.3, 3.8, 3.9)
    for term in (curved, nested):
        rulebook = dataclasses.replace(
            small,
            parameters={
                **small.parameters,
                "distance": dataclasses.replace(distance, terms={**distance.terms, "near": term}),
            },
        )
        assert rulebook.program.blocks["distance"].form is None
        assert_one_by_one(rulebook, people, rulebook.infer_many(columns_of(people)))


@settings(deadline=None, max_examples=60)
@given(
    st.lists(
        st.fixed_dictionaries(
            {"warmth": st.none() | st.floats(0, 10), "mood": st.sampled_from([None, "calm", "lively"])}
        ),
        min_size=1,
        max_size=4,
    ),
    st.builds(Methods, **{name: st.sampled_from(choices) for name, choices in CHOICES.items()}),
    st.booleans(),
)
def test_so_it_is_with_every_method_and_with_curves(wide, people, methods, curved):
    distance = wide.parameters["distance"]
    middle = {"middle": Gaussian(0.4, 2)} if curved else {}
    rulebook = dataclasses.replace(
        wide,
        methods=methods,
        parameters={
            **wide.parameters,
            "distance": dataclasses.replace(distance, terms={**distance.terms, **middle}),
        },
    )
    assert_one_by_one(rulebook, people, rulebook.infer_many(columns_of(people)))


def test_longer_than_a_chunk(case2):
    scores = np.linspace(0, 100, 2 * CHUNK + 3)
    women = case2.infer_many({"individualism": scores, "gender": np.zeros(len(scores), dtype=int)})
    assert women["conversational_distance"].shape == scores.shape
    for row in (0, CHUNK - 1, CHUNK, 2 * CHUNK + 2):
        alone = case2.infer({"individualism": float(scores[row]), "gender": "female"})
        assert women["conversational_distance"][row] == pytest.approx(alone["conversational_distance"].number)


def test_categories_by_name_by_number_and_in_arrays_of_words(case2):
    scores = [38.0, 67.0, 38.0]
    by = [
        case2.infer_many({"individualism": scores, "gender": gender})["conversational_distance"]
        for gender in (
            ["female", "male", None],
            np.array([0, 1, -1]),
            np.array(["female", "male", None], dtype=object),
        )
    ]
    assert by[0].tolist() == by[1].tolist() == by[2].tolist()
    words = case2.infer_many({"individualism": scores[:2], "gender": np.array(["female", "male"])})
    assert words["conversational_distance"].tolist() == by[0].tolist()[:2]


def test_nobody_at_all_and_nothing_about_anybody(case2):
    assert case2.infer_many({})["conversational_distance"].shape == (0,)
    assert case2.infer_many({"individualism": []})["conversational_distance"].shape == (0,)
    unknown = case2.infer_many({"individualism": [None, float("nan")]})
    assert unknown["conversational_distance"].tolist() == [0.825, 0.825]


@pytest.mark.parametrize(
    ("columns", "message"),
    [
        ({"individualism": [38.0, 101.0]}, r"0\.\.100, got 101\.0 in row 1"),
        ({"individualism": [float("inf")]}, "row 0"),
        ({"individualism": ["38"]}, "column of numbers"),
        ({"individualism": [[38.0]]}, "one dimension"),
        ({"individualism": 38.0}, "one dimension"),
        ({"individualism": [True]}, "column of numbers"),
        ({"individualism": [10**400]}, "column of numbers"),
        ({"gender": ["female", "femal"]}, "'femal' in row 1.*Did you mean 'female'"),
        ({"gender": [0, 2]}, "got 2 in row 1"),
        ({"gender": [[]]}, "one dimension"),
        ({"gender": [0.5]}, "categories, or their numbers"),
        ({"gender": [("female",)]}, "one dimension"),
        ({"gendre": ["female"]}, "Did you mean 'gender'"),
        ({"individualism": [1.0, 2.0], "gender": ["female"]}, "columns of one length"),
    ],
)
def test_what_is_no_column_is_refused(case2, columns, message):
    with pytest.raises(InputError, match=message):
        case2.infer_many(columns)


def test_threads_give_the_same_answers(bruno2017):
    rng = np.random.default_rng(1)
    parts = [
        {"individualism": rng.uniform(0, 100, 3000), "gender": rng.integers(-1, 2, 3000)} for _ in range(8)
    ]
    alone = [bruno2017.infer_many(part) for part in parts]
    with ThreadPoolExecutor(4) as pool:
        together = list(pool.map(bruno2017.infer_many, parts))
    for one, other in zip(alone, together, strict=True):
        for name, values in one.items():
            assert np.array_equal(values, other[name])


@given(st.floats(15, 80), st.floats(15, 80))
def test_more_individualism_never_means_less_distance_from_15_to_80(case2, one, other):
    low, high = sorted((one, other))
    for gender in (0, 1):  # undisclosed, the answer dips by a few micrometres at 15
        near, far = case2.infer_many({"individualism": [low, high], "gender": [gender] * 2})[
            "conversational_distance"
        ]
        assert near <= far + 1e-12


def test_beyond_that_it_does(case2):
    """The fitted curves fall off at both ends; the law above would not hold there."""
    curve = case2.infer_many({"individualism": np.linspace(0, 100, 1001), "gender": [0] * 1001})
    assert np.diff(curve["conversational_distance"]).min() < -1e-5


def test_the_shipped_distance_has_a_closed_form():
    assert load_rulebook("bruno2017-case2").program.blocks["conversational_distance"].form is not None
