"""What the robot says: wordings with facts, names as people asked, reviewed ones alone on a real robot."""

from __future__ import annotations

import re
import unicodedata
from dataclasses import replace
from datetime import date

import pytest
from hypothesis import given
from hypothesis import strategies as st

from comity_executor import Address, Execution, Phrasebook, Speaker, Wording, read_wordings
from comity_executor.robots.goals import ActGoal, speech
from comity_executor.speech.phrasebook import SHIPPED, Language
from comity_executor.speech.script import read_tag
from comity_executor.speech.speaker import RHETORICAL
from comity_fis import InputError, load_rulebook
from comity_fis.errors import WrongValueError
from comity_fis.validation.yaml_file import parse_yaml

EVIDENCE = load_rulebook("evidence")
SPEAKER = Speaker()
SHARES = st.floats(0, 1)
LANGUAGES = st.sampled_from(list(SHIPPED))
FAMILIARITY = st.sampled_from([None, "stranger", "acquaintance", "close"])
ALL = [wording for code in SHIPPED for wording in SHIPPED[code].wordings]
REVIEW = {"reviewed_by": "Ada, a native speaker", "reviewed_on": date(2026, 11, 27)}


@st.composite
def met(draw):
    """A person's parameters of the words, in any combination."""
    asked = {
        "greeting_language": draw(LANGUAGES),
        "formality": draw(SHARES),
        "rhetorical_style": draw(SHARES),
        "verbal_directness": draw(SHARES),
    }
    return EVIDENCE.infer({"familiarity": draw(FAMILIARITY)}, settings=asked)


def utterances(speaker, values, people=("anna_maria",)):
    first = people[0]
    return (
        speaker.greeting(people, values),
        speaker.handing_over(first, "tea", values),
        speaker.farewell(first, values),
        speaker.request_to_pass(first, values),
    )


def reviewed(chosen):
    """A phrasebook in which some of the wordings that ship were reviewed."""
    own = (
        replace(
            SHIPPED[code],
            wordings=tuple(
                replace(one, **REVIEW) if one in chosen else one for one in SHIPPED[code].wordings
            ),
        )
        for code in SHIPPED
    )
    return Phrasebook(tuple(own))


@given(met())
def test_every_utterance_names_the_person_once_and_leaves_nothing_to_fill_in(values):
    for said in utterances(SPEAKER, values):
        for text in (said.text, said.latin, said.spoken):
            assert text.count("Anna Maria") == 1
            assert not {"{", "}"} & {*text}
            assert len(text) < 130


@given(met(), st.booleans())
def test_all_that_is_said_at_once_is_in_one_language(values, strict):
    for said in utterances(replace(SPEAKER, reviewed_only=strict), values):
        assert len({one.language for one in said.wordings}) == 1


@given(met())
def test_without_a_name_the_rest_is_said_and_the_name_in_no_form(values):
    for said in utterances(SPEAKER, values, ("anna_maria", "ben")):
        unnamed = said.without({"anna_maria", "ben"})
        for text in (unnamed.text, unnamed.latin, unnamed.spoken):
            assert "Anna" not in text
            assert "Ben" not in text
            assert not text.startswith((" ", ",", "،", "、"))
            assert text.rstrip(" .。")
            assert not {"さん", "様", "-san", "-sama"} & {*text.replace("、", " ").split()}
        assert "Anna" not in said.without({"anna_maria"}).text


@given(met())
def test_a_real_robot_says_nothing_unreviewed_but_a_plain_word_in_the_language_of_the_site(values):
    for site in SHIPPED:
        for said in utterances(Speaker(site=site, reviewed_only=True), values):
            (wording,) = said.wordings
            assert wording.register == "plain"
            assert wording.language == SHIPPED[site].tag
            assert "Anna Maria" in said.text


@given(met(), st.sets(st.sampled_from(ALL)))
def test_a_real_robot_says_what_was_reviewed_and_nothing_else(values, chosen):
    strict = Speaker(phrasebook=reviewed(chosen), reviewed_only=True)
    free = replace(strict, reviewed_only=False)
    for said, wanted in zip(utterances(strict, values), utterances(free, values), strict=True):
        assert all(one.is_reviewed or one.register == "plain" for one in said.wordings)
        if wanted.wordings[0].is_reviewed:
            assert said.wordings == tuple(one for one in wanted.wordings if one.is_reviewed)


@given(SHARES, LANGUAGES, FAMILIARITY)
def test_an_honour_to_meet_is_said_at_a_first_meeting_only(style, language, familiarity):
    asked = {"rhetorical_style": style, "greeting_language": language}
    said = SPEAKER.greeting(("anna",), EVIDENCE.infer({"familiarity": familiarity}, settings=asked))
    honoured = [one for one in said.wordings if one.use == "honour"]
    assert bool(honoured) == (familiarity == "stranger" and style > RHETORICAL)
    assert all(one.occasion == "first_meeting" for one in honoured)


WORDS = st.text(st.characters(categories=["Lu", "Ll", "Lo"]), min_size=1, max_size=9)


@given(met(), WORDS, st.none() | WORDS, st.booleans(), st.none() | WORDS)
def test_a_person_is_addressed_as_they_asked_and_nothing_is_added(values, name, title, first, how):
    address = Address(name=name, title=title, title_first=first, pronunciation=how)
    speaker = replace(SPEAKER, addresses={"anna": address})
    written = " ".join(filter(None, (title, name) if first else (name, title)))
    for said in utterances(speaker, values, ("anna",)):
        template, latin = said.wordings[0].text, said.wordings[0].latin or said.wordings[0].text
        assert said.text.startswith(template.format(name=written, thing="tea"))
        assert said.latin.startswith(latin.format(name=written, thing="tea"))
        spoken = written if how is None else address.spoken
        assert said.spoken.startswith(template.format(name=spoken, thing="tea"))


def test_the_order_and_the_pronunciation_are_those_that_were_stated():
    address = Address(name="Okafor", title="Dr", pronunciation="oh-KAH-for")
    said = replace(SPEAKER, addresses={"ada": address}).greeting(("ada", "ben"), EVIDENCE.infer({}))
    assert said.text == "Hello, Dr Okafor and Ben."
    assert said.spoken == "Hello, Dr oh-KAH-for and Ben."
    japanese = EVIDENCE.infer({}, settings={"greeting_language": "jpn"})
    sensei = Address(name="Sato", title="sensei", title_first=False)
    said = replace(SPEAKER, addresses={"yuki": sensei}).greeting(("yuki",), japanese)
    assert said.latin == "Konnichiwa, Sato sensei."


def test_what_a_robot_is_told_to_say_has_language_latin_letters_and_pronunciation():
    values = EVIDENCE.infer({}, settings={"greeting_language": "ara"})
    okafor = replace(SPEAKER, addresses={"ada": Address(name="Okafor", pronunciation="oh-KAH-for")})
    goal = speech("say", "ada", okafor.greeting(("ada",), values))
    assert (goal.text, goal.language) == ("مرحبًا، Okafor.", "ar")
    assert (goal.latin, goal.spoken) == ("Marhaban, Okafor.", "مرحبًا، oh-KAH-for.")
    assert goal.without({"ada"}).text == "مرحبًا."
    own = ActGoal("say", "ada", "Tea is ready, Ada.")
    assert (own.latin, own.spoken, own.language) == (own.text, own.text, None)
    assert own.without({"ada"}).text == "Tea is ready."


def test_the_tree_speaks_as_its_speaker_does(episode):
    visits = episode()
    speaker = Speaker(site="swe", addresses={"johanna": Address(name="Ekman", title="Dr")})
    visits.execution = Execution(visits.plan, visits.hall, visits.values, speaker=speaker)
    visits.run()
    assert "say johanna: Hej, Dr Ekman." in visits.hall.calls


@pytest.mark.parametrize("wording", ALL, ids=lambda one: f"{one.language}-{one.use}-{one.register}")
def test_every_wording_that_ships_states_its_facts_and_that_nobody_has_reviewed_it(wording):
    assert wording.language in {"en", "ar", "de", "ja", "sv"}
    letters = {
        unicodedata.name(one).split()[0]
        for one in wording.text.replace("{name}", "").replace("{thing}", "")
        if unicodedata.category(one)[0] == "L"
    }
    scripts = {"Latn": {"LATIN"}, "Arab": {"ARABIC"}, "Jpan": {"HIRAGANA", "KATAKANA", "CJK"}}
    assert letters <= scripts[wording.script]
    assert (wording.latin is None) == (wording.script == "Latn")
    assert not wording.is_reviewed
    assert wording.reviewed_on is None
    assert (wording.occasion == "first_meeting") == (wording.use == "honour")


@pytest.mark.parametrize("code", list(SHIPPED))
def test_every_language_has_every_use_and_a_plain_word_for_each_that_names(code):
    language = SHIPPED[code]
    uses = {one.use for one in ALL}
    assert {one.use for one in language.wordings} == uses
    plain = {one.use for one in language.wordings if one.register == "plain"}
    assert plain == uses - {"honour", "offer_help", "hint_at_help"}
    for use in ("greet", "take_leave", "ask_to_pass"):
        registers = {one.register for one in language.wordings if one.use == use}
        assert registers == {"plain", "informal", "neutral", "formal"}


WRONG = {
    "en": {"Please, ": "asks for what it gives", "elcome": "is for the host to say"},
    "de": {
        r"\bSie\b": "is formal beside a first name",
        "Ihnen": "is formal beside a first name",
        r"\bdu\b": "is for the person to offer",
        r"\bdich\b": "is for the person to offer",
        "illkommen": "is for the host to say",
        "Bitte, ": "asks for what it gives",
        "Herr": "guesses a gender",
        "Frau": "guesses a gender",
    },
    "sv": {
        "Tjena": "is rough to a stranger",
        "älkommen": "is for the host to say",
        r"\bNi\b": "puts a distance",
    },
    "ar": {
        "bikum": "is a host's welcome",
        "Ahlan": "is a host's welcome",
        "أهلا": "is a host's welcome",
        "Min fadl": "asks for what it gives",
        "sayyid": "guesses a gender",
        "Ma'a as-salama": "is for the one who stays",
        "salam": "is religious to many",
    },
    "ja": {
        "Yaa": "is rough",
        "やあ": "is rough",
        "Sayounara": "parts for long",
        "さようなら": "parts for long",
        "Irasshai": "is for the host to say",
        "いらっしゃ": "is for the host to say",
        "Tadaima": "is said at home",
        "anata": "is rude to a person with a name",
        "あなた": "is rude to a person with a name",
        "-kun": "guesses a gender",
        "-chan": "is for children",
    },
}
"""What speakers would not have a robot say to a guest or a stranger, by language, each with the reason."""


@pytest.mark.parametrize("code", list(SHIPPED))
def test_no_wording_is_one_that_speakers_would_not_say(code):
    language = SHIPPED[code]
    texts = [form.latin + form.text for form in language.names.values()]
    for one in language.wordings:
        texts += [one.text, one.latin or ""]
    for wrong, reason in WRONG[language.tag].items():
        assert not [text for text in texts if re.search(wrong, text, re.IGNORECASE)], reason


def test_no_wording_speaks_of_religion():
    """A greeting that is common in a language may still be a religious one."""
    texts = " ".join(f"{one.text} {one.latin}" for one in ALL).lower()
    religious = ("salam", "allah", "سلام", "الله", "gott", "god bless", "namaste", "herregud")
    assert not [word for word in religious if word in texts]


def test_with_what_is_handed_over_the_robot_does_not_ask():
    values = EVIDENCE.infer({})
    assert SPEAKER.handing_over("anna", "tea", values).text == "Anna, I have brought you tea."
    german = EVIDENCE.infer({}, settings={"greeting_language": "deu"})
    assert SPEAKER.handing_over("anna", "tea", german).text == "Bitte schön, Anna."


def test_a_company_is_greeted_by_its_names():
    values = EVIDENCE.infer({})
    assert SPEAKER.greeting(("anna", "ben"), values).text == "Hello, Anna and Ben."
    assert SPEAKER.greeting(("anna", "ben", "cem"), values).text == "Hello, Anna, Ben and Cem."
    formal = EVIDENCE.infer({}, settings={"greeting_language": "jpn", "formality": 0.9})
    assert "Anna-sama to Ben-sama" in SPEAKER.greeting(("anna", "ben"), formal).latin


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
def test_a_person_is_called_with_the_capitals_that_their_name_has(person, called):
    assert SPEAKER.greeting((person,), EVIDENCE.infer({})).text == f"Hello, {called}."


def test_a_person_of_whom_nothing_is_known_is_asked_to_make_way_without_a_name():
    assert SPEAKER.request_to_pass("passer-by 1", None).text == "Excuse me, may I pass?"
    swedish = Speaker(site="swe", reviewed_only=True)
    assert swedish.request_to_pass("passer-by 1", None).text == "Ursäkta."


@pytest.mark.parametrize("tag", ["ar", "sv", "de-AT", "zh-Hant-TW", "sl-rozaj-biske", "en-x-lab"])
def test_a_language_tag_is_taken(tag):
    assert read_tag(tag) == tag


@pytest.mark.parametrize(
    "tag",
    ["", "a", "sv_SE", "en-", "-en", "english-british-isles-", "de-AT-AT", "sl-rozaj-rozaj", "en-a", "12"],
)
def test_a_tag_that_is_not_well_formed_is_refused(tag):
    with pytest.raises(WrongValueError, match="BCP 47"):
        read_tag(tag)


GOOD = {
    "language": "el",
    "script": "Grek",
    "use": "greet",
    "register": "neutral",
    "text": "Γεια σας, {name}.",
    "latin": "Geia sas, {name}.",
}


@pytest.mark.parametrize(
    ("change", "expected"),
    [
        ({"language": "greek!"}, "BCP 47"),
        ({"script": "Greek"}, "ISO 15924"),
        ({"script": "Cyrl"}, "letters of the script Cyrl"),
        ({"latin": None}, "`latin`"),
        ({"latin": "Γεια, {name}."}, "letters of the script Latn"),
        ({"reviewed_by": "Eleni"}, "`reviewed_on`"),
        ({"reviewed_on": date(2026, 1, 1)}, "`reviewed_by`"),
        ({"text": "Γεια σας."}, "{name} once"),
        ({"text": "Γεια {name}, {name}."}, "{name} once"),
        ({"text": "Γεια {name} {thing}."}, "{name} once"),
        ({"text": "Γεια {name!r}."}, "{name} once"),
        ({"use": "honour"}, "no blank"),
        ({"text": "Hi\nyou, {name}."}, "one line"),
    ],
)
def test_facts_that_contradict_one_another_are_refused(change, expected):
    Wording(**GOOD)
    with pytest.raises(WrongValueError) as refusal:
        Wording(**{**GOOD, **change})
    assert expected in str(refusal.value)


FRENCH = """\
schema_version: 1
language: fr
code: fra
script: Latn
joined: {text: " et "}
wordings:
  - {use: greet, register: plain, text: "Bonjour, {name}."}
  - {use: greet, register: neutral, text: "Bonjour, {name}.", reviewed_by: "Zoé", reviewed_on: 2026-11-02}
  - {use: greet, register: neutral, occasion: first_meeting, text: "Enchanté, {name}."}
"""


def french(text=FRENCH) -> Language:
    from pathlib import Path

    return read_wordings(parse_yaml(text, Path("fr.yaml"), "fr.yaml"))


def test_a_site_may_speak_a_language_of_its_own():
    book = Phrasebook((french(),))
    assert book.code_of("fr-CA") == book.code_of("fra") == "fra"
    speaker = Speaker(phrasebook=book, site="fra", reviewed_only=True)
    known = EVIDENCE.infer({"familiarity": "close"})
    assert speaker.greeting(("anna", "ben"), known).text == "Bonjour, Anna et Ben."
    assert speaker.farewell("anna", known).text == "Bonjour, Anna.", "no plain farewell: a plain greeting"
    stranger = EVIDENCE.infer({"familiarity": "stranger"})
    assert speaker.greeting(("anna",), stranger).wordings[0].register == "plain", "that one is not reviewed"
    free = replace(speaker, reviewed_only=False)
    assert free.greeting(("anna",), stranger).text == "Enchanté, Anna."


def test_a_review_of_a_wording_that_ships_takes_its_place():
    text = """\
schema_version: 1
language: ar
code: ara
script: Arab
wordings:
  - use: greet
    register: neutral
    text: "مرحبًا، {name}."
    latin: "Marhaban, {name}."
    reviewed_by: Amal
    reviewed_on: 2026-11-20
"""
    speaker = Speaker(phrasebook=Phrasebook((french(text),)), reviewed_only=True)
    values = EVIDENCE.infer({}, settings={"greeting_language": "ara"})
    assert speaker.greeting(("anna", "ben"), values).text == "مرحبًا، Anna وBen."
    assert speaker.farewell("anna", values).text == "Goodbye, Anna.", "nobody has reviewed that one"


@pytest.mark.parametrize(
    ("old", "new", "line", "expected"),
    [
        ("script: Latn", "script: Latin", 4, "ISO 15924"),
        ("language: fr", "language: französisch", 2, "BCP 47"),
        ("2026-11-02", "20261102", 8, "a day"),
        ("2026-11-02", "2026-13-02", 8, "a day as YYYY-MM-DD"),
        (", reviewed_on: 2026-11-02", "", 8, "reviewed_on"),
        ('plain, text: "Bonjour, {name}."', 'plain, text: "Bonjour."', 7, "{name} once"),
        ("occasion: first_meeting, ", "", 9, "one wording for each"),
        ("use: greet, register: plain", "use: great, register: plain", 7, "greet"),
        ("code: fra", "code: French", 3, ""),
    ],
)
def test_a_file_of_wordings_is_refused_with_its_line(old, new, line, expected):
    assert old in FRENCH
    with pytest.raises(InputError) as refusal:
        french(FRENCH.replace(old, new, 1))
    assert f"fr.yaml:{line}" in str(refusal.value)
    assert expected in str(refusal.value)


def test_a_language_without_words_is_refused_by_name():
    with pytest.raises(InputError, match="a language that the robot has words in"):
        SHIPPED.code_of("tlh")
    bare = FRENCH.replace("register: plain", "register: informal", 1)
    with pytest.raises(InputError, match="plain greeting"):
        Speaker(phrasebook=Phrasebook((french(bare),)), site="fra", reviewed_only=True).greeting(
            ("a",), EVIDENCE.infer({"familiarity": "stranger"})
        )
