"""What the robot says to whom: a stated language, the form of address, reviewed words on a real robot."""

from __future__ import annotations

import json
from datetime import date, timedelta

import pytest
import yaml
from gliding import SCENARIO, gliding
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

import comity
from comity.monitoring.consenting import consenting
from comity.parameters.values import infer_for
from comity.people.language import ALSO
from comity.people.profile import Declared, Profile
from comity.preparation import prepare
from comity.scenario import load_scenario
from comity_executor import Speaker
from comity_fis import load_rulebook

EVIDENCE = load_rulebook("evidence")
STEREOTYPES = """\
schema_version: 1
name: stereotypes
description: What no rulebook should say, to see that it is not heeded against a person's own words.
sources: {none: {citation: "made up for a test", found: nothing, measured: nothing, verified: nothing}}
variables:
  culture: {kind: culture, level: nominal, categories_from: individualism, reason: made up}
parameters:
  greeting_language:
    kind: action
    level: nominal
    categories: [eng, ara, deu, jpn, swe]
    neutral: eng
    reasons: {categories: made up, neutral: made up}
  greeting_modality:
    kind: action
    level: nominal
    categories: [verbal, gestural, both]
    neutral: both
    reasons: {categories: made up, neutral: made up}
  greeting_gesture:
    kind: action
    level: nominal
    categories: [wave, nod, bow]
    neutral: nod
    reasons: {categories: made up, neutral: made up}
rules:
"""
FOREIGN = {"JPN": ("jpn", "bow", "gestural"), "EGY": ("ara", "wave", "both"), "DEU": ("deu", "nod", "verbal")}


def stereotypes():
    """A rulebook in which language, gesture and modality follow from the nationality alone."""
    from pathlib import Path

    from comity_fis.validation.yaml_file import parse_yaml

    rules = "".join(
        f"  - {{rule: if culture is {code} then {parameter} is {value}, sources: [none], evidence: weak}}\n"
        for code, values in FOREIGN.items()
        for parameter, value in zip(
            ("greeting_language", "greeting_gesture", "greeting_modality"), values, strict=True
        )
    )
    return load_rulebook(parse_yaml(STEREOTYPES + rules, Path("s.yaml"), "s.yaml"))


def of(**facts):
    return Declared(Profile.model_validate({"name": "p", **facts}), None)


COUNTRY = st.sampled_from([*FOREIGN, "SWE", "GBR", "Kurdish", "Arab countries"])
SPOKEN = st.lists(st.sampled_from([*ALSO, "Kurdish", "fra"]), min_size=1, max_size=3, unique=True)
BOOKS = {"evidence": EVIDENCE, "stereotypes": stereotypes()}
BOOK = st.sampled_from(sorted(BOOKS))


@given(COUNTRY, COUNTRY, st.none() | SPOKEN, BOOK, st.sampled_from([None, "swe"]))
def test_no_language_follows_from_a_nationality(one, other, languages, book, site):
    """Whoever declares another culture is spoken to in the same language: one they stated, or the site's."""
    stated = {} if languages is None else {"languages": languages}
    spoken = {
        infer_for(of(culture=culture, **stated), BOOKS[book], site=site)["greeting_language"].value
        for culture in (one, other)
    }
    known = [language for language in languages or () if language in ALSO]
    assert spoken == {known[0] if known else site or "eng"}


@given(COUNTRY, COUNTRY, st.sampled_from(["wave", "nod", "bow"]), st.sampled_from([*ALSO]), BOOK)
def test_no_greeting_follows_from_a_nationality_where_the_person_asked_for_another(
    one, other, gesture, language, book
):
    wishes = {"greeting_gesture": gesture, "greeting_modality": "both", "greeting_language": language}
    for culture in (one, other):
        values = infer_for(of(culture=culture, languages=["swe"], settings=wishes), BOOKS[book])
        assert {name: values[name].value for name in wishes} == wishes


def test_a_rule_that_would_take_a_language_from_a_nationality_is_told():
    values = infer_for(of(culture="JPN"), BOOKS["stereotypes"])
    assert values["greeting_language"].origin == "neutral"
    assert any("it follows from a nationality alone" in note for note in values.notes)
    stated = infer_for(of(culture="JPN", languages=["de-AT"]), BOOKS["stereotypes"])["greeting_language"]
    assert (stated.value, stated.origin) == ("deu", "situation")
    assert stated.contributions[0].text == "they said that they speak de-AT"


@pytest.fixture
def meet(here):
    """Run a scenario of one visit with a profile and further keys."""

    def met(profile: dict, robot=None, **more):
        scenario = yaml.safe_load(SCENARIO)
        scenario |= {"rulebook": "evidence", "adults_only": True, **more.pop("keys", {})}
        scenario["people"]["host"]["profile"] = {"schema_version": 1, "name": "p", **profile}
        path = here / "said.scenario.yaml"
        path.write_text(yaml.safe_dump(scenario, allow_unicode=True), encoding="utf-8")
        return comity.run(path, robot=robot, **more)

    return met


def performed(robot):
    return [act for act in robot.told("perform") if act.text]


def said_to(episode, person="host"):
    return [act.text for act in episode.acts if act.person == person and act.text]


ARABIC = {"languages": ["Arabic"]}
OKAFOR = {"form_of_address": {"name": "Okafor", "title": "Dr", "pronunciation": "oh-KAH-for"}}


def test_the_simulated_robot_says_unreviewed_words_and_a_real_one_a_plain_greeting(meet):
    assert said_to(meet(ARABIC)) == ["مرحبًا، Host."]
    robot = gliding()
    assert said_to(meet(ARABIC, robot)) == ["Hello, Host."]
    assert [act.text for act in performed(robot) if act.to == "host"] == ["Hello, Host."]
    assert said_to(meet(ARABIC, gliding(), unreviewed_wordings=True)) == ["مرحبًا، Host."]
    assert said_to(meet(ARABIC, gliding(), site_language="sv")) == ["Hej, Host."]
    assert said_to(meet({"settings": {"formality": 0.9}}, gliding())) == ["Hello, Host."]
    assert said_to(meet({"settings": {"formality": 0.9}})) == ["Good day, Host."]


REVIEWED = """\
schema_version: 1
language: ar
code: ara
script: Arab
wordings:
  - use: greet
    register: neutral
    text: "مرحبًا، {name}."
    latin: "Marhaban, {name}."
    reviewed_by: Amal, a native speaker
    reviewed_on: 2026-11-20
"""


def test_a_review_that_is_still_to_come_is_none(comity, here):
    later = date.today() + timedelta(days=1)
    (here / "w.wordings.yaml").write_text(REVIEWED.replace("2026-11-20", str(later)), encoding="utf-8")
    said = comity("run", "johanna", "--wordings", "w.wordings.yaml")
    assert (said.code, said.out) == (2, "")
    assert "w.wordings.yaml:11" in said.err
    assert "in the future" in said.err


def test_a_real_robot_says_what_the_site_has_reviewed(meet, here):
    (here / "reviewed.wordings.yaml").write_text(REVIEWED, encoding="utf-8")
    keys = {"wordings": ["reviewed.wordings.yaml"], "site_language": "German"}
    assert said_to(meet(ARABIC, gliding(), keys=keys)) == ["مرحبًا، Host."]
    assert said_to(meet(ARABIC, gliding(), wordings=["reviewed.wordings.yaml"])) == ["مرحبًا، Host."]
    assert said_to(meet({}, gliding(), keys=keys)) == ["Hallo, Host."]


def test_a_run_holds_the_wordings_of_its_site_and_runs_again_from_its_folder_alone(meet, here):
    (here / "reviewed.wordings.yaml").write_text(REVIEWED.replace("مرحبًا", "مرحبا"), encoding="utf-8")
    meet({**ARABIC, **OKAFOR}, wordings=["reviewed.wordings.yaml"], site_language="Swedish", out="first")
    (here / "reviewed.wordings.yaml").unlink()
    again = comity.run("first/scenario.yaml", out="second")
    assert said_to(again) == ["مرحبا، Dr Okafor."]
    one, other = (json.loads((here / name / "run.json").read_text("utf-8")) for name in ("first", "second"))
    assert one["trace_sha256"] == other["trace_sha256"]
    assert one["acts"] == other["acts"]


def test_a_run_says_of_each_wording_its_facts(meet, here):
    meet({**ARABIC, **OKAFOR}, out="run")
    run = json.loads((here / "run" / "run.json").read_text("utf-8"))
    (act,) = [act for act in run["acts"] if act["person"] == "host" and act["text"]]
    assert (act["text"], act["latin"]) == ("مرحبًا، Dr Okafor.", "Marhaban, Dr Okafor.")
    assert act["spoken"] == "مرحبًا، Dr oh-KAH-for."
    assert act["wordings"] == [
        {
            "use": "greet",
            "language": "ar",
            "script": "Arab",
            "register": "neutral",
            "occasion": None,
            "text": "مرحبًا، {name}.",
            "latin": "Marhaban, {name}.",
            "reviewed_by": None,
            "reviewed_on": None,
        }
    ]


def test_what_a_person_is_called_is_said_to_the_person_and_by_the_robot(meet):
    robot = gliding()
    assert said_to(meet(OKAFOR, robot)) == ["Hello, Dr Okafor."]
    (act,) = [act for act in performed(robot) if act.to == "host"]
    assert (act.spoken, act.language) == ("Hello, Dr oh-KAH-for.", "en")
    assert said_to(meet({"form_of_address": "Frau Host"})) == ["Hello, Frau Host."]


def test_a_robot_that_is_not_sure_who_it_is_says_no_form_of_address(meet):
    robot = gliding(sure_of={"host": None, "guest": None})
    robot.people["guest"] = (3.0, 3.8, 180.0)  # their tracks have met
    meet(OKAFOR, robot)
    texts = [act.text for act in performed(robot)]
    assert "Hello." in texts
    assert not [text for text in texts if "Okafor" in text or "Host" in text]
    assert not [act for act in performed(robot) if "KAH" in act.spoken]


@settings(max_examples=15, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(st.sampled_from([*ALSO]), st.sampled_from([*ALSO]), st.floats(0, 1), st.floats(0, 1))
def test_a_real_robot_never_says_an_unreviewed_word_that_is_not_plain(meet, site, language, formality, style):
    wishes = {"formality": formality, "rhetorical_style": style, "verbal_directness": style}
    episode = meet({"languages": [language], "settings": wishes}, gliding(), site_language=site)
    wordings = [one for act in episode.acts if act.utterance for one in act.utterance.wordings]
    assert wordings
    assert all(one.register == "plain" for one in wordings)
    assert {one.language for one in wordings} == {Speaker().phrasebook[site].tag}


@pytest.mark.parametrize(
    ("arguments", "expected"),
    [
        (("--site-language", "Klingon"), "a language that the robot has words in"),
        (("--wordings", "none.yaml"), "none.yaml"),
        (("--wordings", "bad.yaml"), "bad.yaml:4: expected a script by its ISO 15924 code"),
        (("--unreviewed-wordings",), "without --robot"),
    ],
)
def test_what_cannot_be_spoken_is_refused_before_anything_is_written(comity, here, arguments, expected):
    (here / "bad.yaml").write_text(REVIEWED.replace("Arab", "Arabic"), encoding="utf-8")
    said = comity("run", "johanna", *arguments)
    assert said.code == 2
    assert expected in said.err
    assert not (here / "runs").exists()


def test_a_scenarios_wordings_are_refused_with_their_line(comity, here):
    text = SCENARIO.rstrip() + "\nsite_language: tlh\n"
    (here / "said.scenario.yaml").write_text(text, encoding="utf-8")
    said = comity("run", "said.scenario.yaml")
    assert said.code == 2
    assert f"said.scenario.yaml:{text.count(chr(10))}: expected a language" in said.err
    inline = "\n".join(
        f"    {line}" for line in REVIEWED.replace('{name}."\n    latin', '"\n    latin').splitlines()
    )
    (here / "said.scenario.yaml").write_text(
        f"{SCENARIO.rstrip()}\nwordings:\n  -\n{inline}\n", encoding="utf-8"
    )
    said = comity("run", "said.scenario.yaml")
    assert said.code == 2
    assert "said.scenario.yaml:" in said.err
    assert "{name} once" in said.err


def test_explain_shows_the_words_and_who_reviewed_them(comity):
    said = comity("explain", "formality", "--set", "language=ara", "--rulebook", "evidence", "--json")
    wordings = said.json["wordings"]
    assert {one["use"] for one in wordings} == {"greet", "hand_over", "take_leave", "ask_to_pass"}
    assert {one["language"] for one in wordings} == {"ar"}
    assert {one["reviewed_by"] for one in wordings} == {None}
    assert "not reviewed" in comity("explain", "formality", "--rulebook", "evidence").out
    assert comity("explain", "approach_speed", "--json").json["wordings"] == []


def test_an_episode_keeps_what_was_said_with_its_facts_when_it_is_pickled(meet):
    import pickle

    episode = pickle.loads(pickle.dumps(meet(ARABIC)))
    (act,) = [act for act in episode.acts if act.person == "host" and act.text]
    assert act.utterance.wordings[0].language == "ar"


def test_a_run_that_is_passed_on_tells_neither_how_a_person_is_called_nor_what_was_said(meet, comity, here):
    meet({**ARABIC, **OKAFOR}, out="run")
    assert comity("share", "run", "--out", "shared").code == 0
    told = "".join(path.read_text("utf-8") for path in (here / "shared").glob("*.*") if path.suffix != ".png")
    whole = "".join(path.read_text("utf-8") for path in (here / "run").glob("*.*") if path.suffix != ".png")
    for secret in ("Okafor", "KAH", "مرحب", "Marhaban", "form_of_address"):
        assert secret in whole
        assert secret not in told.replace("form_of_address: {", "")


def test_an_expectation_takes_words_in_their_script_or_in_latin_letters(comity, here):
    scenario = yaml.safe_load(SCENARIO) | {"rulebook": "evidence"}
    scenario["people"]["host"]["profile"] = {"schema_version": 1, "name": "p", **ARABIC}
    scenario["expect"] = ["host hears 'مرحبًا'", "host hears 'Marhaban, Host'", "host never hears 'Hello'"]
    (here / "said.scenario.yaml").write_text(yaml.safe_dump(scenario, allow_unicode=True), encoding="utf-8")
    said = comity("test", "said.scenario.yaml")
    assert said.code == 0, said.out


def test_what_is_said_on_the_way_and_consent_leave_the_language_of_the_site(here):
    """A wish on the way, and an operator's word, are one inference more: it knows the site, too."""
    text = (
        SCENARIO.replace("rulebook: bruno2017", "rulebook: evidence").rstrip() + "\nsite_language: Swedish\n"
    )
    changes = "changes: [{at_s: 1, person: guest, says: {conversational_distance: 1.0}}]\n"
    (here / "one.scenario.yaml").write_text(text + changes)
    prepared = prepare(load_scenario("one.scenario.yaml"))
    episode = comity.run("one.scenario.yaml")
    (revision,) = [one for one in episode.revisions if one.was_asked_for]
    assert revision.values["guest"]["conversational_distance"].value == 1.0
    assert revision.values["guest"]["greeting_language"].value == "swe"
    consented = consenting(prepared, prepared.values["guest"], "guest", given=True, t=2.0)
    assert consented["greeting_language"].value == "swe"


def test_the_summary_has_what_was_said_to_people_who_were_only_passed(comity, here) -> None:
    said = " ".join(comity("run", "asks-to-pass", "--out", "run").out.split())
    assert "yumi 5.0 s" in said
    assert "guest 15.1 s" in said
