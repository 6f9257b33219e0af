"""The operator of a real robot: each word is told, and none passes a limit or what a person asked for."""

from __future__ import annotations

import json

import pytest
from gliding import SCENARIO, Gliding, gliding, written
from hypothesis import given, settings
from hypothesis import strategies as st

from comity.episode import Episode
from comity.live.operator import Operator, OperatorCommand, word_of
from comity.live.start import as_seen
from comity.live_episode import LiveEpisode
from comity.preparation import prepare
from comity.scenario import load_scenario
from comity_fis import InputError


def carried_out(
    path: str, robot: Gliding, operator: Operator, words: dict[float, list[OperatorCommand]]
) -> Episode:
    """The scenario, with words at times of the episode [s]."""
    live = LiveEpisode(prepare(as_seen(load_scenario(path), robot)), robot=robot, operator=operator)
    sleep, waiting = robot.sleep, dict(words)

    def sleep_and_say(seconds: float) -> None:
        sleep(seconds)
        for t in [t for t in waiting if robot.t - 100.0 >= t]:
            for word in waiting.pop(t):
                operator.say(word)

    robot.sleep = sleep_and_say
    live.run()
    return live.so_far()


def told(episode: Episode) -> list[str]:
    return [one.text for one in episode.disturbances if one.kind == "operator"]


def docked_m(episode: Episode, person: str) -> float:
    return next(visit.docked_at.distance_m for visit in episode.visits if visit.person == person)


def test_nothing_begins_before_the_plan_is_approved(here):
    robot = gliding()
    episode = carried_out(
        written(here, SCENARIO), robot, Operator(approves=True), {3.0: [OperatorCommand("approve")]}
    )
    assert episode.outcome == "success"
    assert min(t for t, command, _ in robot.log if command in ("go", "perform")) >= 103.0
    assert told(episode) == ["the operator approved the plan"]


def test_a_new_plan_waits_for_approval_again(here):
    """The guest is skipped on the way to them: what comes of it begins only once it is approved, too."""
    words = {
        0.5: [OperatorCommand("approve")],
        2.0: [OperatorCommand("skip", "host")],
        9.0: [OperatorCommand("approve")],
    }
    robot = gliding()
    episode = carried_out(written(here, SCENARIO), robot, Operator(approves=True), words)
    begun = [t - 100.0 for t, command, _ in robot.log if command in ("go", "perform")]
    assert not [t for t in begun if 2.15 < t < 9.0]
    assert {visit.person: visit.outcome for visit in episode.visits}["guest"] == "greeted"


def test_an_operator_who_leaves_before_the_approval_ends_it_at_rest(here):
    operator = Operator(approves=True)
    operator.has_left = True
    robot = gliding()
    episode = carried_out(written(here, SCENARIO), robot, operator, {})
    assert episode.outcome == "stopped"
    assert not [command for _, command, _ in robot.log if command in ("go", "perform")]


def test_who_is_skipped_is_not_met(here):
    robot = gliding()
    episode = carried_out(
        written(here, SCENARIO), robot, Operator(), {1.0: [OperatorCommand("skip", "guest")]}
    )
    assert [act.to for _, command, act in robot.log if command == "perform"] == ["host"]
    assert told(episode) == ["the operator skipped guest"]
    assert episode.outcome == "partial"


@settings(max_examples=20)
@given(
    nudges=st.lists(
        st.tuples(st.sampled_from(["nearer", "farther"]), st.floats(0.01, 0.6)), min_size=1, max_size=4
    )
)
def test_nudges_move_the_distance_by_what_was_said_or_are_refused(tmp_path_factory, nudges):
    """Never nearer than half of the spread below the person's own distance, nor than the floor."""
    path = written(tmp_path_factory.mktemp("s"), SCENARIO)
    words = {1.0: [OperatorCommand(order, "guest", metres) for order, metres in nudges]}
    episode = carried_out(path, gliding(), Operator(), words)
    own = episode.prepared.values["guest"]["conversational_distance"]
    said = zip(nudges, told(episode), strict=True)
    moved = [m if order == "farther" else -m for (order, m), text in said if "refused" not in text]
    assert docked_m(episode, "guest") == pytest.approx(own.number + sum(moved), abs=0.011)
    assert docked_m(episode, "guest") >= max(0.30, own.number - own.spread / 2) - 0.011
    assert episode.values["guest"]["conversational_distance"].origin == ("operator" if moved else "culture")


@pytest.mark.parametrize("order", ["nearer", "farther"])
def test_a_distance_that_was_asked_for_is_not_nudged(here, order):
    wish = "profile: {name: amal, settings: {conversational_distance: 0.9}}"
    path = written(here, SCENARIO.replace("profile: arab_woman", wish))
    episode = carried_out(path, gliding(), Operator(), {1.0: [OperatorCommand(order, "guest")]})
    assert docked_m(episode, "guest") == pytest.approx(0.9, abs=0.011)
    assert "refused, they asked for 0.90 m" in told(episode)[0]


def test_a_stop_of_the_operator_holds_until_they_resume(here):
    robot = gliding()
    words = {2.0: [OperatorCommand("stop")], 6.0: [OperatorCommand("resume")]}
    episode = carried_out(written(here, SCENARIO), robot, Operator(), words)
    assert episode.outcome == "success"
    assert {v for t, _, _, v in robot.path if 102.4 < t < 106.0} == {0.0}
    assert any(cause.text == "the operator stopped the robot" for e in episode.events for cause in e.because)


def test_resume_does_not_go_on_against_the_robots_own_stop(here):
    robot = gliding()
    sleep = robot.sleep

    def sleep_and_press(seconds: float) -> None:
        sleep(seconds)
        robot.pressed = "the red button" if 102.0 <= robot.t < 106.0 else False

    robot.sleep = sleep_and_press
    words = {3.0: [OperatorCommand("resume")], 8.0: [OperatorCommand("resume")]}
    episode = carried_out(written(here, SCENARIO), robot, Operator(), words)
    assert {v for t, _, _, v in robot.path if 102.4 < t < 108.0} == {0.0}
    assert episode.outcome == "success"


def test_marks_are_on_record_at_their_time(here):
    words = {2.0: [OperatorCommand("mark", "the guest laughed")]}
    episode = carried_out(written(here, SCENARIO), gliding(), Operator(), words)
    mark = next(one for one in episode.disturbances if one.kind == "operator")
    assert mark.text == "the operator marked: the guest laughed"
    assert mark.t == pytest.approx(2.0, abs=0.11)


def test_words_about_nobody_are_refused(here):
    episode = carried_out(
        written(here, SCENARIO), gliding(), Operator(), {1.0: [OperatorCommand("skip", "nobody")]}
    )
    assert "refused" in told(episode)[0]
    assert episode.outcome == "success"


@pytest.mark.parametrize(
    ("line", "word"),
    [
        ("approve", OperatorCommand("approve")),
        (" skip guest ", OperatorCommand("skip", "guest")),
        ("nearer guest", OperatorCommand("nearer", "guest", 0.1)),
        ("farther guest 0.25", OperatorCommand("farther", "guest", 0.25)),
        ("mark the guest laughed", OperatorCommand("mark", "the guest laughed")),
    ],
)
def test_a_line_is_a_word(line, word):
    assert word_of(line) == word


@pytest.mark.parametrize(
    "line", ["skip", "approve guest", "go", "nearer guest far", "nearer guest -1", "mark"]
)
def test_other_lines_are_refused_with_what_can_be_said(line):
    with pytest.raises(InputError):
        word_of(line)


def test_from_the_command_line_words_come_from_standard_input(here, comity, monkeypatch):
    monkeypatch.syspath_prepend(str(here))
    (here / "operated.py").write_text(
        "from gliding import gliding\n\n\ndef base():\n    return gliding()\n", encoding="utf-8"
    )
    (here / "words.txt").write_text("approve\nmark it begins\nwhat\n", encoding="utf-8")
    path = written(here, SCENARIO)
    with (here / "words.txt").open(encoding="utf-8") as words:
        monkeypatch.setattr("sys.stdin", words)
        said = comity("run", path, "--robot", "operated:base", "--operator", "--out", "own", "--json")
    assert said.code == 0
    assert "Plan: Reach_user(robot, host" in said.err
    assert "approve | skip PERSON" in said.err
    account = json.loads((here / "own" / "run.json").read_text(encoding="utf-8"))
    kinds = {one["kind"]: one["text"] for one in account["disturbances"]}
    assert "operator" in kinds
    events = comity("trace", "own", "--events").out
    assert "the operator approved the plan" in events


@pytest.mark.parametrize("option", ["--operator", "--shadow"])
def test_what_needs_a_robot_says_so(here, comity, option):
    said = comity("run", "johanna", option)
    assert said.code == 2
    assert "--robot MODULE:CLASS" in said.err


FORMAL = "{name: host, culture: DEU, formality: formal, touch_consent: given}"


@pytest.mark.parametrize(
    ("words", "shakes"),
    [
        ([], False),
        ([OperatorCommand("consents", "host")], True),
        ([OperatorCommand("consents", "host"), OperatorCommand("withdraws", "host")], False),
        ([OperatorCommand("consents", "guest")], False),
        ([OperatorCommand("farther", "host", 0.2), OperatorCommand("consents", "host")], True),
    ],
)
def test_the_operator_passes_on_that_a_person_consents_to_touch(here, words, shakes):
    """What is stored moves no hand; a nudge of the distance stays."""
    text = SCENARIO.replace("profile: german_man", f"profile: {FORMAL}")
    robot = gliding()
    episode = carried_out(written(here, text), robot, Operator(), {0.5: words})
    acts = [act.act for act in robot.told("perform") if act.to == "host"]
    assert ("handshake" in acts) == shakes
    assert len(told(episode)) == len(words)
    if words[1:] and words[0].order == "farther":
        usual = carried_out(written(here, text), gliding(), Operator(), {})
        assert docked_m(episode, "host") == pytest.approx(docked_m(usual, "host") + 0.2, abs=0.02)
