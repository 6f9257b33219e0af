from __future__ import annotations

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from comity_domain import greetings, make_plan


def pairs(values):
    return [(greeting.modality, greeting.gesture) for greeting in greetings(values)]


def test_words_alone_take_no_gesture_and_everything_else_takes_one(infer):
    assert pairs(infer()) == [
        ("verbal", "none"),
        ("gestural", "nod"),
        ("both", "nod"),
        ("gestural", "wave"),
        ("both", "wave"),
    ]


def test_a_greeting_is_as_desirable_as_the_lesser_of_its_parts(infer):
    found = {(g.modality, g.gesture): g.desirability for g in greetings(infer())}
    assert found["verbal", "none"] == 1.0
    assert found["gestural", "nod"] == 0.2
    assert found["both", "wave"] == 0.5


def test_what_is_not_permitted_is_not_on_offer(infer):
    """Gestures of contact are absent from the choice until the person consents."""
    values = infer(gestures={"nod": 1.0}, modalities={"both": 1.0, "verbal": 0.5}, modality="both")
    assert pairs(values) == [("both", "nod"), ("verbal", "none")]


@pytest.mark.parametrize(
    ("asked", "expected"),
    [
        (["greeting_modality"], [("both", "wave"), ("both", "nod")]),
        (["greeting_gesture"], [("both", "wave"), ("gestural", "wave")]),
        (["greeting_modality", "greeting_gesture"], [("both", "wave")]),
    ],
)
def test_what_was_asked_for_leaves_no_other(infer, asked, expected):
    assert pairs(infer(modality="both", gesture="wave", settings=asked)) == expected


def test_who_asked_for_words_gets_words_even_if_they_asked_for_a_gesture_too(infer):
    both = ["greeting_modality", "greeting_gesture"]
    assert pairs(infer(modality="verbal", gesture="wave", settings=both)) == [("verbal", "none")]


WORDS = ("verbal", "gestural", "both")
desirabilities = st.integers(0, 100).map(lambda hundredths: hundredths / 100)


@settings(suppress_health_check=[HealthCheck.function_scoped_fixture])  # a pure function
@given(st.tuples(desirabilities, desirabilities, desirabilities))
def test_a_wish_for_a_gesture_leaves_the_words_that_were_inferred(infer, liked):
    """The gesture comes beside the words, which are as desirable as they were without the wish."""
    modalities = dict(zip(WORDS, liked, strict=True))
    inferred = max(WORDS, key=lambda word: modalities[word])
    values = infer(modality=inferred, modalities=modalities, gesture="wave", settings=["greeting_gesture"])
    first, *others = greetings(values)
    assert first.way == ("gestural" if inferred == "gestural" else "both", "wave")
    assert first.departures == 0
    assert first.desirability == max(liked)
    assert all(other.gesture == "wave" for other in others)


def test_words_that_no_rule_gives_a_gesture_are_planned_with_the_gesture_asked_for(infer, request_for):
    liked = {"verbal": 1.0, "gestural": 0.0, "both": 0.0}
    values = infer(modalities=liked, gesture="nod", settings=["greeting_gesture"])
    plan = make_plan(request_for({"mira": values}))
    assert plan.steps[-1].arguments[-2:] == ("both", "nod")
