"""The one question: the answer is a wish or an observation, as the person chooses."""

from __future__ import annotations

import sys
from concurrent.futures import ThreadPoolExecutor
from datetime import date, timedelta

import pytest
import yaml
from hypothesis import given, settings
from hypothesis import strategies as st

import comity as front_door
from comity.adaptation.visits import acquainted
from comity.people.learnt_file import LearntFile, Observation, Stated, learnt_on
from comity.people.remembered import remember
from comity.people.store import Store

DAY = date(2026, 1, 1)
STANDING = {"posture": "standing"}


def stated(likes_m: float, days: int = 0) -> Stated:
    return Stated(day=DAY + timedelta(days), situation=STANDING, model_m=0.85, likes_m=likes_m)


def shown(signal: str, distance_m: float = 0.85, days: int = 0) -> Observation:
    return Observation(
        day=DAY + timedelta(days), situation=STANDING, model_m=0.85, distance_m=distance_m, signal=signal
    )


@pytest.fixture
def amal(tmp_path_factory, monkeypatch, comity):
    """Somebody who is kept; her folder."""
    home = tmp_path_factory.mktemp("home")
    monkeypatch.setenv("COMITY_HOME", str(home))
    assert comity("profile", "set", "amal", "culture=DEU", "gender=female").code == 0
    return home / "people" / "amal"


def asked(comity, *words):
    said = comity("profile", "ask", "amal", "--counts-as", "observation", "--at", "2026-01-01", *words)
    assert said.code == 0, said.err
    return said


@settings(max_examples=25)
@given(st.permutations([stated(0.7), stated(1.2), shown("ask_closer"), shown("step_back", 1.0)]))
def test_the_order_of_one_days_words_and_signs_does_not_matter(day):
    """Where they contradict each other, the farther answer and the step back stand."""
    usual = learnt_on(DAY, (stated(0.7), stated(1.2), shown("ask_closer"), shown("step_back", 1.0)), 0.3)
    assert learnt_on(DAY, tuple(day), 0.3) == usual
    assert usual is not None
    assert usual.offset >= 1.2 - 0.85 - 1e-9


@settings(max_examples=25)
@given(st.floats(0.45, 3.0), st.integers(0, 3000))
def test_an_answer_goes_through_the_file_and_back(likes_m, days):
    file = LearntFile(person="amal", conversational_distance=(stated(likes_m, days), shown("nothing")))
    back = LearntFile.model_validate(yaml.safe_load(yaml.safe_dump(file.model_dump(mode="json"))))
    assert back == file
    assert isinstance(back.conversational_distance[0], Stated)


@settings(max_examples=25)
@given(st.floats(0.45, 3.0))
def test_nothing_that_is_said_passes_safety_or_what_may_be_asked_for(likes_m):
    from comity_fis import load_rulebook

    learnt = learnt_on(DAY, (stated(likes_m),), 0.3)
    assert learnt is not None
    book = load_rulebook("bruno2017")
    value = book.infer({}, learnt={"conversational_distance": learnt})["conversational_distance"]
    assert 0.45 <= value.number <= 3.0


def test_the_choice_is_the_persons(comity, amal):
    """The same answer as a wish is followed to the letter, as an observation it is weighed."""
    asked(comity, "--answer", "60 cm")
    weighed = comity("infer", "amal", "--at", "2026-01-01", "--json").json["parameters"]
    assert weighed["conversational_distance"]["origin"] == "learnt"
    assert 0.6 < weighed["conversational_distance"]["value"] < 0.75
    assert comity("profile", "ask", "amal", "--answer", "60 cm").code == 0
    wished = comity("infer", "amal", "--json").json["parameters"]
    assert wished["conversational_distance"]["origin"] == "setting"
    assert wished["conversational_distance"]["value"] == 0.6


def test_an_observation_is_dated_kept_in_its_situation_shown_exported_and_deleted(comity, amal):
    asked(comity, "--answer", "1.2", "--set", "posture=seated")
    document = yaml.safe_load((amal / "learnt.yaml").read_text())
    (kept,) = document["conversational_distance"]
    assert (kept["day"], kept["situation"], kept["likes_m"]) == ("2026-01-01", {"posture": "seated"}, 1.2)
    assert "settings" not in (amal / "profile.yaml").read_text()
    at = ("--at", "2026-01-02", "--json")
    distances = [
        comity("infer", "amal", *words, *at).json["parameters"]["conversational_distance"]["value"]
        for words in ((), ("--set", "posture=seated"))
    ]
    assert distances[0] == pytest.approx(0.825, abs=0.001)
    assert distances[1] == pytest.approx(1.2, abs=0.01)
    assert "seated, said  said on 2026-01-01 to like 1.20 m best" in comity("profile", "show", "amal").out
    assert "likes_m: 1.2" in comity("profile", "export", "amal").out
    assert comity("profile", "export", "amal", "--json").json["learnt"] == document
    assert comity("profile", "reset", "amal", "distance").code == 0
    assert not (amal / "learnt.yaml").exists()


def test_unknown_forgets_what_was_said_and_nothing_else(comity, amal):
    remember("amal", [shown("step_back")])
    asked(comity, "--answer", "1.2")
    asked(comity, "--answer", "unknown")
    (left,) = yaml.safe_load((amal / "learnt.yaml").read_text())["conversational_distance"]
    assert left["signal"] == "step_back"


def test_forgetting_the_only_answer_leaves_no_file(comity, amal):
    asked(comity, "--answer", "1.2")
    asked(comity, "--answer", "unknown")
    assert not (amal / "learnt.yaml").exists()


def test_who_corrects_themselves_on_the_same_day_is_believed(comity, amal):
    """The older answer of that day is gone; one of another day stays, and both count."""
    asked(comity, "--answer", "2.1")
    asked(comity, "--answer", "1.2")
    asked(comity, "--answer", "1.1", "--at", "2026-01-03")
    learnt = yaml.safe_load((amal / "learnt.yaml").read_text())["conversational_distance"]
    assert [one["likes_m"] for one in learnt] == [1.2, 1.1]


def test_an_answer_and_what_meetings_taught_count_together(comity, amal):
    remember("amal", [shown("step_back", 0.85), shown("step_back", 0.9, days=-30)])
    answer = asked(comity, "--answer", "1.0", "--json").json
    assert answer["counts_as"] == "observation"
    assert answer["value"]["value"] >= 1.0
    text = answer["value"]["contributions"][-1]["text"]
    assert "stepped back twice" in text
    assert "said on 2026-01-01 to like 1.00 m best" in text


def test_a_wish_goes_before_an_answer_that_is_only_weighed_and_says_so(comity, amal):
    comity("profile", "set", "amal", "distance=0.9")
    said = asked(comity, "--answer", "1.2")
    assert "A wish goes before it" in said.out
    assert "is met at 0.90 m" in said.out
    (kept,) = yaml.safe_load((amal / "learnt.yaml").read_text())["conversational_distance"]
    assert kept["model_m"] == pytest.approx(0.825, abs=0.001)


@pytest.mark.parametrize("answer", ["9", "20 cm", "near", "-1", "nan"])
def test_an_answer_that_could_not_be_granted_is_refused_and_nothing_is_written(comity, amal, answer):
    said = comity("profile", "ask", "amal", "--answer", answer, "--counts-as", "observation")
    assert said.code == 2
    assert "conversational_distance" in said.err
    assert {path.name for path in amal.iterdir()} == {"consent.yaml", "profile.yaml"}


def test_only_the_situation_can_be_told_beside_an_answer(comity, amal):
    said = comity("profile", "ask", "amal", "--answer", "1", "--set", "culture=SWE")
    assert said.code == 2
    assert "describes the situation" in said.err
    assert "posture" in said.err


def test_at_the_terminal_both_are_asked(comity, amal, monkeypatch):
    """First how near, then how that is to count."""
    said = iter(["1.2", "observation"])
    questions = []

    def prompt(question, **_):
        questions.append(question)
        return next(said)

    monkeypatch.setattr(sys.stdin, "isatty", lambda: True)
    monkeypatch.setattr("typer.prompt", prompt)
    assert comity("profile", "ask", "amal").code == 0
    assert "how near may the robot come to you" in questions[0]
    assert "weighed with what you show" in questions[1]
    assert (amal / "learnt.yaml").exists()


def test_from_python_what_was_said_counts_too(comity, amal):
    asked(comity, "--answer", "1.2")
    value = front_door.infer("amal", at="2026-01-01")["conversational_distance"]
    assert value.number == pytest.approx(1.2, abs=0.01)
    seated = front_door.infer("amal", at="2026-01-01", posture="seated")
    seated = seated["conversational_distance"]
    assert seated.number == pytest.approx(0.825, abs=0.001)


def test_of_two_that_learn_at_the_same_time_neither_is_lost(amal):
    """Sixteen at once, each with one observation of its own day."""
    with ThreadPoolExecutor(8) as pool:
        assert all(pool.map(lambda days: remember("amal", [shown("nothing", days=days)]), range(16)))
    learnt = Store().learnt("amal")
    assert learnt is not None
    days = {one["day"] for one in learnt["conversational_distance"]}
    assert days == {(DAY + timedelta(days)).isoformat() for days in range(16)}


def test_an_answer_of_a_later_day_counts_from_that_day_on_and_no_visit_before_it_uses_it(comity, amal):
    words = ["--answer", "1.1", "--counts-as", "observation"]
    said = comity("profile", "ask", "amal", *words, "--at", "2099-01-01")
    assert said.code == 0
    assert "It counts from that day on." in " ".join(said.out.split())
    now, _ = acquainted("amal", "bruno2017", every_days=30, begin=None, seed=0)
    then, _ = acquainted("amal", "bruno2017", every_days=30, begin=date(2099, 1, 1), seed=0)
    assert now.begin == date.today()
    assert len(then.known) == len(now.known) + 1


def test_an_answer_holds_in_the_posture_that_the_person_declared(comity, amal):
    """Who is seated as a rule is asked, shown and met as one who sits; standing, nothing of it counts."""
    comity("profile", "set", "amal", "posture=Seated")
    said = comity("profile", "ask", "amal", "--answer", "1.2", "--counts-as", "observation", "--json").json
    assert said["situation"] == {"posture": "seated"}
    for words in (["profile", "show", "amal"], ["infer", "amal"]):
        assert "learnt" in {
            part["origin"] for part in distance(comity(*words, "--json").json)["contributions"]
        }
    standing = distance(comity("infer", "amal", "--set", "posture=standing", "--json").json)
    assert "learnt" not in {part["origin"] for part in standing["contributions"]}


def distance(answer) -> dict:
    return answer.get("values", answer)["parameters"]["conversational_distance"]
