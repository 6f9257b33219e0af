"""Contact needs consent: a wish for no touch is honoured, and a wish for contact rests without consent."""

from __future__ import annotations

import json
import re
from datetime import date
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import comity as front_door
import comity_fis
from comity.parameters.consent import STORED_NOTE
from comity.parameters.values import infer_for
from comity.people.profile import Declared, Profile
from comity.people.store import Store
from comity.preparation import prepare
from comity.scenario import load_scenario
from comity_fis import NumericParameter, load_rulebook, shipped_rulebooks
from comity_sim2d.base.drive import NEAR_PEOPLE_M_S

FORMAL = {"name": "jonas", "culture": "DEU", "formality": "formal", "touch_consent": "given"}
BOOKS = [book for book in map(load_rulebook, shipped_rulebooks()) if "greeting_gesture" in book.parameters]
GUARDED = [book for book in BOOKS if "touch_consent" in book.variables]
ROOM = """\
schema_version: 1
name: room
place: {width_m: 8, height_m: 6}
robot: {at_m: [1, 3]}
rulebook: BOOK
people:
  jonas: {profile: PROFILE, at_m: [6, 3], facing_deg: 180, situation: {SAYS}}
goals:
  - greet: jonas
"""


def of(**facts):
    return Declared(Profile.model_validate({**FORMAL, **facts}), None)


def in_the_room(here, profile, book="evidence", more="", says="touch_consent: given"):
    """By default the person consents to touch in this meeting."""
    text = ROOM.replace("BOOK", book).replace("PROFILE", json.dumps(profile)).replace("SAYS", says)
    (here / "room.scenario.yaml").write_text(text + more)
    return "room.scenario.yaml"


@pytest.mark.parametrize("book", [book.name for book in GUARDED])
def test_whoever_asked_for_no_touch_is_not_shaken_by_the_hand(comity, here, book):
    """Also with consent given and rules that otherwise shake hands; plan and run say why."""
    asked = {**FORMAL, "settings": {"touch": "none"}}
    touching = comity("plan", in_the_room(here, FORMAL, book), "--json").json
    assert "handshake" in touching["steps"][1]["arguments"]
    plan = comity("plan", in_the_room(here, asked, book), "--why", "2")
    assert (
        "handshake" not in plan.out.partition("is not possible")[0].partition("Greet_person")[2].split(")")[0]
    )
    assert "they asked for no touch" in plan.out
    run = comity("run", "room.scenario.yaml", "--out", "run", "--json").json
    assert "handshake" not in str(run["visits"][0]["greeting"])
    notes = comity("run", "room.scenario.yaml", "--out", "run2").out
    assert "consent to touch counts as withheld" in " ".join(notes.split())


@given(
    st.sampled_from(GUARDED),
    st.sampled_from(["given", "withheld", "unknown"]),
    st.sampled_from(["DEU", "JPN", "unknown"]),
    st.sampled_from(["formal", "informal", "unknown"]),
)
def test_no_touch_is_honoured_whatever_else_is_said(book, consent, culture, formality):
    told = {"touch_consent": consent, "culture": culture, "formality": formality}
    answer = infer_for(of(**told, settings={"touch": "none"}), book, situation={"touch_consent": "given"})
    gesture = answer["greeting_gesture"]
    assert gesture.word != "handshake"
    assert "handshake" not in gesture.desirability.memberships
    assert not [note for note in answer.notes if "no effect" in note]


def test_contact_without_touch_is_refused_in_a_file_and_when_it_is_set(comity, here, home):
    (here / "a.yaml").write_text(
        "name: a\ntouch_consent: given\nsettings: {greeting_gesture: handshake, touch: none}\n"
    )
    for book in (book.name for book in GUARDED):
        said = comity("infer", "a.yaml", "--rulebook", book)
        assert (said.code, "a.yaml:3" in said.err) == (2, True)
        assert "handshake with touch: none" in said.err
    said = comity("profile", "set", "a", "touch_consent=given", "gesture=handshake", "touch=none")
    assert (said.code, "handshake with touch: none" in said.err) == (2, True)
    assert comity("profile", "set", "a", "touch_consent=given", "gesture=wave", "touch=none").code == 0


def test_no_touch_that_is_asked_for_on_the_way_is_honoured(here):
    asks = "changes:\n  - {at_s: 2, person: jonas, says: {touch: none}}\n"
    assert "handshake" in str(front_door.run(in_the_room(here, FORMAL)).acts)
    asked = front_door.run(in_the_room(here, FORMAL, more=asks))
    assert asked.acts
    assert "handshake" not in str(asked.acts)


@pytest.mark.parametrize("consent", ["withheld", "unknown"])
def test_consent_can_be_taken_back_at_any_time(comity, here, home, consent):
    """The wish for contact is kept and rests; it holds again when consent is given again."""
    assert comity("profile", "set", "s1", "touch_consent=given", "gesture=handshake").code == 0
    assert comity("infer", "s1", "--json").json["parameters"]["greeting_gesture"]["value"] == "handshake"
    said = comity("infer", "s1", "--set", f"touch_consent={consent}", "--json")
    assert said.code == 0
    assert said.json["parameters"]["greeting_gesture"]["value"] != "handshake"
    assert comity("profile", "set", "s1", f"touch_consent={consent}").code == 0
    for book in (book.name for book in GUARDED):
        assert comity("explain", "greeting_gesture", "s1", "--rulebook", book).code == 0
        for words in (["infer", "s1"], ["profile", "show", "s1"]):
            said = comity(*words, "--rulebook", book)
            assert "rests, because it requires that touch consent is given" in " ".join(said.out.split())
    run = comity("run", "johanna", "--as", "johanna=s1", "--out", "run")
    assert "rests, because" in " ".join(run.out.split())
    assert "handshake" not in str(comity("run", "run/scenario.yaml", "--out", "b", "--json").json["visits"])
    assert comity("profile", "set", "s1", "touch_consent=given").code == 0
    assert comity("infer", "s1", "--json").json["parameters"]["greeting_gesture"]["value"] == "handshake"


def test_consent_with_a_date_counts_from_its_day():
    dated = [{"from": "2020-01-01", "value": "given"}, {"from": "2025-01-01", "value": "withheld"}]
    asked = of(touch_consent=dated, settings={"greeting_gesture": "handshake"})
    words = {
        day.year: infer_for(asked, book, at=day)["greeting_gesture"].word
        for book in GUARDED
        for day in (date(2019, 6, 1), date(2024, 6, 1), date(2025, 6, 1))
    }
    assert [word == "handshake" for word in words.values()] == [False, True, False]


def test_a_wish_for_contact_rests_in_every_culture_of_a_person():
    asked = of(
        culture={"DEU": 1, "JPN": 1}, touch_consent="unknown", settings={"greeting_gesture": "handshake"}
    )
    for book in GUARDED:
        answer = infer_for(asked, book)
        assert answer["greeting_gesture"].word != "handshake"
        assert sum("rests" in note for note in answer.notes) == 1


@pytest.mark.parametrize("wish", ["gesture=handshake", "touch=accept"])
def test_a_new_wish_for_contact_is_refused_while_consent_is_missing(comity, home, wish):
    assert comity("profile", "set", "s1", "touch_consent=withheld", "gesture=wave").code == 0
    kept = Store().path("s1").read_text()
    said = comity("profile", "set", "s1", wish)
    assert (said.code, "touch_consent is given" in said.err) == (2, True)
    assert Store().path("s1").read_text() == kept


@pytest.mark.parametrize("book", BOOKS, ids=lambda book: book.name)
def test_nobody_may_ask_for_more_speed_than_the_robot_keeps_near_people(book):
    speed = book.parameters["approach_speed"]
    assert isinstance(speed, NumericParameter)
    assert speed.ask.high == NEAR_PEOPLE_M_S
    assert any(words in speed.reasons["ranges"] for words in ("0.5 m/s", "Those of the rulebook bruno2017"))


@pytest.mark.parametrize("speed", [0.6, 0.7])
def test_a_wish_for_more_speed_is_refused_with_the_most_that_is_granted(comity, here, home, speed):
    (here / "a.yaml").write_text(f"name: a\nsettings: {{approach_speed: {speed}}}\n")
    for words in (["infer", "a.yaml"], ["profile", "set", "a", f"speed={speed}"]):
        said = comity(*words)
        assert (said.code, "0.1..0.5 m/s" in said.err) == (2, True)
    assert comity("profile", "set", "a", "speed=0.5").code == 0


CULTURES = ("DEU", "SWE", "JPN", "Arab countries", None)
SAID = st.sampled_from(["", "touch_consent: withheld", "touch_consent: unknown"])


@settings(max_examples=20)
@given(
    stored=st.sampled_from(["given", "withheld", None]),
    says=SAID,
    culture=st.sampled_from(CULTURES),
    wish=st.booleans(),
    book=st.sampled_from([book.name for book in GUARDED]),
)
def test_nobody_is_touched_who_did_not_consent_in_this_meeting(tmp_path_factory, **case):
    """Whatever is stored of them; what they asked for rests, and the plan says why."""
    stored, says, wish = case["stored"], case["says"], case["wish"]
    wishes = {"greeting_gesture": "handshake"} if wish else {}
    profile = {**FORMAL, "culture": case["culture"], "touch_consent": stored, "settings": wishes}
    folder = tmp_path_factory.mktemp("meeting")
    path = folder / in_the_room(folder, profile, case["book"], says=says)
    prepared = prepare(load_scenario(str(path)))
    (greet,) = (step for step in prepared.plan.steps if step.action == "Greet_person")
    assert greet.arguments[-1] != "handshake"
    if wish:
        assert "rests, because it requires that touch consent is given" in greet.why.text
    else:
        out = {ruled.arguments[-1]: ruled.reason for ruled in greet.why.ruled_out}
        assert "touch consent is given" in out["handshake"]
    notes = prepared.values["jonas"].notes
    assert (STORED_NOTE in notes) == (stored == "given" and not says)


def test_consent_that_is_given_on_the_way_counts_from_then_on(here):
    """The hand is shaken, which no plan before had."""
    gives = "changes:\n  - {at_s: 2, person: jonas, situation: {touch_consent: given}}\n"
    stored = in_the_room(here, FORMAL, says="", more=gives)
    episode = front_door.run(stored)
    assert not [step for step in episode.prepared.plan.steps if "handshake" in step.arguments]
    assert "handshake" in [act.act for act in episode.acts]


def test_a_rulebook_that_touches_without_asking_is_refused(here, comity):
    book = (Path(comity_fis.__file__).parent / "rulebooks" / "bruno2017.yaml").read_text(encoding="utf-8")
    book = re.sub(r"\n +requires: \{handshake: .*", "", book)
    (here / "grabs.yaml").write_text(book, encoding="utf-8")
    said = comity("plan", in_the_room(here, FORMAL, "./grabs.yaml"))
    assert said.code == 2
    assert "requires: {handshake: touch_consent is given}" in " ".join(said.err.split())
