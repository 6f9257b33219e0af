from __future__ import annotations

import pytest

from comity_domain import greetings


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
    ("settings", "expected"),
    [
        (["greeting_modality"], [("both", "wave"), ("both", "nod")]),
        (["greeting_gesture"], [("both", "wave"), ("gestural", "wave")]),
        (["greeting_modality", "greeting_gesture"], [("both", "wave")]),
    ],
)
def test_what_was_asked_for_leaves_no_other(infer, settings, expected):
    assert pairs(infer(modality="both", gesture="wave", settings=settings)) == expected


def test_who_asked_for_words_gets_words_even_if_they_asked_for_a_gesture_too(infer):
    both = ["greeting_modality", "greeting_gesture"]
    assert pairs(infer(modality="verbal", gesture="wave", settings=both)) == [("verbal", "none")]
