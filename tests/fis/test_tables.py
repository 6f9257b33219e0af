"""People as numpy's and pandas' tables have them, and facts that follow from others: one answer."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import comity
from comity_fis import InputError, explain, individualism_scores, load_rulebook

pandas = pytest.importorskip("pandas")

scores, genders = st.none() | st.integers(0, 100), st.sampled_from([None, "female", "male"])
people = st.lists(st.tuples(scores, genders), min_size=1, max_size=6)

NUMBERS = {
    "int": int,
    "float": float,
    "np.int64": np.int64,
    "np.uint8": np.uint8,
    "np.float32": np.float32,
    "0-d array": lambda x: np.array(float(x)),
    "0-d of whole numbers": np.array,
}
WORDS = {"str": str, "np.str_": np.str_, "0-d array": np.array}
NOTHING = [
    None,
    math.nan,
    np.nan,
    np.float32("nan"),
    np.array(np.nan),
    np.ma.masked,
    np.datetime64("NaT"),
    pandas.NA,
    pandas.NaT,
]
NUMBER_COLUMNS = ["float64", "float32", "Int64", "Float64", "object"]
WORD_COLUMNS = ["object", "string", "category", "str"]


@given(st.integers(0, 100), st.sampled_from(["female", "male"]), st.sampled_from([*NUMBERS]), st.data())
def test_a_scalar_of_numpy_is_the_number_or_the_word_in_it(case2, score, gender, kind, data):
    wrapped = {
        "individualism": NUMBERS[kind](score),
        "gender": WORDS[data.draw(st.sampled_from([*WORDS]))](gender),
    }
    told = case2.infer(wrapped)
    assert told.as_json() == case2.infer({"individualism": score, "gender": gender}).as_json()


@pytest.mark.parametrize("nothing", NOTHING, ids=repr)
def test_whatever_is_missing_was_not_disclosed(case2, nothing):
    for name in ("individualism", "gender"):
        given_one = {"individualism": 38, "gender": "female"}
        told = case2.infer({**given_one, name: nothing})
        assert told.inputs[name] is None
        assert told.as_json() == case2.infer({**given_one, name: None}).as_json()
        column = {key: [value, value] for key, value in given_one.items()} | {
            name: [nothing, given_one[name]]
        }
        values = case2.infer_many(column)["conversational_distance"]
        assert values.tolist() == pytest.approx(
            [told["conversational_distance"].number, case2.value("conversational_distance", given_one)]
        )


@settings(deadline=None)
@given(people, st.sampled_from(NUMBER_COLUMNS), st.sampled_from(WORD_COLUMNS))
def test_a_data_frame_of_any_types_is_its_people_one_by_one(case2, people, numbers, words):
    frame = pandas.DataFrame(
        {
            "individualism": pandas.array([score for score, _ in people], dtype=numbers),
            "gender": pandas.array([gender for _, gender in people], dtype=words),
        }
    )
    answers = case2.infer_many(frame)
    for row, (score, gender) in enumerate(people):
        alone = case2.infer({"individualism": score, "gender": gender})["conversational_distance"]
        assert answers["conversational_distance"][row] == pytest.approx(alone.number, abs=1e-12)
        assert answers.neutral["conversational_distance"][row] == (alone.origin == "neutral")
        by_row = case2.infer(frame.iloc[row])["conversational_distance"].number
        assert by_row == case2.infer(frame.to_dict("records")[row])["conversational_distance"].number
        assert by_row == alone.number
    assert pandas.DataFrame(answers).shape == (len(people), 1)


@given(people)
def test_a_masked_place_was_not_disclosed(case2, people):
    told = np.ma.array([score or 0 for score, _ in people], mask=[score is None for score, _ in people])
    plain = [math.nan if score is None else score for score, _ in people]
    answers, expected = (
        case2.infer_many({"individualism": column})["conversational_distance"] for column in (told, plain)
    )
    assert answers.tolist() == expected.tolist()


@given(people)
def test_the_rows_for_which_nothing_is_known_are_told(bruno2017, people):
    answers = bruno2017.infer_many(
        {"individualism": [score for score, _ in people], "gender": [gender for _, gender in people]}
    )
    assert answers.neutral.keys() == answers.keys()
    for name, neutral in answers.neutral.items():
        alone = [bruno2017.infer({"individualism": s, "gender": g})[name].origin for s, g in people]
        assert neutral.tolist() == [origin == "neutral" for origin in alone]


def test_other_columns_are_ignored_with_a_note_that_names_a_typo(case2):
    columns = {"individualism": [38.0], "gender": ["female"]}
    answers = case2.infer_many({**columns, "id": [7], "gendr": ["male"], 3: [1]})
    assert (
        answers["conversational_distance"].tolist()
        == case2.infer_many(columns)["conversational_distance"].tolist()
    )
    assert case2.infer_many(columns).notes == ()
    by_column = dict(zip(["id", "gendr", "3"], answers.notes, strict=True))
    assert all(column in note for column, note in by_column.items())
    assert "'gender'" in by_column["gendr"]


JUNK = [
    *(True, "38", b"38", 10**400, 1e308, math.inf, complex(1, 1), object(), lambda: 1, (), [], {}, set()),
    *((1, 2, 3), [[1]], {"a": 1}, range(3), iter("ab"), np.arange(4), np.eye(2), np.array("x"), type),
    *(np.timedelta64(1, "s"), pandas.Series([1, 2]), pandas.DataFrame({"a": [1]}), pandas.Timestamp(0)),
]


@pytest.mark.parametrize("junk", JUNK, ids=lambda junk: type(junk).__name__)
def test_a_wrong_type_ends_in_a_message_of_one_line(bruno2017, junk):
    calls = [
        lambda: bruno2017.infer(junk),
        lambda: bruno2017.infer({junk: 1} if getattr(type(junk), "__hash__", None) else [junk]),
        lambda: bruno2017.infer({}, mode=junk),
        lambda: bruno2017.infer({}, settings=junk),
        lambda: bruno2017.infer({}, learnt=junk),
        lambda: bruno2017.infer_many(junk),
        lambda: bruno2017.value(junk, {}),
        lambda: bruno2017.with_rule(junk, "if gender is male then approach_speed is slow"),
        lambda: bruno2017.with_rule(1, junk),
        lambda: load_rulebook(junk),
        *(
            call
            for name in ("individualism", "gender", "culture", "age")
            for call in (
                lambda name=name: bruno2017.infer({name: junk}),
                lambda name=name: bruno2017.infer_many({name: junk}),
                lambda name=name: bruno2017.infer_many({name: [junk, junk]}),
                lambda name=name: bruno2017.infer({}, learnt={name: junk}),
            )
        ),
        *(
            lambda name=name: bruno2017.infer({}, settings={name: junk})
            for name in ("conversational_distance", "greeting_gesture", "x")
        ),
    ]
    for call in calls:
        message = ""
        try:
            call()
        except InputError as refusal:
            message = str(refusal)
        assert "\n" not in message
        assert len(message) < 600


@pytest.mark.parametrize("rulebook", ["bruno2017", "bruno2017-case1", "bruno2017-case2", "evidence"])
def test_whoever_names_a_culture_has_its_score_by_every_door(rulebook):
    rules = load_rulebook(rulebook)
    distance = "conversational_distance"
    rows = individualism_scores()
    cultures = [row.key for row in rows]
    told = [
        {"individualism": row.value} | ({"culture": row.key} if "culture" in rules.variables else {})
        for row in rows
    ]
    expected = [rules.value(distance, facts) for facts in told]
    assert [rules.value(distance, {"culture": culture}) for culture in cultures] == expected
    assert [rules.infer({"culture": culture})[distance].number for culture in cultures] == expected
    assert [explain(rules, {"culture": culture}, distance).value.number for culture in cultures] == expected
    assert rules.infer_many({"culture": cultures})[distance].tolist() == pytest.approx(expected, abs=1e-12)
    by_comity = [comity.infer(culture=c, rulebook=rulebook)[distance].number for c in cultures[:10]]
    assert by_comity == expected[:10]


def test_a_fact_that_is_told_itself_does_not_follow_from_another(case2):
    for told in (20, None):
        assert case2.infer({"culture": "DEU", "individualism": told}).inputs["individualism"] == told
    many = case2.infer_many({"culture": ["DEU", "DEU"], "individualism": [20, None]})
    assert many["conversational_distance"].tolist() == pytest.approx(
        case2.infer_many({"individualism": [20, None]})["conversational_distance"].tolist()
    )


def test_a_culture_without_a_score_is_told_and_nothing_is_guessed(case2):
    alone = case2.infer({"culture": "Iceland"})
    assert alone.inputs["individualism"] is None
    assert "Iceland has no score" in alone.notes[0]
    assert case2.infer_many({"culture": ["Iceland", "DEU", "Iceland"]}).notes == alone.notes
    assert "the score of Germany is 67" in case2.infer({"culture": "Germany"}).sources["individualism"]
    assert "Kurdish has no score" in case2.infer({"culture": "Kurdish"}).notes[0]
    with pytest.raises(InputError, match="'JPM' in row 1"):
        case2.infer_many({"culture": ["DEU", "JPM"]})


@given(st.lists(st.none() | st.integers(1, 4), min_size=1, max_size=5))
def test_a_number_of_a_category_means_the_same_in_a_column_and_alone(people):
    rulebook = load_rulebook("illustrative-levels")
    ((name, variable),) = [
        (n, v) for n, v in rulebook.variables.items() if getattr(v, "numbered_from", None) == 0
    ]
    answers = rulebook.infer_many({name: [variable.first_number + n if n else None for n in people]})
    for row, number in enumerate(people):
        for parameter, value in rulebook.infer({name: number}).parameters.items():
            assert answers[parameter][row] == pytest.approx(value.value)
