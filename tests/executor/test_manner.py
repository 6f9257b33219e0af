"""How the robot acts towards a person, and what it says."""

from __future__ import annotations

import dataclasses

import pytest
from hypothesis import given
from hypothesis import strategies as st

from comity_executor import Manner, greeting_text, manner_of, offer_text
from comity_executor.speech.passing_words import REQUESTS
from comity_executor.speech.wording import PHRASES, RHETORICAL
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


@pytest.mark.parametrize(
    ("person", "called"),
    [
        ("anna_maria", "Anna Maria"),
        ("Anna von Ems", "Anna von Ems"),
        ("c1", "C1"),
        ("McLeod", "McLeod"),
        ("李明", "李明"),
    ],
)
def test_somebody_is_called_with_the_capitals_that_their_name_has(person, called):
    assert called in greeting_text((person,), EVIDENCE.infer({}))


@given(SHARES, SHARES, SHARES, st.sampled_from(sorted(PHRASES)))
def test_every_wording_names_the_person_and_nothing_is_left_to_fill_in(
    formality, style, directness, language
):
    asked = {
        "formality": formality,
        "rhetorical_style": style,
        "verbal_directness": directness,
        "greeting_language": language,
    }
    text = greeting_text(("anna_maria",), EVIDENCE.infer({}, settings=asked))
    assert "Anna Maria" in text
    assert "{" not in text
    assert len(text) < 120


@given(SHARES, st.sampled_from(sorted(PHRASES)), st.sampled_from([None, "stranger", "acquaintance", "close"]))
def test_an_honour_to_meet_is_said_at_a_first_meeting_only(style, language, familiarity):
    asked = {"rhetorical_style": style, "greeting_language": language}
    text = greeting_text(("anna",), EVIDENCE.infer({"familiarity": familiarity}, settings=asked))
    assert (PHRASES[language].rhetorical in text) == (familiarity == "stranger" and style > RHETORICAL)


def test_no_wording_is_one_that_speakers_would_not_say():
    """Polite for giving, rough, for good, formal beside a first name, and said by a host alone."""
    texts = " ".join(
        str(dataclasses.asdict(wordings)) for wordings in (*PHRASES.values(), *REQUESTS.values())
    )
    for wrong in ("Please, ", "Yaa", "Sayounara", " Sie", "Marhaban bikum", "Ahlan", "elcome", "illkommen"):
        assert wrong not in texts


def test_who_hands_something_over_says_so_in_the_persons_language():
    def said(language):
        return offer_text("anna", "tea", EVIDENCE.infer({}, settings={"greeting_language": language}))

    assert said("eng") == "Anna, I have brought you tea."
    assert said("deu") == "Bitte schön, Anna."  # things are called by English words
    assert all("Anna" in said(language) for language in PHRASES)


def test_no_wording_speaks_of_religion():
    """A greeting that is common in a language may still be a religious one."""
    texts = " ".join(str(dataclasses.asdict(phrases)) for phrases in PHRASES.values()).lower()
    assert not [word for word in ("salam", "allah", "gott", "god bless", "namaste") if word in texts]


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
    assert visits.hall.manners["utter", "johanna"].volume == 0.9
    assert visits.hall.manners["nod", "johanna"].amplitude == 0.1


@pytest.mark.parametrize(("key", "value"), [("volume", 1.1), ("rate", 0.0), ("amplitude", float("nan"))])
def test_a_manner_that_no_robot_has_is_refused(key, value):
    with pytest.raises(InputError, match="as a"):
        Manner(**{key: value})


def test_a_company_is_greeted_by_its_names() -> None:
    values = EVIDENCE.infer({})
    assert "Anna and Ben." in greeting_text(("anna", "ben"), values)
    assert "Anna, Ben and Cem." in greeting_text(("anna", "ben", "cem"), values)
    german = EVIDENCE.infer({}, settings={"greeting_language": "deu"})
    assert "Anna und Ben." in greeting_text(("anna", "ben"), german)
