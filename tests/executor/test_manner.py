"""How the robot acts towards a person: loudness, pace, gestures."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from comity_executor import Manner, manner_of
from comity_fis import InputError, Learnt, load_rulebook

EVIDENCE = load_rulebook("evidence")
SHARES = st.floats(0, 1)


@given(SHARES, st.floats(0.5, 1.5), SHARES)
def test_the_manner_is_what_the_rulebook_says(volume, rate, amplitude):
    asked = {"voice_volume": volume, "speech_rate": rate, "gesture_amplitude": amplitude}
    assert manner_of(EVIDENCE.infer({}, settings=asked)) == Manner(
        volume=volume, rate=rate, amplitude=amplitude
    )


def test_where_a_rulebook_says_nothing_the_manner_is_normal():
    assert manner_of(load_rulebook("bruno2017").infer({})) == Manner()


def test_what_was_learnt_reaches_the_manner():
    learnt = {"voice_volume": Learnt(0.2, 0.05, "2 visits: asked for louder speech")}
    assert manner_of(EVIDENCE.infer({}, learnt=learnt)).volume == pytest.approx(0.7)


def test_the_tree_hands_the_manner_to_the_robot(episode):
    visits = episode()
    louder = EVIDENCE.infer({}, settings={"voice_volume": 0.9, "speech_rate": 0.5, "gesture_amplitude": 0.1})
    visits.values["johanna"].parameters.update(
        {name: louder[name] for name in ("voice_volume", "speech_rate", "gesture_amplitude")}
    )
    visits.run()
    assert visits.hall.manners["say", "johanna"].volume == 0.9
    assert visits.hall.manners["nod", "johanna"].amplitude == 0.1


@pytest.mark.parametrize(("key", "value"), [("volume", 1.1), ("rate", 0.0), ("amplitude", float("nan"))])
def test_a_manner_that_no_robot_has_is_refused(key, value):
    with pytest.raises(InputError, match="as a"):
        Manner(**{key: value})
