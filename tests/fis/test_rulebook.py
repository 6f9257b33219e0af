"""What a rulebook does with what is known, unknown, asked for and unsafe."""

import dataclasses
import pickle
from concurrent.futures import ThreadPoolExecutor

import pytest
from hypothesis import given
from hypothesis import strategies as st

from comity_fis import InputError, Interval, NumericVariable, load_rulebook
from comity_fis.errors import WrongValueError
from comity_fis.membership.function import Trapezoid
from comity_fis.variables.measurement import Coercion, Level


def test_inputs_list_every_variable_in_declared_order(bruno2017):
    inference = bruno2017.infer({"gender": "female", "individualism": 38})
    assert list(inference.inputs)[:3] == ["individualism", "gender", "age"]
    assert inference.inputs["individualism"] == 38.0
    assert inference.inputs["age"] is None


def test_of_a_person_of_whom_nothing_is_known_everything_is_neutral(bruno2017):
    inference = bruno2017.infer({})
    for name, value in inference.parameters.items():
        assert (value.origin, value.fired) == ("neutral", ())
        assert value.value == bruno2017.parameters[name].neutral
        assert "nothing is known of" in value.note
    curve = inference["conversational_distance"].desirability
    assert [curve(x) for x in (0.44, 0.45, 0.8, 1.2, 1.21)] == [0, 1, 1, 1, 0]
    assert set(inference["greeting_gesture"].desirability.memberships.values()) == {1.0}
    assert "handshake" not in inference["greeting_gesture"].desirability.memberships


@given(st.sampled_from(["culture", "individualism", "gender", "age", "posture", "touch_consent"]))
def test_stating_that_nothing_is_known_says_no_more_than_silence(bruno2017, name):
    assert bruno2017.infer({name: None}) == bruno2017.infer({})


def test_no_rule_that_fires_leaves_the_neutral_value(write):
    rulebook = load_rulebook(write(("if warmth is cold then distance", "if mood is calm then distance")))
    value = rulebook.infer({"warmth": 0, "mood": None})["distance"]
    assert (value.number, value.origin) == (3.5, "neutral")
    value = load_rulebook(write(("trapezoid: [2, 6, 10, 10]", "trapezoid: [9, 10, 10, 10]"))).infer(
        {"warmth": 7, "mood": "calm"}
    )["distance"]
    assert (value.number, value.origin, value.note) == (3.5, "neutral", "no rule fires")


def test_a_value_comes_from_culture_or_from_the_situation(small):
    assert small.infer({"warmth": 9})["distance"].origin == "culture"
    assert small.infer({"mood": "lively"})["gesture"].origin == "situation"
    assert small.infer({"warmth": 0, "mood": "lively"})["gesture"].origin == "situation"


def test_contributions_add_up_to_the_value(small):
    for settings in ({}, {"distance": 7.5}, {"distance": 2}):
        value = small.infer({"warmth": 9}, settings=settings)["distance"]
        assert sum(part.value for part in value.contributions) == value.number


def test_a_setting_replaces_the_rules(small):
    value = small.infer({"warmth": 9}, settings={"distance": 5})["distance"]
    assert (value.number, value.origin, value.spread, value.fired) == (5.0, "setting", 0.0, ())
    assert value.desirability(5) == 1
    assert value.desirability(4.5) == value.desirability(5.5) == 0.5
    assert value.desirability(4) == 0


def test_safety_clamps_a_setting_and_says_so(small):
    value = small.infer({}, settings={"distance": 7.5})["distance"]
    assert (value.number, value.origin) == (6.0, "safety")
    assert [(part.origin, part.value) for part in value.contributions] == [("setting", 7.5), ("safety", -1.5)]
    assert "at most 6 m" in value.note
    assert value.desirability.domain == (0, 6)


@given(st.floats(0.1, 0.5))
def test_no_setting_makes_the_robot_unsafe(bruno2017, speed):
    inference = bruno2017.infer({}, settings={"approach_speed": speed, "conversational_distance": 0.45})
    assert inference["approach_speed"].number <= 0.5
    assert inference["conversational_distance"].number >= 0.30


@pytest.mark.parametrize(
    ("settings", "message"),
    [
        ({"conversational_distance": 3.5}, r"0\.45\.\.3 m, got 3\.5"),
        ({"conversational_distance": 0.2}, "got 0.2"),
        ({"conversational_distance": float("nan")}, "got nan"),
        ({"conversational_distance": "far"}, "got 'far'"),
        ({"conversational_distance": True}, "got True"),
        ({"greeting_gesture": "wawe"}, "Did you mean 'wave'"),
        ({"greeting_gesture": 3}, "categories, got 3"),
        ({"conversation_distance": 1}, "Did you mean 'conversational_distance'"),
    ],
)
def test_what_cannot_be_asked_for_is_refused(bruno2017, settings, message):
    with pytest.raises(InputError, match=message):
        bruno2017.infer({}, settings=settings)


@pytest.mark.parametrize(
    ("inputs", "message"),
    [
        ({"individualism": 101}, r"0\.\.100, got 101"),
        ({"individualism": float("-inf")}, "got -inf"),
        ({"individualism": "38"}, "got '38'"),
        ({"individualism": True}, "got True"),
        ({"age": 118}, "years"),
        ({"gender": "femal"}, "Did you mean 'female'"),
        ({"gender": 1}, "got 1"),
        ({"culture": "JPM"}, "'JPM'. Write a country"),
        ({"individualsm": 3}, "Did you mean 'individualism'"),
    ],
)
def test_what_is_no_value_is_refused(bruno2017, inputs, message):
    with pytest.raises(InputError, match=message):
        bruno2017.infer(inputs)


def test_an_unknown_mode_is_refused(small):
    with pytest.raises(InputError, match="Did you mean 'matlab'"):
        small.infer({}, mode="mathlab")


@pytest.mark.parametrize("consent", [None, "withheld"])
def test_consent_to_touch_is_never_presumed(small, consent):
    inference = small.infer({"warmth": 9, "touch_consent": consent, "mood": "calm"})
    assert inference["gesture"].word == "nod"
    assert "hug" not in inference["gesture"].desirability.memberships
    assert "touch_consent is given" in inference["gesture"].note
    with pytest.raises(InputError, match="touch_consent is given"):
        small.infer({"touch_consent": consent}, settings={"gesture": "hug"})


def test_with_consent_touch_is_possible(small):
    assert small.infer({"warmth": 9, "touch_consent": "given", "mood": "calm"})["gesture"].word == "hug"
    asked = small.infer({"touch_consent": "given"}, settings={"gesture": "hug"})["gesture"]
    assert (asked.word, asked.origin, asked.desirability.memberships) == ("hug", "setting", {"hug": 1.0})


def test_ties_go_to_the_neutral_category_and_are_reported(bruno2017):
    value = bruno2017.infer({"culture": None, "individualism": 67})["greeting_modality"]
    assert value.word == "both"
    tied = bruno2017.infer({"individualism": 67, "formality": "formal"})["greeting_gesture"]
    assert tied.word == "nod"  # the neutral one, though it is not among the tied
    assert tied.desirability("nod") == tied.desirability("wave") == 1.0
    assert "equally desirable; nod, the neutral value, stands" in tied.note


def test_the_neutral_category_wins_a_tie(write):
    rulebook = load_rulebook(
        write(("warmth is warm then gesture is hug", "mood is lively then gesture is nod"))
    )
    value = rulebook.infer({"mood": "lively"})["gesture"]
    assert (value.word, value.origin) == ("nod", "situation")
    assert "wave, nod are equally desirable; nod, the neutral value, stands" in value.note


def test_a_parameter_may_read_another_one(small):
    assert small.infer({"warmth": 0, "mood": "calm"})["volume"].number > 0.6
    assert small.infer({"warmth": 10, "mood": "calm"})["volume"].number < 0.4
    assert small.infer({"warmth": 10}, settings={"distance": 8})["volume"].number > 0.6


def test_a_parameter_that_reads_a_neutral_one_is_neutral(small):
    assert small.infer({})["volume"].origin == "neutral"


def test_parameters_that_read_each_other_are_refused_with_their_names(write):
    with pytest.raises(
        InputError, match=r"distance <- volume <- distance|volume <- distance <- volume"
    ) as refusal:
        load_rulebook(write(("if mood is lively then distance", "if volume is loud then distance")))
    assert refusal.value.where.line is not None


def test_one_rule_may_conclude_several_things(write):
    rulebook = load_rulebook(write(("then distance is near", "then distance is near and gesture is wave")))
    inference = rulebook.infer({"warmth": 10, "mood": "calm"})
    assert inference["gesture"].word == "wave"
    assert inference["distance"].number < 1


def test_strongest_rules_come_first(case2):
    fired = case2.infer({"individualism": 38, "gender": "female"})["conversational_distance"].fired
    assert [firing.rule.number for firing in fired] == [1, 2]
    assert [firing.strength for firing in fired] == pytest.approx([0.839, 0.172], abs=1e-3)


def test_calls_leave_nothing_behind(bruno2017):
    people = [
        {"individualism": score, "gender": gender}
        for score in range(0, 101, 5)
        for gender in ("female", "male")
    ]
    alone = [bruno2017.infer(person) for person in people]
    with ThreadPoolExecutor(4) as pool:
        together = list(pool.map(bruno2017.infer, people * 3))
    assert together == alone * 3


def test_an_inference_travels_between_processes(bruno2017):
    inference = bruno2017.infer({"individualism": 38}, settings={"approach_speed": 0.4})
    assert pickle.loads(pickle.dumps(inference)) == inference
    assert pickle.loads(pickle.dumps(bruno2017)).infer({"individualism": 38}) == bruno2017.infer(
        {"individualism": 38}
    )


def test_a_rulebook_is_frozen(small):
    with pytest.raises(dataclasses.FrozenInstanceError):
        small.name = "other"


def test_json_has_the_documented_keys(bruno2017):
    data = bruno2017.infer({"individualism": 38, "gender": "female"}).as_json()
    assert list(data) == ["rulebook", "mode", "inputs", "parameters", "coercions", "notes"]
    assert data["coercions"]["individualism"]["to"] == "interval"
    distance = data["parameters"]["conversational_distance"]
    assert (round(distance["value"], 4), distance["unit"], distance["spread"], distance["origin"]) == (
        0.6402,
        "m",
        0.3,
        "culture",
    )
    assert distance["contributions"][0]["value"] == distance["value"]
    assert distance["desirability"] is None
    assert distance["curve"][0] == [0.45, pytest.approx(0.839, abs=1e-3)]
    assert data["parameters"]["greeting_gesture"]["curve"] is None
    assert set(data["parameters"]["greeting_gesture"]["desirability"]) >= {"nod", "wave"}


def test_numbers_and_words_are_not_confused(bruno2017):
    inference = bruno2017.infer({})
    with pytest.raises(TypeError):
        _ = inference["greeting_gesture"].number
    with pytest.raises(TypeError):
        _ = inference["approach_speed"].word


def variable(**changes):
    fields = {
        "name": "x",
        "kind": "culture",
        "level": Level.INTERVAL,
        "domain": Interval(0, 1),
        "terms": {"low": Trapezoid(0, 0, 0.5, 1)},
    }
    return NumericVariable(**(fields | changes))


def test_terms_over_an_ordinal_variable_need_a_declared_coercion():
    with pytest.raises(WrongValueError, match="coercion"):
        variable(level=Level.ORDINAL)
    assert (
        variable(level=Level.ORDINAL, coercion=Coercion(Level.INTERVAL, "as the paper does")).level
        == Level.ORDINAL
    )


def test_a_ratio_variable_starts_at_its_zero_or_above():
    with pytest.raises(WrongValueError, match="ratio"):
        variable(level=Level.RATIO, domain=Interval(-1, 1))


@pytest.mark.parametrize("nothing", [None, "german_woman"])
def test_what_is_no_mapping_is_refused_with_a_remedy(small, nothing):
    with pytest.raises(InputError, match="Give a dictionary, an empty one"):
        small.infer(nothing)
