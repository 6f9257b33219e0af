"""A real robot passes people at a reduced margin only by its operator's word and its own numbers."""

from __future__ import annotations

import json
from dataclasses import asdict
from math import hypot
from types import SimpleNamespace

import pytest
from careful import ASIDE_M, FIT, LANE_M, STATED, Careful, OldAdapter, corridor
from hypothesis import given, settings
from hypothesis import strategies as st

import comity as front_door
from comity.live.reduced_margin_check import kept_margin_m, require_reduced_margin
from comity.live.robot_on_map import RobotOnMap
from comity.live.start import with_reduced_margin
from comity.preparation import resolved
from comity.scenario import load_scenario
from comity_executor import (
    ActGoal,
    MapGoal,
    MarginStatement,
    MotionGoal,
    ReducedPassage,
    Watchdog,
)
from comity_executor.robots.goals import PlannedPose
from comity_fis import InputError, countries
from comity_sim2d import Said

NAMES = tuple(asdict(STATED))
ASIDE = {"anna": (4.0, ASIDE_M, 180.0), "bert": (8.0, LANE_M, 180.0)}


@pytest.fixture
def ran(here):
    """Run the corridor with a robot that its operator allows the margin; what happened."""

    def run(robot: Careful, **text: str):
        (here / "corridor.scenario.yaml").write_text(corridor(**text), encoding="utf-8")
        return front_door.run("corridor.scenario.yaml", robot=robot, reduced_margin=True)

    return run


def passages(robot: Careful) -> list[tuple[ReducedPassage, ...]]:
    """Of all goals that the base was told, in order."""
    return [goal.passages for goal in robot.told("go") if isinstance(goal, MapGoal)]


def told(ran) -> list[str]:
    return [one.text for one in ran.disturbances if one.kind == "passage"]


def test_the_goal_carries_the_margin_for_the_person_who_stepped_aside_and_for_the_passage(ran):
    robot = Careful()
    episode = ran(robot)
    assert episode.outcome == "success"
    assert robot.least_m == pytest.approx(0.25, abs=1e-3)
    given_ = [each for each in passages(robot) if each]
    assert set(given_) == {(ReducedPassage("anna", 4.0, ASIDE_M, 0.24),)}
    assert passages(robot)[0] == passages(robot)[-1] == ()
    assert told(episode) == ["the robot passes anna, who lets it pass, at 0.25 m"]
    assert episode.metrics.longest_intrusion_by_person_s["anna"] > 0.0
    starts_s = next(t for t, _, goal in robot.log if isinstance(goal, MapGoal) and goal.passages)
    near = [v for t, x, y, v in robot.path if t > starts_s and hypot(x - 4.0, y - ASIDE_M) - 0.45 < 1.5]
    assert 0.0 < max(near) <= 0.2 + 1e-9


def test_a_person_at_the_wall_who_says_yes_is_passed(ran):
    robot = Careful(people=dict(ASIDE), answer="says yes")
    assert ran(robot).outcome == "success"
    assert robot.least_m == pytest.approx(0.25, abs=1e-3)


@pytest.mark.parametrize("later_s", [0.0, 1.0, 3.5])
@pytest.mark.parametrize("answer", ["says yes", "steps aside"])
def test_who_says_anything_else_afterwards_is_not_passed_nearer(ran, answer, later_s):
    robot = Careful(people=dict(ASIDE) if answer == "says yes" else dict(Careful().people), answer=answer)
    sleep, start, answered_s = robot.sleep, robot.people["anna"], []

    def sleep_and_think_better_of_it(seconds: float) -> None:
        sleep(seconds)
        if robot.said or robot.people["anna"] != start:
            answered_s.append(robot.t)
        if answered_s and robot.t >= answered_s[0] + later_s and "No, stop!" not in str(robot.said):
            robot.said.append(Said(robot.t, "anna", "No, stop!"))
            robot.answer = "is silent"

    robot.sleep = sleep_and_think_better_of_it  # type: ignore[method-assign]
    ran(robot)
    no_s = robot.said[-1].t
    told_later = [goal for t, _, goal in robot.log if isinstance(goal, MapGoal) and t > no_s + 0.1]
    assert not any(goal.passages for goal in told_later)
    assert robot.least_m >= 0.3 or later_s > 1.0


AT_THE_WALL = {"people": ASIDE, "answer": "says yes"}


@pytest.mark.parametrize(
    ("robot", "text"),
    [
        ({"answer": "is silent"}, {}),
        ({"answer": "is silent", "people": ASIDE}, {}),
        ({"faces": False}, {}),
        ({"sure_of": {"anna": None}}, {}),
        ({"velocity": {"anna": (0.0, 0.1)}} | AT_THE_WALL, {}),
        ({"people": {**ASIDE, "anna": (4.0, ASIDE_M, 0.0)}, "answer": "says yes"}, {}),
        (AT_THE_WALL, {"profile": FIT.replace("40", "17")}),
        (AT_THE_WALL, {"profile": FIT.replace("age: 40, ", "")}),
        (AT_THE_WALL, {"profile": FIT.replace("hearing: good", "hearing: impaired")}),
        (AT_THE_WALL, {"profile": FIT.replace("sight: good, ", "")}),
        (AT_THE_WALL, {"profile": FIT.replace("full", "walking frame")}),
        (AT_THE_WALL, {"profile": FIT + ", posture: seated"}),
        ({}, {"margin": ""}),
    ],
    ids=[
        "silent in the middle",
        "silent at the wall",
        "facing unknown",
        "who it is unknown",
        "walking",
        "from behind",
        "17",
        "no age",
        "hearing",
        "sight",
        "walking frame",
        "seated",
        "no margin set",
    ],
)
def test_nobody_else_is_passed_nearer(ran, robot, text):
    base = Careful(**{**robot, **({"people": dict(robot["people"])} if "people" in robot else {})})
    ran(base, **text)
    assert set(passages(base)) == {()}
    assert base.least_m >= 0.3


def test_leave_ends_when_the_person_moves(ran):
    robot = Careful()
    sleep = robot.sleep

    def sleep_and_step_back(seconds: float) -> None:
        sleep(seconds)
        if any(passages(robot)):
            robot.people["anna"] = (4.0, 0.45, robot.people["anna"][2])

    robot.sleep = sleep_and_step_back  # type: ignore[method-assign]
    ran(robot)
    given_ = passages(robot)
    first = next(i for i, each in enumerate(given_) if each)
    assert given_[first + 1] == ()
    assert robot.least_m >= 0.3


@given(
    allowed=st.booleans(),
    stated=st.none()
    | st.fixed_dictionaries(
        {}, optional={name: st.sampled_from([0.01, 0.2, 1.0, 0.0, -0.1, "0.1", None]) for name in NAMES}
    ),
)
def test_without_the_operators_word_or_a_number_it_is_refused_with_all_that_is_missing(
    tmp_path_factory, allowed, stated
):
    file = written(tmp_path_factory)
    base = Careful(stated=None if stated is None else SimpleNamespace(**stated))
    bad = [
        name
        for name in NAMES
        if stated is None
        or (value := stated.get(name)) in (-0.1, "0.1", None)
        or (name[0] == "b" and not value)
    ]
    try:
        require_reduced_margin(with_reduced_margin(file, allowed=allowed), base)
    except InputError as error:
        said = str(error)
        assert "corridor.scenario.yaml:5" in said
        assert ("--reduced-margin`, by" in said) == (not allowed)
        assert ("capabilities.reduced_margin of the robot" in said) == (stated is None)
        if stated is not None:
            assert [name for name in NAMES if f"reduced_margin.{name}:" in said] == bad
    else:
        assert allowed
        assert not bad
        assert kept_margin_m(base) <= 0.24
    assert base.log == []


def written(tmp_path_factory):
    path = tmp_path_factory.mktemp("s") / "corridor.scenario.yaml"
    path.write_text(corridor(), encoding="utf-8")
    return load_scenario(str(path))


@given(
    latency_s=st.floats(0.0, 1.0),
    call_s=st.floats(0.0, 1.0),
    braking_m_s2=st.floats(0.05, 3.0),
    sd_m=st.tuples(st.floats(0.0, 0.05), st.floats(0.0, 0.05)),
)
def test_the_margin_holds_for_the_robots_own_numbers_of_which_the_worse_count(
    tmp_path_factory, latency_s, call_s, braking_m_s2, sd_m
):
    stated = MarginStatement(
        latency_s=latency_s, braking_m_s2=braking_m_s2, tracker_sd_m=sd_m[0], path_sd_m=sd_m[1]
    )
    base = Careful(stated=stated, latency_s=call_s)
    needed_m = (
        0.15 + 0.2 * max(latency_s, call_s) + 0.2**2 / (2.0 * min(braking_m_s2, 1.0)) + 2.0 * hypot(*sd_m)
    )
    assert kept_margin_m(base) == pytest.approx(needed_m)
    file = with_reduced_margin(written(tmp_path_factory), allowed=True)
    if needed_m <= 0.24 - 1e-9:
        require_reduced_margin(file, base)
    elif needed_m >= 0.24 + 1e-9:
        with pytest.raises(InputError, match=f"at least {needed_m:.3f} m") as refused:
            require_reduced_margin(file, base)
        assert "0.24" in str(refused.value)


FACTS = {"hearing": ["good", "impaired"], "sight": ["good", "none"], "mobility": ["full", "cane"]}


@settings(max_examples=12)
@given(
    st.fixed_dictionaries(
        {},
        optional={
            "culture": st.sampled_from([one.spellings[0] for one in countries()]),
            "gender": st.sampled_from(["female", "male", "other"]),
            "education": st.integers(0, 8),
            "familiarity": st.sampled_from(["stranger", "close"]),
            "settings": st.fixed_dictionaries({"conversational_distance": st.floats(0.45, 1.0)}),
        },
    ),
    st.fixed_dictionaries(
        {},
        optional={"age": st.sampled_from([17, 40])}
        | {name: st.sampled_from(words) for name, words in FACTS.items()},
    )
    | st.just({"age": 40, "hearing": "good", "sight": "good", "mobility": "full"}),
)
def test_culture_never_lowers_a_margin(tmp_path_factory, culture, facts):
    """What the base may keep from Anna, tick by tick, is the same whatever else she declared."""
    path = tmp_path_factory.mktemp("s") / "corridor.scenario.yaml"

    def kept(profile: dict[str, object]) -> list[tuple[ReducedPassage, ...]]:
        path.write_text(corridor(profile=json.dumps({"name": "Anna", **profile})), encoding="utf-8")
        return passages_of(RobotOnMap(base := Careful(), resolved(load_scenario(str(path))).scene), base)

    fit = facts == {"age": 40, "hearing": "good", "sight": "good", "mobility": "full"}
    found = kept({**culture, **facts})
    assert found == kept(facts)
    assert any(found) == fit


def passages_of(robot: RobotOnMap, base: Careful) -> list[tuple[ReducedPassage, ...]]:
    """Of the goal in every tick of 9 s on the way to Bert; the robot asks Anna after 3 s of waiting."""
    found, act = [], None
    robot.sense()
    goal = robot.go(MotionGoal("navigate", "bert", PlannedPose(0.8, 0.0), 0.7))
    for tick in range(180):
        base.sleep(0.05)
        robot.sense()
        robot.motion()
        if act is None and tick == 110:
            act = robot.perform(ActGoal("ask_to_pass", "anna", "May I pass?"))
        if act is not None:
            robot.performance(act)
        robot.renew(goal)
        found.append(base.told("go")[-1].passages)
    return found


def test_a_run_of_a_robot_that_keeps_less_than_the_simulated_one_is_kept_and_replayed(here, comity):
    """The simulated one can keep 0.237 m."""
    (here / "corridor.scenario.yaml").write_text(corridor(margin=", margin_m: 0.22"), encoding="utf-8")
    ran = comity(
        "run",
        "corridor.scenario.yaml",
        "--robot",
        "careful:Careful",
        "--reduced-margin",
        "--out",
        "own",
        "--json",
    )
    assert (ran.code, ran.json["status"]) == (0, "done")
    assert "picture.png" in ran.json["files"]
    assert comity("replay", "own", "--out", "again.html").code == 0
    refused = comity("run", "own/scenario.yaml")
    assert refused.code == 2
    assert "0.237" in refused.err


def test_an_adapter_of_before_is_refused_in_words_and_works_without_a_margin(ran):
    robot = OldAdapter()
    with pytest.raises(InputError, match="it does not take a margin with its goals"):
        ran(robot)
    assert robot.log == []
    ran(robot, margin="")
    assert set(passages(robot)) == {()}


def test_the_command_asks_for_the_operators_word(here, comity):
    (here / "corridor.scenario.yaml").write_text(corridor(), encoding="utf-8")
    refused = comity("run", "corridor.scenario.yaml", "--robot", "careful:Careful")
    assert refused.code == 2
    assert "corridor.scenario.yaml:5" in refused.err
    assert not (here / "runs").exists()
    assert comity("run", "johanna", "--reduced-margin").code == 2
    done = comity("run", "corridor.scenario.yaml", "--robot", "careful:Careful", "--reduced-margin", "--json")
    assert done.code == 0
    assert [one["about"] for one in done.json["disturbances"] if one["kind"] == "passage"] == ["anna"]


def test_a_robot_in_a_process_of_its_own_states_its_numbers_and_receives_the_margin():
    with Watchdog("careful:Careful") as robot:
        assert robot.capabilities.reduced_margin == STATED
        passage = (ReducedPassage("anna", 4.0, ASIDE_M, 0.24),)
        robot.go(MapGoal("navigate", "bert", 6.7, LANE_M, 0.0, 0.2, passages=passage))
    with Watchdog("careful:OldAdapter") as robot:
        assert robot.capabilities.reduced_margin is None


@pytest.mark.integration
def test_a_real_process_in_real_time_passes_anna(here, comity):
    (here / "corridor.scenario.yaml").write_text(corridor(), encoding="utf-8")
    (here / "own.py").write_text(
        "from comity_executor import Watchdog\n\n\ndef make():\n    return Watchdog('careful:InRealTime')\n",
        encoding="utf-8",
    )
    ran = comity("run", "corridor.scenario.yaml", "--robot", "own:make", "--reduced-margin", "--json")
    assert ran.code == 0
    passed = [one for one in ran.json["disturbances"] if one["kind"] == "passage"]
    assert [one["about"] for one in passed] == ["anna"]
    assert passed[0]["end_s"] > passed[0]["t"]


def test_without_a_heading_nothing_is_known_of_where_a_person_faces(ran):
    robot = Careful(faces=False)
    assert "it is not known where they face" in told(ran(robot))[0]


def test_a_robot_that_has_lost_its_place_gives_no_leave(ran):
    robot = Careful()
    robot.tells = lambda here: None if robot.t > 104.0 else here
    ran(robot)
    assert set(passages(robot)) == {()}
