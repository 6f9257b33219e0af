"""Learning with a person: what is remembered, what follows from it, and what a run never touches."""

from __future__ import annotations

import json
from datetime import date, timedelta
from itertools import permutations
from pathlib import Path

import pytest
import yaml
from hypothesis import given, settings
from hypothesis import strategies as st
from PIL import Image

from comity.people.learnt_file import LearntFile, Observation, comfort_on, learnt_on
from comity_fis import load_rulebook
from comity_fis.learning.signals import SIGNALS

BOOK = load_rulebook("bruno2017")
DAY = date(2026, 1, 1)
STANDING = {"posture": "standing"}

observations = st.lists(
    st.builds(
        Observation,
        day=st.integers(0, 200).map(lambda days: DAY + timedelta(days)),
        situation=st.just(STANDING),
        model_m=st.just(0.85),
        distance_m=st.floats(0.3, 1.4),
        signal=st.sampled_from(SIGNALS),
    ),
    max_size=5,
).map(tuple)


def seen(signal: str, distance_m: float = 0.85, days: int = 0, **situation: str) -> Observation:
    return Observation(
        day=DAY + timedelta(days),
        situation=situation or STANDING,
        model_m=0.85,
        distance_m=distance_m,
        signal=signal,
    )


@pytest.fixture
def home(here, monkeypatch) -> Path:
    """A store of its own."""
    monkeypatch.setenv("COMITY_HOME", str(here / "home"))
    return here / "home"


@pytest.fixture
def anna(home, comity) -> Path:
    """Somebody who is kept; the file of what is learnt with her."""
    assert comity("profile", "set", "anna", "culture=DEU", "gender=female").code == 0
    return home / "people" / "anna" / "learnt.yaml"


@settings(max_examples=25)
@given(st.permutations([("step_back", 0.9), ("ask_closer", 0.9), ("lean_in", 1.2), ("turn_away", 0.8)]))
def test_the_order_of_what_was_seen_on_one_day_does_not_matter(signals):
    """Not even where it contradicts itself."""
    usual = tuple(seen(signal, at) for signal, at in sorted(signals))
    known = learnt_on(DAY, tuple(seen(signal, at) for signal, at in signals), 0.3)
    assert known == learnt_on(DAY, usual, 0.3)


@settings(max_examples=25)
@given(observations, st.randoms())
def test_what_is_learnt_depends_on_the_observations_alone(history, chance):
    """Shuffled, and through the file and back, it is the same to the bit."""
    day = DAY + timedelta(250)
    shuffled = list(history)
    chance.shuffle(shuffled)
    written = LearntFile(person="anna", conversational_distance=tuple(shuffled)).model_dump(mode="json")
    back = LearntFile.model_validate(yaml.safe_load(yaml.safe_dump(json.loads(json.dumps(written)))))
    assert learnt_on(day, back.conversational_distance, 0.3) == learnt_on(day, history, 0.3)


@settings(max_examples=25)
@given(observations)
def test_nothing_that_is_learnt_passes_safety_or_what_may_be_asked_for(history):
    learnt = learnt_on(DAY + timedelta(250), history, 0.3)
    known = {"conversational_distance": learnt} if learnt else {}
    value = BOOK.infer({"individualism": 38, "gender": "female"}, learnt=known)["conversational_distance"]
    assert 0.45 <= value.number <= 3.0
    assert sum(part.value for part in value.contributions) == pytest.approx(value.number)


@settings(max_examples=25)
@given(observations, st.floats(0.5, 2.5))
def test_what_the_person_asked_for_goes_before_what_was_learnt(history, wish):
    learnt = learnt_on(DAY + timedelta(250), history, 0.3)
    known = {"conversational_distance": learnt} if learnt else {}
    value = BOOK.infer({}, settings={"conversational_distance": wish}, learnt=known)
    assert value["conversational_distance"].number == wish


def test_what_was_seen_later_is_not_known_yet():
    history = (seen("step_back"), seen("step_back", 1.0, days=30))
    assert learnt_on(DAY + timedelta(10), history, 0.3) == learnt_on(DAY + timedelta(10), history[:1], 0.3)
    assert learnt_on(DAY - timedelta(1), history, 0.3) is None


def test_the_cautious_reading_of_a_contradictory_day_stands():
    """Invited and stepped back at one place on one day, in whatever order: the robot comes no nearer."""
    for history in permutations([seen("ask_closer", 0.85), seen("step_back", 0.85)]):
        assert float(comfort_on(DAY, history, 0.3).nearest) >= 0.0


def test_words_say_what_was_seen():
    learnt = learnt_on(DAY, (seen("step_back"), seen("step_back"), seen("nothing")), 0.3)
    assert learnt is not None
    assert learnt.text == "3 visits, last on 2026-01-01: stepped back twice, showed nothing"


def test_only_what_was_seen_in_the_same_situation_counts():
    file = LearntFile(person="anna", conversational_distance=(seen("step_back", posture="seated"),))
    assert file.in_situation(STANDING) == ()
    assert len(file.in_situation({"posture": "seated"})) == 1


def test_run_learn_remembers_and_the_next_run_goes_by_it(comity, anna):
    """The guest wants 0.95 to 1.25 m, and the model says 0.85."""
    said = comity("run", "acquaintance", "--as", "guest=anna", "--learn", "--at", "2026-01-01", "--json")
    assert said.code == 0, said.err
    visit = said.json["visits"][0]
    assert visit["noticed"] in {"step_back", "ask_farther", "turn_away"}
    document = yaml.safe_load(anna.read_text())
    assert [(one["day"], one["signal"]) for one in document["conversational_distance"]] == [
        ("2026-01-01", visit["noticed"])
    ]
    assert [one["simulated"] for one in document["conversational_distance"]] == [True]
    again = comity("run", "acquaintance", "--as", "guest=anna", "--at", "2026-01-02", "--json").json
    assert again["visits"][0]["distance_wanted_m"] >= visit["distance_wanted_m"]
    assert "learnt" in {part["origin"] for part in _contributions(again)}


def _contributions(run):
    return run["values"]["guest"]["parameters"]["conversational_distance"]["contributions"]


def test_a_run_without_learn_writes_nothing_to_the_store(comity, anna, home):
    comity("visits", "anna", "--times", "1", "--wants", "1.1..1.3", "--at", "2026-01-01", "--keep")
    before = {path: path.read_bytes() for path in home.rglob("*") if path.is_file()}
    assert comity("run", "acquaintance", "--as", "guest=anna").code == 0
    assert {path: path.read_bytes() for path in home.rglob("*") if path.is_file()} == before


def test_a_run_embeds_what_was_learnt_and_repeats_without_the_store(comity, anna):
    comity("visits", "anna", "--times", "2", "--wants", "1.1..1.3", "--at", "2026-01-01", "--keep")
    one = comity(
        "run", "acquaintance", "--as", "guest=anna", "--at", "2026-02-01", "--out", "run", "--json"
    ).json
    assert comity("profile", "delete", "anna", "--yes").code == 0
    assert not anna.parent.exists()
    other = comity("run", "run/scenario.yaml", "--json").json
    assert other["trace_sha256"] == one["trace_sha256"]
    assert other["visits"][0]["distance_wanted_m"] == one["visits"][0]["distance_wanted_m"]


def test_learning_is_refused_before_anything_is_written_where_nobody_is_kept(comity, here):
    said = comity("run", "johanna", "--learn")
    assert said.code == 2
    assert "kept on this machine" in said.err
    assert not (here / "runs").exists()


def test_a_profile_that_ships_is_nobodys_and_is_not_learnt_about(comity, home):
    said = comity("visits", "german_woman", "--times", "1", "--json")
    assert said.json["remembered_as"] is None
    assert not home.exists()


def test_visits_lead_towards_what_the_person_likes_and_say_so(comity, anna, here):
    words = ("visits", "anna", "--times", "4", "--wants", "1.1..1.4", "--keep", "--picture", "visits.png")
    answer = comity(*words, "--json").json
    first, *_, last = answer["visits"]
    assert abs(last["distance_wanted_m"] - 1.25) < abs(first["distance_wanted_m"] - 1.25)
    assert first["distance_wanted_m"] == first["distance_model_m"]
    for visit in answer["visits"]:
        assert visit["distance_reached_m"] == pytest.approx(visit["distance_wanted_m"], abs=0.02)
        assert visit["interval_m"][0] < visit["interval_m"][1]
    assert answer["remembered_as"] == "anna"
    with Image.open(here / "visits.png") as picture:
        assert picture.width == 1200
    again = comity("visits", "anna", "--times", "1", "--wants", "1.1..1.4", "--json").json
    assert again["known_before"] == 4


def test_simulated_visits_write_nothing_about_a_real_person(comity, anna):
    said = comity("visits", "anna", "--times", "1", "--wants", "1.1..1.4")
    assert said.code == 0, said.err
    assert "nothing of it is remembered" in said.out
    assert not anna.exists()


def test_simulated_visits_that_are_kept_are_marked_and_say_which_days_are_to_come(comity, anna):
    said = comity("visits", "anna", "--times", "2", "--wants", "1.1..1.4", "--keep")
    assert "1 of them on days that are still to come" in said.out
    observed = yaml.safe_load(anna.read_text())["conversational_distance"]
    assert [one["simulated"] for one in observed] == [True, True]
    assert "2 observations are simulated" in comity("profile", "show", "anna").out
    assert "simulated: true" in comity("profile", "export", "anna").out


def test_only_of_somebody_who_is_kept_simulated_visits_can_be_kept(comity, home):
    said = comity("visits", "german_woman", "--times", "1", "--keep")
    assert said.code == 2
    assert "--keep" in said.err
    assert not home.exists()


def test_the_same_seed_gives_the_same_visits(comity):
    words = ("visits", "unknown", "--times", "1", "--seed", "4", "--json")
    assert comity(*words).out == comity(*words).out


def test_the_same_profile_and_history_get_the_same_treatment(comity, anna, home):
    comity("visits", "anna", "--times", "2", "--wants", "1.1..1.4", "--at", "2026-01-01", "--keep")
    comity("profile", "set", "berta", "culture=DEU", "gender=female")
    twin = home / "people" / "berta" / "learnt.yaml"
    twin.write_text(anna.read_text().replace("person: anna", "person: berta"))
    one, other = (
        comity("infer", name, "--at", "2026-06-01", "--json").json["parameters"] for name in ("anna", "berta")
    )
    assert one == other
    assert one["conversational_distance"]["origin"] == "learnt"


@pytest.mark.parametrize("wrong", ["0.5", "0.8..0.5", "near..far", "0.5..9", "nan..1"])
def test_an_interval_that_cannot_be_is_refused(comity, wrong):
    said = comity("visits", "unknown", "--wants", wrong)
    assert said.code == 2
    assert "--wants 0.5..0.8" in said.err


def test_there_is_nothing_to_learn_from_somebody_who_asked(comity, anna):
    comity("profile", "set", "anna", "distance=0.9")
    said = comity("visits", "anna", "--times", "1")
    assert said.code == 2
    assert "nothing is learnt about it" in said.err
    run = comity("run", "acquaintance", "--as", "guest=anna", "--learn")
    assert run.code == 0
    assert not anna.exists()


def test_a_damaged_file_ends_with_its_line_and_nothing_written(comity, anna, here):
    anna.write_text(
        "schema_version: 1\nperson: anna\nconversational_distance:\n- {day: 2026-01-01, signal: yawned}\n"
    )
    before = anna.read_text()
    said = comity("run", "acquaintance", "--as", "guest=anna", "--learn")
    assert said.code == 2
    assert "learnt.yaml:4" in said.err
    assert anna.read_text() == before
    assert not (here / "runs").exists()


@pytest.mark.parametrize(
    ("comfort", "line"),
    [
        ("{wants_m: [1.0, 0.5]}", "expected wants_m as two distances, the nearer one first"),
        ("{wants_m: [-1, 0.5]}", "got [-1, 0.5]"),
        ("{wants_m: [0.5, 0.9], shows: [yawn]}", "yawn"),
        ("{}", "wants_m"),
    ],
)
def test_a_comfort_that_cannot_be_is_refused_with_its_line(comity, here, comfort, line):
    from comity.system.library import shipped

    text = shipped("scenario")["johanna"].read_text()
    text = text.replace("    facing_deg: 205\n", f"    facing_deg: 205\n    comfort: {comfort}\n")
    (here / "odd.yaml").write_text(text)
    number = text[: text.index("comfort:")].count("\n") + 1
    said = comity("run", "odd.yaml")
    assert said.code == 2
    assert f"odd.yaml:{number}:" in said.err
    assert line in said.err
    assert "near_m" not in said.err
    assert "far_m" not in said.err  # what the world's own classes call it


def test_what_somebody_without_a_comfort_of_the_scenarios_shows_is_not_marked_as_simulated(comity, anna):
    """Only where the scenario invents how somebody reacts is it the scenario's."""
    said = comity("run", "johanna", "--as", "johanna=anna", "--learn", "--at", "2026-01-01")
    assert said.code == 0, said.err
    observed = yaml.safe_load(anna.read_text())["conversational_distance"]
    assert [(one["signal"], one["simulated"]) for one in observed] == [("nothing", False)]


def test_visits_end_before_the_calendar_does(comity):
    said = comity("visits", "german_woman", "--times", "3", "--every", "30", "--at", "9999-12-01")
    assert said.code == 2
    assert "the calendar ends on 9999-12-31" in said.err


def test_who_asked_it_nearer_and_was_at_ease_finds_it_there_a_month_later(comity):
    """At ease from 0.5 to 0.8 m; the model says 0.85 m."""
    words = ("visits", "german_woman", "--wants", "0.5..0.8", "--times", "4", "--json")
    asked, at_ease, *later = comity(*words).json["visits"]
    assert (asked["noticed"], at_ease["noticed"]) == ("ask_closer", "nothing")
    assert at_ease["distance_reached_m"] == pytest.approx(0.70, abs=0.01)
    for visit in later:
        assert 0.69 <= visit["distance_wanted_m"] <= 0.73


def test_no_interval_is_nearer_than_safety_allows_and_what_is_reached_is_where_the_robot_stood(comity):
    """Somebody at ease from 0.3 to 0.5 m asks the robot nearer: it stops half a spread nearer, at 0.49 m."""
    words = ("visits", "arab_woman", "--wants", "0.30..0.50", "--times", "4", "--seed", "1", "--json")
    first, second, *_ = visits = comity(*words).json["visits"]
    for visit in visits:
        assert visit["interval_m"][0] >= 0.30
        assert visit["distance_reached_m"] == pytest.approx(visit["distance_wanted_m"], abs=0.015)
    assert first["noticed"] == "ask_closer"
    assert second["distance_reached_m"] == pytest.approx(0.49, abs=0.015)
    assert second["error_m"] == pytest.approx(0.09, abs=0.015)
    assert "0.00.." not in comity(*words[:-1]).out
