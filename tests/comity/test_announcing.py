"""Who does not see is told in words that the robot comes, has stopped and leaves, whatever else there is."""

from __future__ import annotations

import math

import numpy as np
import pytest
from gliding import gliding, written
from hypothesis import given, settings
from hypothesis import strategies as st

import comity
from comity.live.start import as_seen
from comity.live_episode import LiveEpisode
from comity.preparation import prepare
from comity.scenario import load_scenario
from comity_domain.problem.circumstances import SPOKEN_TO_M
from comity_executor import Execution
from comity_executor.speech.phrasebook import SHIPPED
from comity_sim2d import World

SCENARIO = """schema_version: 1
name: told
adults_only: true
rulebook: {rulebook}
place: {{width_m: 10, height_m: 7}}
robot: {{at_m: [{x}, {y}], drive: {drive}, max_speed_m_s: {speed}, sensor: {{noise_m: {noise}}}}}
people:
  anna: {{at_m: [5, 3.5], facing_deg: {facing}, profile: {{name: anna, culture: {culture}, {sense}}}}}
  ben: {{at_m: [8.5, 5.5], facing_deg: 200, profile: {{name: ben, culture: DEU}}}}
goals:
{goals}
"""
USUAL = {
    "rulebook": "bruno2017",
    "x": 1,
    "y": 3.5,
    "drive": "omnidirectional",
    "speed": 0.7,
    "noise": 0.0,
    "facing": 0,
    "culture": "DEU",
    "sense": "sight: blind",
    "goals": "  - {greet: anna, priority: 100}\n  - greet: ben",
}
AWAY = "  - {greet: anna, priority: 100}\n  - {offer: tea, to: anna, from: bar}\n  - {take_leave: anna}"
SIDES = ("in_front", "left", "right", "behind")
FIRST = {"coming": "This is the robot", "stopped": "I have stopped", "leaving": "I am leaving now"}
BAR = "place: {width_m: 10, height_m: 7, furniture: [{name: bar, box_m: [0.5, 6.2, 2, 0.5]}]}"


def told(folder, **changes):
    path = folder / "told.scenario.yaml"
    path.write_text(SCENARIO.format(**{**USUAL, **changes}), encoding="utf-8")
    return path


def words(episode, person="anna"):
    """What is said to a person: when it begins and ends, and the text."""
    return [(act.t_start, act.t_end, act.text) for act in episode.acts if act.person == person and act.text]


def gaps_m(episode, person="anna"):
    """Between the bodies of the robot and a person, at every frame."""
    frames = episode.frames
    there = frames.of("robot")[:, :2] - frames.of(person)[:, :2]
    return np.hypot(*there.T) - 0.45


def said(found, what):
    return [each for each in found if each[2].startswith(FIRST[what])]


@settings(max_examples=25)
@given(
    x=st.floats(0.5, 9.5),
    y=st.floats(0.5, 3.0),
    facing=st.integers(-180, 180),
    drive=st.sampled_from(["omnidirectional", "differential"]),
    speed=st.sampled_from([0.3, 0.7, 1.2]),
    noise=st.sampled_from([0.0, 0.02]),
    culture=st.sampled_from(["DEU", "Arab countries", "JPN", "unknown"]),
    rulebook=st.sampled_from(["bruno2017", "evidence"]),
)
def test_nobody_who_does_not_see_is_come_upon(tmp_path_factory, x, y, **case):
    """The robot is never nearer than 1.5 m before it has said so, nor nearer than where it began."""
    if math.hypot(x - 5.0, y - 3.5) < 0.85:
        return
    episode = comity.run(told(tmp_path_factory.mktemp("t"), x=round(x, 2), y=round(y, 2), **case))
    visit = next(each for each in episode.visits if each.person == "anna")
    assert visit.outcome == "greeted"
    found, gaps, times = words(episode), gaps_m(episode), episode.frames.time_s
    coming = said(found, "coming")
    before = gaps[times < (coming[0][1] if coming else visit.docked_s)]
    assert before.min() >= min(SPOKEN_TO_M, gaps[0] - 0.01)
    stopped = said(found, "stopped")
    assert any(visit.docked_s <= t <= visit.docked_s + 0.2 for t, _, _ in stopped)
    leaving = said(found, "leaving")
    assert len(leaving) == 1
    away = times[(times > visit.greeted_s) & (gaps > visit.docked_at.distance_m + 0.1)]
    assert leaving[0][1] <= away[0]


def test_a_person_who_sees_is_told_nothing_of_the_kind(here):
    episode = comity.run(told(here, sense="sight: glasses"))
    assert not any(said(words(episode), what) for what in ("coming", "stopped", "leaving"))


def test_who_is_fetched_something_is_told_of_every_going_and_coming(here):
    path = told(here, goals=AWAY)
    path.write_text(path.read_text().replace("place: {width_m: 10, height_m: 7}", BAR), encoding="utf-8")
    episode = comity.run(path, rulebook="evidence")
    assert episode.outcome == "success"
    found = words(episode)
    kinds = [kind for each in found for kind in ("coming", "stopped", "leaving") if each in said(found, kind)]
    comings = kinds.count("coming")
    assert kinds == ["coming", "stopped", "leaving"] * comings
    assert comings >= 1
    assert found[-1][2].startswith("I am leaving now, Anna. Goodbye")  # the farewell says both


def test_the_trace_says_why(here, comity):
    told(here)
    assert comity("run", "told.scenario.yaml", "--out", "run").code == 0
    why = " ".join(comity("trace", "run", "--why", "Say_coming").out.split())
    assert "anna does not see, and is told “This is the robot, Anna." in why
    assert "announced in words" in why
    plan = comity("plan", "told.scenario.yaml", "--json").json
    reached = [step["parameters"] for step in plan["steps"] if step["action"] == "Reach_user"]
    assert [parameters.get("announced") for parameters in reached] == ["in words", None]


def test_a_place_too_loud_to_be_told_in_is_no_place_to_come_to(here):
    """At 0.9 m the voice would be heard, at 1.5 m not: the robot does not come, and says why."""
    path = told(here)
    loud = path.read_text(encoding="utf-8").replace("facing_deg: 0,", "facing_deg: 0, noise_db: 64,")
    path.write_text(loud, encoding="utf-8")
    episode = comity.run(path)
    assert "could not be told that the robot comes" in episode.prepared.asked.unreachable["anna"]
    assert not words(episode)


def test_who_says_on_the_way_that_they_do_not_see_is_told(here):
    path = told(here, sense="gender: female", x=0.6)
    with path.open("a", encoding="utf-8") as file:
        file.write("changes:\n  - {at_s: 1, person: anna, situation: {sight: none}}\n")
    episode = comity.run(path)
    (coming,) = said(words(episode), "coming")
    gaps, times = gaps_m(episode), episode.frames.time_s
    assert gaps[times < coming[1]].min() >= SPOKEN_TO_M


def test_a_real_robot_tells_too(here):
    """The words go to the robot as any others do, and it stands while it says them."""
    text = SCENARIO.format(**{**USUAL, "x": 1, "y": 3.5})
    file = load_scenario(written(here, text))
    robot = gliding(y=3.5)
    robot.people = {"anna": (5.0, 3.5, 0.0), "ben": (8.5, 5.5, 200.0)}
    live = LiveEpisode(prepare(as_seen(file, robot)), robot=robot)
    live.run()
    assert live.so_far().outcome == "success"
    acts = [(t, what) for t, command, what in robot.log if command == "perform"]
    spoken = [(t, act.text) for t, act in acts if act.to == "anna" and act.text]
    coming = next(t for t, text in spoken if text.startswith("This is the robot"))
    near = [t for t, x, y, _ in robot.path if math.hypot(x - 5.0, y - 3.5) - 0.45 < SPOKEN_TO_M]
    assert coming < near[0]
    assert any(text.startswith("I have stopped") for _, text in spoken)
    assert spoken[-1][1] == "I am leaving now, Anna."


def test_the_words_stand_in_the_tree_for_other_engines_too(here):
    prepared = prepare(load_scenario(str(told(here))))
    xml = Execution(prepared.plan, World(prepared.scene).robot, prepared.values).btcpp_xml()
    for leaf in ("IsComingTold", "ComeNear", "SayComing", "SayStopped", "IsStopTold", "SayLeaving"):
        assert f"<{leaf} name=" in xml
    assert 'text="I have stopped in front of you, Anna."' in xml


@pytest.mark.parametrize("code", SHIPPED)
def test_every_language_that_the_robot_greets_in_has_the_words(code):
    """Plain ones, too, which a real robot says that has no others reviewed."""
    language = SHIPPED[code]
    for use in ("announce_coming", *(f"stopped_{at}" for at in SIDES), "announce_leaving"):
        assert language.find(use, "neutral", first_meeting=False).use == use
        assert language.plain(use).use == use


MUTE = "faults:\n  - {{at_s: {at_s}, fault: speech fails, for_s: 200}}\nlimits: {{replans: 0}}\n"


def test_a_robot_that_cannot_speak_does_not_come_near(here):
    path = told(here, goals="  - greet: anna")
    with path.open("a", encoding="utf-8") as file:
        file.write(MUTE.format(at_s=0))
    episode = comity.run(path)
    visit = next(each for each in episode.visits if each.person == "anna")
    assert visit.outcome == "unreached"
    assert "say was broken off" in visit.failure
    assert gaps_m(episode).min() >= SPOKEN_TO_M


def test_a_robot_that_has_lost_its_voice_leaves_all_the_same(here):
    """And it is on record that nobody was told."""
    path = told(here)
    before = comity.run(path)
    greeted_s = next(each.greeted_s for each in before.visits if each.person == "anna")
    with path.open("a", encoding="utf-8") as file:
        file.write(MUTE.format(at_s=round(greeted_s, 2)))
    episode = comity.run(path)
    (untold,) = (event for event in episode.events if event.node == "Leave_untold(ben)")
    assert "anna does not see, and could not be told that the robot leaves" in str(untold.because)
