"""Sessions with people: consent first, each answer on disk at once, and tables that other commands take."""

from __future__ import annotations

import io
import os
import signal
import subprocess
import sys
from pathlib import Path

import pandas as pd
import pytest
from hypothesis import given
from hypothesis import strategies as st

from comity.study.collecting.growing_table import opened_table, rows_of
from comity_fis import InputError

QUESTIONNAIRE = """schema_version: 1
name: calm
source: design choice
scale: {from: 1, to: 5}
items:
  calm_1: {subscales: [calm], text: I was calm}
  calm_2: {subscales: [calm], reversed: true}
"""
COLLECTION = """schema_version: 1
name: near and far
medium: robot
consent: You may stop at any time. Distances and answers are kept under your code.
facts: [gender, culture]
conditions: {near: Start the approach with near.yaml}
trials: 2
stop_says: showed_nothing
questionnaires: [calm.questionnaire.yaml]
"""
ROBOT = """
from comity_executor import CapabilityValues, Localisation, MotionStatus, PersonTrack

class Base:
    capabilities = CapabilityValues(lease_s=0.3)

    def __init__(self): self.t, self.x, self.moves = 0.0, 0.0, True
    def now_s(self): return self.t
    def sleep(self, seconds):
        self.t += seconds
        self.x += 0.1 * self.moves
        self.moves = False
    def localisation(self): return Localisation(self.x, 0.0, 0.0, 0.0, self.t)
    def tracks(self): return [PersonTrack(1, 1.6, 0.0, self.t), PersonTrack(2, 9.0, 0.0, self.t)]
    def motion(self): return MotionStatus(None, "stopped", stamp_s=self.t, is_at_rest=not self.moves)
    def stop(self, goal=None): self.t += 0.01
    def go(self, goal): return 1
    def renew(self, goal): pass
    def perform(self, act): return 1
    def performance(self, act): raise KeyError
    def emergency(self): return False
"""
ANSWERS = ["yes", "female", "SWE", "80 cm", "0.7", "4", "2", "1.1 m", "1.0", "5", "-"]
"""Of one session: consent, two facts, and under each of two conditions two distances and two items."""


@pytest.fixture
def asked(comity, here, monkeypatch):
    """The command with lines of standard input."""
    (here / "calm.questionnaire.yaml").write_text(QUESTIONNAIRE)
    (here / "near.collection.yaml").write_text(COLLECTION)
    comity("study", "sessions", "--participants", 6, "--conditions", "near,far", "--out", "sessions")

    def collect(*lines, participant="P01", by="Kim", more=()):
        monkeypatch.setattr(sys, "stdin", io.StringIO("".join(f"{line}\n" for line in lines)))
        words = ["near.collection.yaml", "sessions", "--participant", participant, "--by", by]
        return comity("study", "collect", *words, "--at", "2026-11-02", *more)

    return collect


def table(here, name):
    return pd.read_csv(here / f"sessions/collected/{name}.csv", dtype=str, keep_default_na=False)


def test_a_session_is_asked_in_the_allocated_order_and_written_down(asked, here):
    answer = asked(*ANSWERS, more=["--json"]).json
    assert (answer["status"], answer["written"], answer["left"]) == ("done", 11, 0)
    first, second = answer["conditions"]
    distances = table(here, "distances")
    assert distances[["condition", "trial", "value"]].to_numpy().tolist() == [
        [first, "1", "0.8"],
        [first, "2", "0.7"],
        [second, "1", "1.1"],
        [second, "2", "1"],
    ]
    assert set(distances["gender"]) == {"female"}
    answers = table(here, "answers")
    assert answers["answer"].tolist() == ["yes", "female", "SWE", "4", "2", "5", ""]
    assert set(answers["experimenter"]) == {"Kim"}


def test_without_consent_nothing_is_stored(asked, here):
    for lines in (["no"], ["perhaps", "no"], []):
        assert asked(*lines).code == 1
        assert not (here / "sessions/collected").exists()


def test_another_text_asks_for_consent_again(asked, here):
    asked(*ANSWERS)
    (here / "near.collection.yaml").write_text(COLLECTION.replace("any time", "once"))
    before = (here / "sessions/collected/answers.csv").read_bytes()
    assert asked("no").code == 1
    assert (here / "sessions/collected/answers.csv").read_bytes() == before
    assert asked("yes").code == 0


@pytest.mark.parametrize("stop", range(len(ANSWERS)))
def test_a_session_goes_on_where_the_lines_ended(asked, here, stop):
    """The tables are those of a session in one go, to the byte."""
    said = asked(*ANSWERS[:stop], more=["--json"])
    assert said.code == 1
    assert said.json["left"] == len(ANSWERS) - stop
    assert asked(*ANSWERS[stop:]).code == 0
    whole = {
        name: (here / f"sessions/collected/{name}.csv").read_bytes() for name in ("answers", "distances")
    }
    for name in whole:
        (here / f"sessions/collected/{name}.csv").unlink()
    asked(*ANSWERS)
    assert whole == {n: (here / f"sessions/collected/{n}.csv").read_bytes() for n in whole}


def test_what_cannot_be_used_is_asked_again_with_the_remedy(asked, here):
    wrong = [
        "maybe",
        "yes",
        "female",
        "Atlantis",
        "SWE",
        "80",
        "far away",
        "",
        "80 cm",
        "0.7",
        "6",
        "2.5",
        "4",
    ]
    said = asked(*wrong, *ANSWERS[6:])
    assert said.code == 0
    assert said.err.count("expected") == 7
    assert table(here, "distances")["value"].tolist() == ["0.8", "0.7", "1.1", "1"]


def test_a_distance_that_is_left_open_is_asked_another_time(asked):
    assert asked(*ANSWERS[:3], "-", *ANSWERS[4:], more=["--json"]).json["left"] == 1
    assert asked("0.8").code == 0


def test_a_robot_is_stopped_and_read_where_enter_is_pressed(asked, here):
    (here / "measuring_robot.py").write_text(ROBOT)
    lines = [*ANSWERS[:3], "", "0.7", *ANSWERS[5:]]
    assert asked(*lines, more=["--robot", "measuring_robot:Base"]).code == 0
    found = table(here, "distances")
    assert found["read_by"].tolist() == ["robot", *["experimenter"] * 3]
    assert float(found["value"][0]) == pytest.approx(1.6 - 0.1 - 0.45)


def test_who_withdraws_is_forgotten_and_the_others_stay(asked, here):
    asked(*ANSWERS)
    asked(*ANSWERS, participant="P02")
    answer = asked(more=["--withdraw", "--json"]).json
    assert (answer["status"], answer["written"]) == ("withdrawn", 11)
    for name in ("answers", "distances"):
        assert set(table(here, name)["participant"]) == {"P02"}
        assert "P01" not in (here / f"sessions/collected/{name}.csv").read_text()


def test_evaluate_learn_and_score_take_the_tables(asked, comity, here):
    for i in range(6):
        lines = ["yes", "female" if i % 2 else "male", "SWE" if i < 3 else "IND"]
        under = [f"{70 + 5 * i} cm", f"{72 + 5 * i} cm", "4", "2"]
        assert asked(*lines, *under, *under, participant=f"P0{i + 1}").code == 0
    path = "sessions/collected/distances.csv"
    found = comity("evaluate", "evidence", path, "--json")
    assert found.code == 0, found.err
    assert len(found.json["numbers"]["conversational_distance"]["rows"]) == 24
    words = ["--parameter", "conversational_distance"]
    learnt = comity("learn", path, *words, "--inputs", "gender,individualism", "--json")
    assert learnt.code in (0, 1), learnt.err
    assert learnt.json["people"] == 6
    scores = comity(
        "study", "score", "calm.questionnaire.yaml", "sessions/collected/answers.csv", "--json"
    ).json
    assert [one["scores"] for one in scores["sheets"]] == [[4]] * 12


def test_profile_observe_takes_the_stop_distances_of_people_who_are_stored(asked, comity, here):
    comity("profile", "set", "P01", "culture=SWE", "age=40")
    assert asked(*ANSWERS).code == 0
    observed = comity("profile", "observe", "--table", "sessions/collected/distances.csv", "--json")
    assert observed.code == 0, observed.err
    assert [one["distance_m"] for one in observed.json["observed"]] == [0.8, 0.7, 1.1, 1.0]


def test_another_collection_never_writes_into_the_same_tables(asked, here):
    asked(*ANSWERS)
    before = (here / "sessions/collected/distances.csv").read_bytes()
    (here / "near.collection.yaml").write_text(COLLECTION.replace("[gender, culture]", "[age]"))
    assert asked(participant="P02").code == 2
    assert (here / "sessions/collected/distances.csv").read_bytes() == before


@pytest.mark.parametrize(
    ("before", "after", "line"),
    [
        ("[gender, culture]", "[gendre]", 5),
        ("stop_says: showed_nothing\n", "", 1),
        ("{near:", "{neer:", 6),
        ("medium: robot", "medium: film", 3),
        ("calm.questionnaire.yaml]", "calm.questionnaire.yaml, calm.questionnaire.yaml]", 9),
        ("calm.questionnaire.yaml]", "godsped]", None),
    ],
)
def test_a_broken_collection_is_refused_by_its_line(asked, here, before, after, line):
    (here / "near.collection.yaml").write_text(COLLECTION.replace(before, after))
    said = asked(*ANSWERS)
    assert said.code == 2
    assert line is None or f"near.collection.yaml:{line}:" in said.err
    assert not (here / "sessions/collected").exists()


@pytest.mark.parametrize("words", [{"participant": "P99"}, {"by": "a\tb"}, {"more": ["--robot", "no:Robot"]}])
def test_the_command_refuses_what_it_cannot_use(asked, words):
    said = asked(*ANSWERS, **words)
    assert said.code == 2
    assert "expected" in said.err


@pytest.mark.parametrize("number", [signal.SIGKILL, signal.SIGINT])
def test_a_process_that_is_killed_leaves_whole_rows(asked, here, number):
    """It waits for the third distance as the signal comes."""
    words = ["near.collection.yaml", "sessions", "--participant", "P01", "--by", "Kim", "--at", "2026-11-02"]
    running = subprocess.Popen(
        [sys.executable, "-m", "comity", "study", "collect", *words],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        cwd=here,
        env=os.environ,
    )
    assert running.stdin is not None
    assert running.stderr is not None
    running.stdin.write("".join(f"{line}\n" for line in ANSWERS[:5]).encode())
    running.stdin.flush()
    said = b""
    while b"calm_2" not in said and b"I was calm" not in said:
        said += running.stderr.read(1)
    running.send_signal(number)
    running.wait(60)
    assert running.returncode == (-9 if number == signal.SIGKILL else 130)
    assert len(table(here, "distances")) == 2
    assert asked(*ANSWERS[5:]).code == 0
    assert len(table(here, "distances")) == 4


ROWS = st.lists(st.fixed_dictionaries({"a": st.text('xyz," ü', max_size=6), "b": st.integers()}), max_size=5)


@given(rows=ROWS, cut=st.integers(0, 60))
def test_a_table_that_was_cut_off_anywhere_holds_the_rows_before(tmp_path_factory, rows, cut):
    path = Path(tmp_path_factory.mktemp("table")) / "table.csv"
    with opened_table(path, ("a", "b")) as growing:
        for row in rows:
            growing.add(row)
    expected = [{key: str(cell) for key, cell in row.items()} for row in rows]
    assert rows_of(path, ("a", "b")) == expected
    content = path.read_bytes()
    path.write_bytes(content[: max(len(content) - cut, 0)])
    whole = rows_of(path, ("a", "b"))
    assert whole == expected[: len(whole)]
    with opened_table(path, ("a", "b")) as growing:
        growing.add({"a": "new", "b": 1})
    assert rows_of(path, ("a", "b")) == [*whole, {"a": "new", "b": "1"}]


@pytest.mark.parametrize("damaged", [b"", b"garbage", b'"x', b"1", bytes(400), b"1,2,3", b"1\r,2"])
def test_a_damaged_row_in_the_middle_is_refused_by_its_line_and_nothing_is_deleted(tmp_path, damaged):
    path = tmp_path / "table.csv"
    content = b"a,b\n1,2\n" + damaged + b"\n3,4\n"
    path.write_bytes(content)
    with pytest.raises(InputError) as refused, opened_table(path, ("a", "b")):
        pass
    assert refused.value.where.line == 3
    assert path.read_bytes() == content
