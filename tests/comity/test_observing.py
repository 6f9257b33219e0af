"""What people see and hear at real meetings teaches just what a robot's own noticing does."""

from __future__ import annotations

import os
import subprocess
import sys
from datetime import date, timedelta
from tempfile import TemporaryDirectory

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import comity as front_door
from comity.adaptation.learning import keep, observed
from comity.adaptation.observers_words import PAST
from comity.adaptation.observing import ObservedSignal, observe
from comity.adaptation.stored_profile import StoredProfile
from comity.adaptation.visits import acquainted, interval_in_words, meet
from comity.live_episode import execute
from comity.people.consents import SCOPES, give
from comity.people.learnt_file import Observation, learnt_on
from comity.people.remembered import remember, remembered
from comity.people.store import Store
from comity.preparation import prepare
from comity.scenario import load_scenario
from comity_fis import InputError, load_rulebook
from comity_fis.learning.signals import SIGNALS, WORDS

DAY = date(2026, 1, 1)
BOOK = load_rulebook("evidence")
meetings = st.lists(
    st.tuples(
        st.sampled_from(SIGNALS),
        st.floats(0.0, 3.0).map(lambda x: round(x, 3)),
        st.integers(0, 300),
        st.sampled_from(["standing", "seated"]),
    ),
    min_size=1,
    max_size=6,
)


@pytest.fixture
def amal(home, comity):
    assert comity("profile", "set", "amal", "culture=DEU", "gender=female", "age=70").code == 0
    return home / "people" / "amal"


def lessons(name):
    document = remembered(name)
    known = document.conversational_distance if document else ()
    return tuple(one.model_copy(update={"entry": None, "simulated": False}) for one in known)


@settings(max_examples=30)
@given(meetings, st.sampled_from(["german_woman", "arab_man", "unknown"]))
def test_the_same_observations_teach_the_same_with_the_simulation_and_without(seen, shipped):
    """By hand, as the store of a learning run holds them, and as the learner computes them."""
    with TemporaryDirectory() as home, pytest.MonkeyPatch.context() as patch:
        patch.setenv("COMITY_HOME", home)
        inferred = {
            posture: front_door.infer(shipped, posture=posture, rulebook="evidence")
            for posture in ("standing", "seated")
        }
        values = {posture: one["conversational_distance"].number for posture, one in inferred.items()}
        by_robot = [
            Observation(
                day=DAY + timedelta(days),
                situation={"posture": posture},
                model_m=round(values[posture], 4),
                distance_m=round(metres, 4),
                signal=signal,
            )
            for signal, metres, days, posture in seen
        ]
        document = {**front_profile(shipped)}
        for name in ("robot", "hand"):
            give(name, SCOPES, by="a_test")
            Store().change_profile(name, lambda _, name=name: {**document, "name": name})
        assert remember("robot", by_robot)
        for one in by_robot:
            StoredProfile("hand").observe(one.signal, one.distance_m, at=one.day, situation=one.situation)
        assert lessons("hand") == lessons("robot")
        for posture in ("standing", "seated"):
            by_hand, by_run = (
                front_door.infer(name, at=date(2026, 11, 1), posture=posture) for name in ("hand", "robot")
            )
            assert by_hand.parameters == by_run.parameters


def front_profile(shipped):
    from comity.people.profile import load_profile

    return load_profile(shipped).profile.model_dump(mode="json", exclude_defaults=True)


def test_a_run_that_learns_and_the_same_meeting_written_down_are_one(amal, comity):
    """Whole episodes: what the robot noticed, written down by hand with the same distance and signal."""
    assert comity("profile", "set", "berta", "culture=DEU", "gender=female", "age=70").code == 0
    file = load_scenario("steps-back")
    person = next(iter(file.scenario.visited()))
    prepared = prepare(file, profiles={person: "amal"}, learn=True, at=DAY)
    seen = observed(execute(prepared), DAY)
    assert keep(seen) == {"amal"}
    noticed = seen["amal"]
    front_door.profile("berta").observe(
        noticed.signal, noticed.distance_m, at=DAY, situation=noticed.situation
    )
    assert lessons("berta") == lessons("amal")


def test_a_year_of_simulated_visits_teaches_the_same_when_it_is_written_down(amal):
    acquaintance, _ = acquainted("amal", "evidence", every_days=30, begin=DAY, seed=1)
    visits = list(meet(acquaintance, interval_in_words("1.1..1.5"), 3))
    profile = front_door.profile("amal")
    for one in visits:
        profile.observe(one.seen.signal, one.seen.distance_m, at=one.seen.day, situation=one.seen.situation)
    assert lessons("amal") == tuple(one.seen for one in visits)
    spread = BOOK.parameters["conversational_distance"].spread
    learnt = learnt_on(date(2026, 6, 1), tuple(one.seen for one in visits), spread)
    value = front_door.infer("amal", at=date(2026, 6, 1))["conversational_distance"]
    assert [part.value for part in value.contributions if part.origin == "learnt"] == pytest.approx(
        [learnt.offset]
    )


def test_the_simulation_is_not_needed(amal):
    """Nothing of the 2D world, nor of what it is built on, is so much as loaded."""
    script = (
        "import sys\n"
        "class Away:\n"
        "    def find_spec(self, name, path=None, target=None):\n"
        "        if name.split('.')[0] in ('pymunk', 'comity_sim2d', 'shapely'):\n"
        "            raise ImportError(f'{name} is away')\n"
        "sys.meta_path.insert(0, Away())\n"
        "import comity\n"
        "profile = comity.profile('amal')\n"
        "profile.observe('stepped_back', 0.8)\n"
        "print(comity.infer('amal')['conversational_distance'].origin)\n"
    )
    words = [sys.executable, "-c", script]
    said = subprocess.run(words, capture_output=True, text=True, env=os.environ, check=False)
    assert (said.returncode, said.stdout) == (0, "learnt\n"), said.stderr


@settings(max_examples=20)
@given(
    st.lists(
        st.lists(st.tuples(st.sampled_from(SIGNALS), st.floats(0, 3)), min_size=1, max_size=3), max_size=4
    )
)
def test_undo_takes_back_one_entry_after_the_other_and_nothing_else(entries):
    with TemporaryDirectory() as home, pytest.MonkeyPatch.context() as patch:
        patch.setenv("COMITY_HOME", home)
        give("amal", SCOPES, by="a_test")
        remember("amal", [Observation(day=DAY, situation={}, model_m=1.0, distance_m=1.0, signal="lean_in")])
        states = [remembered("amal")]
        for entry in entries:
            observe([ObservedSignal("amal", signal, metres, DAY) for signal, metres in entry], BOOK)
            states.append(remembered("amal"))
        profile = StoredProfile("amal")
        for before in reversed(states[:-1]):
            assert profile.undo()
            assert remembered("amal") == before
        assert profile.undo() == ()
        assert remembered("amal") == states[0]


@pytest.mark.parametrize("words", [*PAST, *SIGNALS, "Stepped back"])
def test_said_and_seen_are_told_apart(comity, amal, words):
    answer = comity("profile", "observe", "amal", "--signal", words, "--distance", "0.8", "--json").json
    (row,) = answer["observed"]
    assert row["how"] == ("said" if row["signal"] in WORDS else "seen")
    if row["signal"] != "nothing":  # silence far from a boundary teaches nothing
        assert answer["values"]["amal"]["origin"] == "learnt"
    shown = comity("profile", "show", "amal").out
    assert f"standing, {row['how']}" in shown


def test_a_step_back_moves_the_robot_out_and_undo_moves_it_back(comity, amal):
    before = comity("infer", "amal", "--json").json["parameters"]["conversational_distance"]["value"]
    words = [
        "--signal",
        "stepped_back",
        "--distance",
        "80 cm",
        "--at",
        "2026-01-05",
        "--situation",
        "posture=seated",
    ]
    assert comity("profile", "observe", "amal", *words).code == 0
    seated = ["infer", "amal", "--set", "posture=seated", "--at", "2026-01-05", "--json"]
    after = comity(*seated).json["parameters"]["conversational_distance"]
    assert after["value"] > before
    assert comity("infer", "amal", "--json").json["parameters"]["conversational_distance"]["value"] == before
    undone = comity("profile", "observe", "amal", "--undo", "--json").json["undone"]
    assert [(row["signal"], row["day"], row["distance_m"]) for row in undone] == [
        ("step_back", "2026-01-05", 0.8)
    ]
    assert comity(*seated).json["parameters"]["conversational_distance"]["value"] == before
    assert not (amal / "learnt.yaml").exists()
    assert comity("profile", "observe", "amal", "--undo").code == 2


TABLE = """\
name,signal,distance_m,date,posture
amal,stepped_back,0.8,2026-01-05,seated
# a comment
berta,asked_closer,1.2,2026-01-06,
amal,showed_nothing,1.0,2026-02-05,
"""


def test_a_table_is_written_down_whole_and_undone_person_by_person(comity, here, amal):
    comity("profile", "set", "berta", "culture=SWE", "posture=seated")
    (here / "m.csv").write_text(TABLE)
    answer = comity("profile", "observe", "--table", "m.csv", "--json").json
    rows = [
        (row["name"], row["signal"], row["how"], row["situation"]["posture"]) for row in answer["observed"]
    ]
    assert rows == [
        ("amal", "step_back", "seen", "seated"),
        ("berta", "ask_closer", "said", "seated"),
        ("amal", "nothing", "seen", "standing"),
    ]
    assert set(answer["values"]) == {"amal", "berta"}
    assert len(comity("profile", "observe", "amal", "--undo", "--json").json["undone"]) == 2
    assert remembered("amal") is None
    assert len(lessons("berta")) == 1


BAD = {
    "no such signal": ("stepped_back,0.8", "hopped,0.8"),
    "nobody of that name": ("berta,", "cem,"),
    "a word for a number": ("0.8", "near"),
    "too far": ("0.8", "80"),
    "a future day": ("2026-01-06", "2126-01-06"),
    "no day": ("2026-01-06", "soon"),
    "no such posture": ("seated", "flying"),
    "no name": ("berta,", ","),
    "a slip in a heading": ("posture", "postrue"),
    "no signals": ("signal", "note"),
    "no rows": (TABLE[TABLE.index("amal") :], ""),
}


@pytest.mark.parametrize("kind", BAD)
def test_a_table_with_one_bad_row_changes_nothing_and_names_its_line(comity, here, amal, kind):
    comity("profile", "set", "berta", "culture=SWE")
    (here / "m.csv").write_text(TABLE.replace(*BAD[kind]))
    said = comity("profile", "observe", "--table", "m.csv")
    assert (said.code, said.out) == (2, "")
    assert said.err.startswith("comity: m.csv:") or kind == "no rows"
    assert "Traceback" not in said.err
    assert remembered("amal") is None
    assert remembered("berta") is None


@pytest.mark.nobody_agreed
def test_consent_comes_first(comity, home):
    observe_ = ["profile", "observe", "amal", "--signal", "stepped_back", "--distance", "0.8"]
    assert comity(*observe_).code == 2
    give("amal", ["remember"], by="a_test")
    said = comity(*observe_)
    assert (said.code, "profile consent amal remember learn" in said.err) == (2, True)
    with pytest.raises(InputError, match="consent of amal to learn"):
        front_door.profile("amal").observe("stepped_back", 0.8)
    assert not (home / "people" / "amal" / "learnt.yaml").exists()
    give("amal", ["learn"], by="a_test")
    assert comity(*observe_).code == 0


def test_nothing_is_learnt_about_children_nor_beside_a_wish(comity, home):
    comity("profile", "set", "kid", "age=9")
    comity("profile", "set", "wish", "distance=1.1")
    for name in ("kid", "wish", "nobody"):
        said = comity("profile", "observe", name, "--signal", "stepped_back", "--distance", "0.8")
        assert (said.code, said.out) == (2, "")
    with pytest.raises(InputError, match="somebody who is kept"):
        front_door.profile("nobody")


@pytest.mark.parametrize(
    "words",
    [
        [],
        ["amal"],
        ["amal", "--signal", "stepped_back"],
        ["amal", "--distance", "0.8"],
        ["amal", "--undo", "--distance", "0.8"],
        ["--signal", "stepped_back", "--distance", "0.8"],
        ["amal", "--signal", "stepped_back", "--distance", "nan"],
        ["amal", "--signal", "stepped_back", "--distance", "-1"],
        ["amal", "--signal", "stepped_back", "--distance", "0.8", "--situation", "culture=SWE"],
        ["amal", "--signal", "stepped_back", "--distance", "0.8", "--at", "2126-01-01"],
        ["--table", "nowhere.csv"],
    ],
)
def test_words_that_do_not_belong_together_are_refused(comity, amal, words):
    said = comity("profile", "observe", *words)
    assert (said.code, said.out) == (2, "")
    assert "Traceback" not in said.err
    assert not (amal / "learnt.yaml").exists()
