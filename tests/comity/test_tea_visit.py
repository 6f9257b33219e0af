"""Telling, bringing, waiting and taking leave, from the scenario to what is left of the run."""

from __future__ import annotations

import json
import math

import pytest
import yaml

import comity as product
from comity.preparation import prepare
from comity.scenario import load_scenario
from comity.system import library
from comity_executor import Execution, ScriptedRobot

SOME = ("german_woman", "british_elder", "own_wish")
PROFILES = sorted(library.shipped("profile"))

VISIT = """\
schema_version: 1
name: visit
place:
  width_m: 6.0
  height_m: 5.0
  furniture:
    - {name: counter, box_m: [0.2, 4.4, 1.6, 0.6]}
robot: {at_m: [1.0, 1.0]}
people:
  anna: {profile: british_elder, at_m: [4.6, 3.6], facing_deg: 200}
goals:
  - greet: anna
  - {say: "Your coffee is ready.", to: anna}
  - {offer: coffee, to: anna, from: counter}
  - take_leave: anna
"""


@pytest.fixture
def written(here):
    """Write the visit, changed as text: `written(("counter}", "shelf}"))`."""

    def write(*changes: tuple[str, str]) -> str:
        text = VISIT
        for old, new in changes:
            assert old in text
            text = text.replace(old, new)
        (here / "visit.scenario.yaml").write_text(text)
        return "visit.scenario.yaml"

    return write


def check(profile: str) -> None:
    """All is done, in its order; one thing is in the hands at a time, and gestures of hands wait for it."""
    episode = product.run("tea-visit", profiles={"anna": profile, "omar": profile})
    assert episode.outcome == "success"
    for visit in episode.visits:
        times = [deed.done_s for deed in visit.agenda if deed.done_s is not None]
        assert len(times) == len(visit.agenda)
        assert times == sorted(times)
    acts = [(act.act, act.thing) for act in episode.acts]
    assert acts.count(("pick_up", "tea")) == acts.count(("hand_over", "tea")) == 1
    assert acts.index(("pick_up", "tea")) < acts.index(("hand_over", "tea"))
    carried = acts[acts.index(("pick_up", "tea")) + 1 : acts.index(("hand_over", "tea"))]
    assert {act for act, _ in carried} <= {"say", "nod"}


@pytest.mark.parametrize("profile", SOME)
def test_the_shipped_visit_succeeds(profile):
    check(profile)


@pytest.mark.study
@pytest.mark.parametrize("profile", PROFILES)
def test_the_shipped_visit_succeeds_for_every_shipped_profile(profile):
    check(profile)


def test_hands_are_full_for_the_greeting_and_free_for_the_farewell(comity, written):
    """Somebody who likes a wave is greeted in words with the coffee in the hands, and waved to afterwards."""
    steps = {step["action"]: step for step in comity("plan", written(), "--json").json["steps"]}
    assert steps["Greet_person"]["arguments"][2:] == ["verbal", "none"]
    assert steps["Take_leave"]["arguments"][2:] == ["both", "wave"]


def test_a_run_says_what_was_done_and_when_and_runs_again_from_its_folder(comity, written):
    answer = comity("run", written(), "--out", "one", "--json").json
    (visit,) = answer["visits"]
    assert [deed["action"] for deed in visit["agenda"]] == ["Say", "Offer", "Take_leave"]
    assert all(deed["done_s"] is not None for deed in visit["agenda"])
    assert [act["act"] for act in visit["acts"]][:3] == ["pick_up", "say", "say"]
    again = comity("run", "one/scenario.yaml", "--out", "two", "--json").json
    assert again["trace_sha256"] == answer["trace_sha256"]
    assert comity("replay", "one").code == 0
    why = comity("trace", "one", "--why", "Step_away(anna)").out
    assert "Take_leave(robot, anna, both, wave)" in why


class Handless:
    """The smallest robot, without the calls of one that brings things."""

    def __init__(self) -> None:
        self._whole = ScriptedRobot({"anna": 3.0})

    def __getattr__(self, name: str) -> object:
        if name in ("go_to", "pick_up", "hand_over", "carried"):
            raise AttributeError(name)
        return getattr(self._whole, name)


def test_a_robot_that_cannot_carry_is_refused_the_plan(written):
    prepared = prepare(load_scenario(written()))
    with pytest.raises(ValueError, match="brings coffee to anna, and the robot cannot carry"):
        Execution(prepared.plan, Handless(), prepared.values)  # pyright: ignore[reportArgumentType]


def test_whatever_robot_it_is_it_speaks_waits_and_leaves(written):
    """Without anything to carry the smallest robot is enough."""
    file = load_scenario(
        written(
            ("{offer: coffee, to: anna, from: counter}", "{wait_s: 2, with: anna}"),
        )
    )
    prepared = prepare(file)
    robot = ScriptedRobot({"anna": 3.0})
    execution = Execution(prepared.plan, robot, prepared.values)
    while execution.tick() == "running" and robot.now_s() < 60.0:
        robot.step()
    (visit,) = execution.visits
    assert execution.status == "success"
    assert [deed.action for deed in visit.agenda if deed.done_s] == ["Say", "Wait", "Take_leave"]


@pytest.mark.parametrize(
    ("change", "conditions"),
    [
        (("robot: {at_m: [1.0, 1.0]}", "robot: {at_m: [1.0, 1.0], carrying: a tray}"), {"hands"}),
        (("facing_deg: 200}", "facing_deg: 200, noisy: true}"), {"noise"}),
    ],
)
def test_a_visit_that_cannot_be_finished_is_not_begun_and_says_what_is_in_its_way(
    comity, written, change, conditions
):
    said = comity("plan", written(change), "--json")
    assert said.code == 1
    (unmet,) = said.json["unmet"]
    assert {condition["kind"] for condition in unmet["conditions"]} == conditions
    assert said.json["steps"] == []


MISTAKES = {
    "say to nobody": (("to: anna}\n  - {offer", "to: ann}\n  - {offer"), ":13", "Did you mean 'anna'?"),
    "from nowhere": (("from: counter", "from: kitchen"), ":14", "Known are: counter."),
    "no place": ((", from: counter", ""), ":14", "expected `to` and `from` beside `offer`, got no `from`"),
    "two at once": (
        ("take_leave: anna", "{take_leave: anna, say: bye}"),
        ":15",
        "got `say` and `take_leave`",
    ),
    "nobody to wait for": (("take_leave: anna", "wait_s: 3"), ":15", "got no `with`"),
    "a key that does not belong": (("to: anna, from", "to: anna, until: moves, from"), ":14", "got `until`"),
    "before the greeting": (("  - greet: anna\n", ""), ":12", "Write `- greet: anna` above it."),
    "after the farewell": (
        ("  - take_leave: anna", "  - take_leave: anna\n  - {say: more, to: anna}"),
        ":16",
        "nothing more to do with a person after `take_leave`",
    ),
    "nothing to say": (('"Your coffee is ready."', '"  "'), ":13", "text that is not blank"),
    "a line break": (('ready."', 'ready.\\nSit."'), ":13", "U+000A (a control character) as character 22"),
    "a mark of direction": (('ready."', 'ready\\u202E."'), ":13", "U+202E (right-to-left override)"),
    "a pause without end": (("take_leave: anna", "{wait_s: .inf, with: anna}"), ":15", "wait_s"),
    "greeted already": (("goals:", "already: [{greeted: anna}]\ngoals:"), ":14", "still to be greeted"),
}


@pytest.mark.parametrize("mistake", MISTAKES)
def test_a_mistake_in_a_goal_is_told_with_its_line(comity, written, mistake):
    change, line, words = MISTAKES[mistake]
    said = comity("plan", written(change))
    assert (said.code, said.out) == (2, "")
    assert f"visit.scenario.yaml{line}: " in said.err
    assert words in said.err


def test_a_location_of_a_map_is_a_place_to_fetch_from(comity, here):
    scenario = {
        "schema_version": 1,
        "name": "mapped",
        "place": {
            "map": {
                "schema_version": 1,
                "name": "flat",
                "rooms": {"room": {"box_m": [0, 0, 6, 5]}},
                "locations": {"hatch": {"at_m": [0.6, 4.2], "facing_deg": 90}},
            }
        },
        "robot": {"at_m": [1.0, 1.0]},
        "people": {"anna": {"at_m": [4.6, 3.6], "facing_deg": 200}},
        "goals": [{"greet": "anna"}, {"offer": "soup", "to": "anna", "from": "hatch"}],
    }
    (here / "mapped.scenario.yaml").write_text(yaml.safe_dump(scenario))
    answer = comity("run", "mapped.scenario.yaml", "--out", "run", "--json").json
    assert answer["outcome"] == "success"
    frames = [line.split(",") for line in (here / "run" / "frames.csv").read_text().splitlines()[1:]]
    picked = next(act for act in answer["visits"][0]["acts"] if act["act"] == "pick_up")
    at = next(row for row in frames if row[1] == "robot" and float(row[0]) >= picked["start_s"])
    assert abs(float(at[2]) - 0.6) < 0.02
    assert abs(float(at[3]) - 4.2) < 0.02


def test_somebody_left_out_is_neither_greeted_nor_brought_anything(comity, written):
    """And the headline claims the optimum only for those who are visited."""
    name = written(("- greet: anna", "- {greet: anna, skip: 0.5}"))
    said = comity("plan", name)
    assert "Skip_visit(robot, anna)" in said.out
    assert "no plan for those who are visited costs less" in said.out
    assert [step["action"] for step in comity("plan", name, "--json").json["steps"]] == ["Skip_visit"]
    assert json.loads(comity("run", name, "--out", "x", "--json").out)["outcome"] == "success"


LEFT_AND_BACK = """\
schema_version: 1
name: left-and-back
place: {width_m: 8, height_m: 5, furniture: [{name: counter, box_m: [0.3, 4.3, 1.4, 0.6]}]}
robot: {at_m: [1, 1]}
people:
  anna:
    profile: {name: waves, culture: DEU, settings: {greeting_gesture: wave, greeting_modality: both}}
    at_m: [4.6, 2.6]
    facing_deg: 200
    comfort: {wants_m: WANTS, shows: [SHOWS]}
goals:
  - greet: anna
  - {say: "One moment.", to: anna}
  - {offer: tea, to: anna, from: counter}
"""
"""With the tea in its hands the robot could not wave: it greets first, fetches it, and comes back."""


@pytest.mark.parametrize(
    ("shows", "wants"),
    [
        ("step_back", "[1.8, 2.4]"),
        ("ask_farther", "[1.8, 2.4]"),
        ("lean_in", "[0.4, 0.5]"),
        ("ask_closer", "[0.4, 0.5]"),
    ],
)
def test_the_robot_comes_back_to_where_the_person_had_it_stand(here, shows, wants):
    """By moving or by asking, before it went to fetch something."""
    ran = run_of(here, LEFT_AND_BACK.replace("SHOWS", shows).replace("WANTS", wants))
    (word,) = [act for act in ran.acts if act.text == "One moment."]
    (offer,) = [act for act in ran.acts if act.act == "hand_over"]
    planned_m = ran.visits[0].wanted.distance_m
    stood_m, stands_m = gap_m(ran, word.t_end), gap_m(ran, offer.t_start)
    assert abs(stood_m - planned_m) > 0.08, "they showed that they want it otherwise"
    assert stands_m == pytest.approx(stood_m, abs=0.01)


def test_what_they_ask_for_outright_since_counts_when_it_comes_back(here):
    text = LEFT_AND_BACK.replace("SHOWS", "step_back").replace("WANTS", "[1.8, 2.4]")
    asks = "changes: [{at_s: 16, person: anna, says: {conversational_distance: 1.3}}]\n"
    ran = run_of(here, text + asks)
    (offer,) = [act for act in ran.acts if act.act == "hand_over"]
    assert gap_m(ran, offer.t_start) == pytest.approx(1.3, abs=0.01)


def run_of(here, text):
    (here / "left-and-back.scenario.yaml").write_text(text)
    return product.run("left-and-back.scenario.yaml")


def gap_m(ran, t: float) -> float:
    """Between the nearest points of the robot and Anna at a time."""
    robot, anna = (ran.frames.of(name)[round(t / 0.05), :2] for name in ("robot", "anna"))
    return math.dist(robot, anna) - 0.25 - 0.20
