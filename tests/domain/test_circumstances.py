"""What the moment rules out."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from comity_domain import Circumstances, greetings, make_plan, ruled_out, unheard
from comity_domain.problem.request import Visitee, VisitRequest
from comity_fis import load_rulebook

RULEBOOK = load_rulebook("bruno2017")

distances_m = st.floats(0.3, 3.0)
noises_db = st.floats(0.0, 140.0)


@given(distances_m, distances_m, noises_db, noises_db)
def test_nearer_and_quieter_is_never_harder_to_hear(one_m, other_m, one_db, other_db):
    near, far = sorted((one_m, other_m))
    quiet, loud = sorted((one_db, other_db))
    if Circumstances(noise_db=loud).against_words(far) is None:
        assert Circumstances(noise_db=quiet).against_words(near) is None


def test_a_raised_voice_is_66_db_at_a_metre():
    assert Circumstances(noise_db=66.0).against_words(1.0) is None
    assert "drowns" in Circumstances(noise_db=66.1).against_words(1.0)


@pytest.mark.parametrize(
    ("now", "out"),
    [
        (Circumstances(robot_carries="a tray"), {"wave", "bow", "handshake"}),
        (Circumstances(person_carries="a bag"), {"handshake"}),
        (Circumstances(withheld={"handshake": "touch_consent is given"}), {"handshake"}),
        (Circumstances(), set()),
    ],
)
def test_hands_and_consent_rule_gestures_out(infer, now, out):
    gestures = {"nod": 0.2, "wave": 0.5, "bow": 0.4, "handshake": 1.0}
    values = infer(modality="gestural", modalities={"gestural": 1.0}, gesture="handshake", gestures=gestures)
    assert {greeting.gesture for greeting in greetings(values, now)} == set(gestures) - out
    assert {greeting.gesture for greeting in ruled_out(values, now)} == out


@pytest.mark.parametrize("now", [Circumstances(noisy=True), Circumstances(noise_db=90.0)])
def test_in_noise_only_gestures_remain(infer, now):
    assert {greeting.modality for greeting in greetings(infer(), now)} == {"gestural"}
    assert all("nois" in reason for reason in ruled_out(infer(), now).values())


def test_what_is_ruled_out_is_not_planned_and_said(infer, travel_everywhere):
    """Ada would like words: in the noise she is nodded to, and the plan says what is against the words."""
    ada = Visitee("ada", infer(), Circumstances(noisy=True))
    _, greet = make_plan(VisitRequest("robot", (ada,), travel_everywhere(["ada"]))).steps
    assert greet.arguments[2:] == ("gestural", "nod")
    reasons = {option.arguments[2:]: option.reason for option in greet.why.ruled_out}
    assert reasons["verbal", "none"] == "it is too noisy for words"


def test_a_setting_that_the_moment_rules_out_leaves_nothing(infer):
    """An explicit wish is a hard constraint: nothing stands in for it."""
    values = infer(modality="verbal", settings=["greeting_modality"])
    assert greetings(values, Circumstances(noisy=True)) == ()


@given(
    individualism=st.floats(0.0, 100.0),
    gender=st.sampled_from(["female", "male"]),
    noise_db=st.floats(50.0, 90.0),
    settings=st.sampled_from([{}, {"greeting_modality": "verbal"}, {"conversational_distance": 2.0}]),
    hands=st.booleans(),
)
def test_whether_anybody_can_be_greeted_or_spoken_to_in_noise_hangs_on_no_culture(
    individualism, gender, noise_db, settings, hands
):
    """Somebody else in the same noise, with the same wishes, is served exactly where this person is."""
    now = Circumstances(noise_db=noise_db, robot_carries="a tray" if hands else None)
    known = {"individualism": individualism, "gender": gender}
    served = [
        (bool(greetings(values, now)), unheard(values, now) is None)
        for values in (RULEBOOK.infer(facts, settings=settings) for facts in (known, {}))
    ]
    assert served[0] == served[1]


def test_words_that_are_drowned_are_the_last_resort(infer):
    """67 dB drowns a raised voice at 1.09 m: a nod instead, but words to somebody who wants nothing else."""
    now = Circumstances(noise_db=67.0)
    free = RULEBOOK.infer({"individualism": 67.0, "gender": "male"})
    assert {greeting.modality for greeting in greetings(free, now)} == {"gestural"}
    wordy = RULEBOOK.infer(
        {"individualism": 67.0, "gender": "male"}, settings={"greeting_modality": "verbal"}
    )
    assert [greeting.way for greeting in greetings(wordy, now)] == [("verbal", "none")]
    assert greetings(wordy, Circumstances(noise_db=74.0)) == ()
    asked = RULEBOOK.infer({}, settings={"greeting_modality": "verbal", "conversational_distance": 1.09})
    assert greetings(asked, now) == ()
