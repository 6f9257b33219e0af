"""The situation moves a value by its own rules; what nobody said moves nothing."""

import dataclasses
import math

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from comity_fis import InputError, Learnt, Rulebook, explain, load_rulebook
from comity_fis.loading import to_fis
from comity_fis.matlab.reader import parse_fis
from comity_fis.rulebook.writer import rulebook_yaml

MOVED = (
    (
        "parameters:\n  distance:\n",
        """\
  noise:
    kind: situation
    level: interval
    range: [0, 10]
    terms:
      quiet: {trapezoid: [0, 0, 2, 8]}
      loud: {trapezoid: [2, 8, 10, 10]}
    shapes: design
    reason: made up
parameters:
  distance:
    shift:
      range: [-2, 2]
      terms:
        closer: {trapezoid: [-2, -2, -1, 0]}
        same: {trapezoid: [-1, 0, 0, 1]}
        farther: {trapezoid: [0, 1, 2, 2]}
      shapes: design
      reason: made up
""",
    ),
    (
        "rules:\n  - {",
        """\
rules:
  - {rule: if noise is loud then distance is closer, sources: [book], evidence: strong}
  - {rule: if noise is quiet then distance is same, sources: [book], evidence: strong}
  - {rule: if mood is calm then distance is farther, sources: [book], evidence: strong}
  - {rule: if mood is lively then distance is closer, sources: [book], evidence: weak, enabled: false}
  - {""",
    ),
)

WARMTH = st.none() | st.floats(0, 10)
NOISE = st.none() | st.floats(0, 10)
MOODS = st.sampled_from([None, "calm", "lively"])
KNOWN = st.fixed_dictionaries({"warmth": WARMTH, "noise": NOISE, "mood": MOODS})


@pytest.fixture(scope="session")
def moved(tmp_path_factory, small_text) -> Rulebook:
    """The small rulebook, whose distance the situation moves."""
    for old, new in MOVED:
        small_text = small_text.replace(old, new, 1)
    path = tmp_path_factory.mktemp("moved") / "moved.yaml"
    path.write_text(small_text, encoding="utf-8")
    return load_rulebook(path)


@given(WARMTH)
def test_nothing_moves_where_nothing_of_the_situation_is_known(moved, small, warmth):
    value = moved.infer({"warmth": warmth})["distance"]
    assert value == small.infer({"warmth": warmth})["distance"] or value.fired
    assert value.shift is None
    assert len(value.contributions) == 1


@given(KNOWN, st.floats(-20, 20))
def test_nothing_passes_what_may_be_asked_for_or_is_safe(moved, known, offset):
    value = moved.infer(known, learnt={"distance": Learnt(offset, 0.1, "")})["distance"]
    assert 0 <= value.number <= 6
    assert math.isclose(sum(part.value for part in value.contributions), value.number, abs_tol=1e-9)


@given(KNOWN)
def test_contributions_tell_culture_and_situation_apart(moved, known):
    value = moved.infer(known)["distance"]
    start, *steps = value.contributions
    unmoved = without_shift(moved).infer({**known})["distance"]
    assert start == unmoved.contributions[0]
    assert sum(step.value for step in steps) == pytest.approx(value.number - unmoved.number)
    if value.shift is not None and value.shift.number != 0:
        assert steps[0].origin == "situation"
        assert steps[0].value == value.shift.number


@given(WARMTH, MOODS, st.tuples(st.floats(0, 10), st.floats(0, 10)))
def test_a_shift_follows_its_rules_direction(moved, warmth, mood, noises):
    """Louder is closer, so that more noise never gives a larger distance."""
    distances = [
        moved.infer({"warmth": warmth, "mood": mood, "noise": noise})["distance"].number
        for noise in sorted(noises)
    ]
    assert distances[0] >= distances[1] - 1e-9


@given(KNOWN)
def test_the_curve_moves_with_the_value(moved, known):
    value = moved.infer(known)["distance"]
    before = without_shift(moved).infer(known)["distance"]
    assert value.desirability(value.number) == pytest.approx(before.desirability(before.number), abs=1e-6)


@given(KNOWN, st.floats(0, 8))
def test_a_setting_is_moved_by_nothing(moved, known, wish):
    value = moved.infer(known, settings={"distance": wish})["distance"]
    assert value.number == min(wish, 6)
    assert value.shift is None


@given(st.lists(KNOWN, min_size=1, max_size=5))
def test_many_people_at_once_are_moved_like_one(moved, people):
    columns = {
        "warmth": np.array([np.nan if p["warmth"] is None else p["warmth"] for p in people]),
        "noise": np.array([np.nan if p["noise"] is None else p["noise"] for p in people]),
        "mood": [p["mood"] for p in people],
    }
    found = moved.infer_many(columns)
    for row, known in enumerate(people):
        alone = moved.infer(known)
        for name in ("distance", "volume"):
            assert found[name][row] == pytest.approx(alone[name].number, abs=1e-9)
            assert moved.value(name, known) == pytest.approx(alone[name].number, abs=1e-12)


@given(WARMTH, MOODS, st.floats(0.01, 9.99))
def test_derivatives_are_of_the_whole_value(moved, warmth, mood, noise):
    known = {"warmth": warmth, "mood": mood, "noise": noise}
    found = {one.input: one for one in explain(moved, known, "distance").sensitivities}["noise"]
    assume(found.derivative is not None)
    step = 1e-6
    low, high = (moved.infer({**known, "noise": noise + by})["distance"].number for by in (-step, step))
    assert (high - low) / (2 * step) == pytest.approx(found.derivative, abs=1e-3)


@given(KNOWN)
def test_an_explanation_counts_rules_and_shift_apart(moved, known):
    explanation = explain(moved, known, "distance")
    given_ = sum(account.contribution for account in explanation.rules)
    if explanation.rules:
        assert given_ == pytest.approx(explanation.value.start.value)
    for other in explanation.alternatives:
        for stated in other.given if isinstance(other.given, tuple) else (other.given,):
            assert moved.infer({**known, other.input: stated})["distance"].value == other.value.value


def test_the_rules_that_moved_it_are_named(moved):
    value = moved.infer({"warmth": 9, "mood": "calm"})["distance"]
    assert [fired.rule.text for fired in value.shift.fired] == ["if mood is calm then distance is farther"]
    assert value.contributions[1].text == "from rule 3"
    assert value.origin == "situation"
    assert value.as_json()["shift"]["rules"][0]["number"] == 3


def test_a_neutral_value_can_be_moved(moved):
    value = moved.infer({"noise": 10, "mood": None})["distance"]
    assert [part.origin for part in value.contributions] == ["neutral", "situation"]
    assert value.number < 3.5


def test_a_rule_that_is_off_decides_nothing(moved):
    assert moved.infer({"mood": "lively"})["distance"].shift is None
    assert [rule.enabled for rule in moved.rules[:5]] == [True, True, True, False, True]
    on = dataclasses.replace(
        moved, rules=tuple(dataclasses.replace(rule, enabled=True) for rule in moved.rules)
    )
    assert on.infer({"mood": "lively"})["distance"].shift.number < 0


def test_a_rule_that_is_off_can_be_edited_on_and_off(moved):
    on = moved.with_rule(4, dataclasses.replace(moved.rules[3], enabled=True))
    assert on.infer({"mood": "lively"})["distance"].shift.number < 0
    assert on.with_rule(4, moved.rules[3]).infer({"mood": "lively"})["distance"].shift is None


def test_who_somebody_is_may_not_move_a_value(write, moved):
    changes = (*MOVED, ("if noise is loud then distance", "if warmth is warm then distance"))
    with pytest.raises(InputError, match="only variables of kind situation") as error:
        load_rulebook(write(*changes))
    assert error.value.where.line is not None
    assert "near, middle, away" in error.value.remedy
    with pytest.raises(InputError, match="only variables of kind situation"):
        moved.with_rule(1, "if warmth is warm then distance is closer")


@pytest.mark.parametrize(
    ("old", "new", "expected"),
    [
        ("range: [-2, 2]", "range: [1, 2]", "holds 0"),
        ("        same: {trapezoid", "        near: {trapezoid", "other names"),
        ("[0, 1, 2, 2]}", "[5, 6, 7, 8]}", "above 0 somewhere"),
    ],
)
def test_a_shift_that_cannot_be_is_refused(write, old, new, expected):
    with pytest.raises(InputError, match=expected):
        load_rulebook(write(*MOVED, (old, new)))


def test_a_rule_reads_a_value_and_not_its_shift(write):
    with pytest.raises(InputError, match="farther"):
        load_rulebook(
            write(*MOVED, ("if distance is away then volume", "if distance is farther then volume"))
        )


def test_a_rulebook_with_a_shift_reads_back_the_same(moved, tmp_path):
    path = tmp_path / "again.yaml"
    path.write_text(rulebook_yaml(moved, "the test"), encoding="utf-8")
    again = load_rulebook(path)
    assert again.rules == moved.rules
    assert again.parameters["distance"].shift == moved.parameters["distance"].shift
    known = {"warmth": 3, "noise": 7}
    assert again.infer(known)["distance"] == moved.infer(known)["distance"]


def test_matlab_has_no_place_for_a_shift(moved):
    only_distance = dataclasses.replace(
        moved,
        parameters={"distance": moved.parameters["distance"]},
        rules=tuple(rule for rule in moved.rules if {is_.name for is_ in rule.consequents} == {"distance"}),
    )
    with pytest.raises(InputError, match="whose values no situation moves"):
        to_fis(only_distance)


def without_shift(rulebook):
    """The same rulebook with the rules that move values left out."""
    return dataclasses.replace(
        rulebook,
        rules=tuple(
            rule
            for rule in rulebook.rules
            if all(is_.term in rulebook.parameters[is_.name].terms for is_ in rule.consequents)
        ),
    )


def test_a_rule_that_is_off_has_weight_0_in_a_fis_file_and_comes_back_off():
    rulebook = load_rulebook("bruno2017-case2")
    off = dataclasses.replace(
        rulebook, rules=(dataclasses.replace(rulebook.rules[0], enabled=False), *rulebook.rules[1:])
    )
    exported = to_fis(off, tolerance=0.1)
    assert not [one for one in exported.lost if one.startswith("rules that are off")]
    back = parse_fis(exported.text, "off.fis")
    assert [rule.enabled for rule in back.rules] == [False] + [True] * (len(rulebook.rules) - 1)


@given(KNOWN, st.floats(-3, 3))
def test_an_explanation_keeps_what_was_learnt(moved, known, offset):
    learnt = {"distance": Learnt(offset, 0.1, "2 visits")}
    explanation = explain(moved, known, "distance", learnt=learnt)
    assert explanation.value == moved.infer(known, learnt=learnt)["distance"]
    for account in explanation.rules:
        rest = dataclasses.replace(
            moved, rules=tuple(rule for rule in moved.rules if rule.number != account.rule.number)
        )
        assert account.without.value == rest.infer(known, learnt=learnt)["distance"].value


def test_an_explanation_names_the_rules_that_are_off(moved):
    assert [rule.number for rule in explain(moved, {}, "distance").off] == [4]
    assert explain(moved, {}, "volume").off == ()
