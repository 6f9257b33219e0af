"""A robot of one's own carries a scenario out: from where it is, at each person's distance and speed."""

from __future__ import annotations

import json
import math
from dataclasses import replace

import pytest
from gliding import SCENARIO, Gliding, gliding, written
from hypothesis import given, settings
from hypothesis import strategies as st

import comity
from comity.live.loading import load_robot
from comity.live.shadow import Shadow
from comity.live.start import as_seen, slowed
from comity.live_episode import LiveEpisode
from comity.preparation import prepare
from comity.scenario import load_scenario
from comity_executor import MapGoal
from comity_fis import InputError
from comity_sim2d.scene.person import PERSON_RADIUS_M

PROFILES = ("arab_woman", "german_woman", "arab_man", "german_man", "japanese_woman", "unknown")
BODIES_M = 0.45


@pytest.fixture
def file(here):
    return load_scenario(written(here, SCENARIO))


def carried_out(file, robot, **given_) -> comity.episode.Episode:
    live = LiveEpisode(prepare(as_seen(file, robot), **given_), robot=robot)
    live.run()
    return live.so_far()


@settings(max_examples=25)
@given(
    who=st.tuples(st.sampled_from(PROFILES), st.sampled_from(PROFILES)),
    start=st.tuples(st.floats(0.6, 1.6), st.floats(0.6, 5.4)),
    latency_s=st.sampled_from([0.0, 0.1, 0.25]),
)
def test_everybody_is_met_at_their_own_distance(tmp_path_factory, who, start, latency_s):
    """Whatever the robot's latency is; near people it is never faster than anybody may be."""
    file = load_scenario(written(tmp_path_factory.mktemp("s"), SCENARIO))
    robot = gliding(x=start[0], y=start[1], latency_s=latency_s)
    episode = carried_out(file, robot, profiles=dict(zip(("host", "guest"), who, strict=True)))
    assert episode.outcome == "success"
    for visit in episode.visits:
        wanted = episode.values[visit.person]["conversational_distance"].number
        assert visit.docked_at.distance_m == pytest.approx(wanted, abs=0.011)
        assert robot.furthest_speed_m_s(visit.person, 1.5) <= 0.5 + 1e-9
    assert robot.told("stop")[-1] is None  # it is left at rest


def test_the_speed_within_one_and_a_half_metres_is_the_persons_own(file):
    robot = gliding()
    episode = carried_out(file, robot)
    for visit in episode.visits:
        wanted = episode.values[visit.person]["approach_speed"].number
        assert episode.metrics.stopping[visit.person].speed_within_1_5_m_m_s <= 1.05 * wanted


def test_the_plan_starts_where_the_robot_is_and_sees_people(file):
    robot = gliding(x=2.0, y=5.0)
    robot.people["guest"] = (6.5, 2.0, 90.0)
    seen = as_seen(file, robot).scenario
    assert seen.robot.at_m == (2.0, 5.0)
    assert (seen.people["guest"].at_m, seen.people["guest"].facing_deg) == ((6.5, 2.0), 90.0)
    assert seen.people["host"].at_m == (3.0, 3.0)


def test_the_base_is_told_anew_when_a_person_moves(file):
    """It comes to where she is by then, at her distance: a goal beside a person moves along."""
    robot = gliding()
    prepared = prepare(as_seen(file, robot))
    sleep = robot.sleep

    def sleep_and_walk(seconds: float) -> None:
        sleep(seconds)
        robot.people["guest"] = (6.0, min(3.8, 3.0 + 0.1 * max(0.0, robot.t - 106.0)), 180.0)

    robot.sleep = sleep_and_walk
    live = LiveEpisode(prepared, robot=robot)
    live.run()
    guest = next(visit for visit in live.so_far().visits if visit.person == "guest")
    assert guest.outcome == "greeted"
    distance = prepared.values["guest"]["conversational_distance"].number
    stands = math.dist((robot.x, robot.y), robot.people["guest"][:2]) - BODIES_M
    assert stands == pytest.approx(distance, abs=0.06)


@pytest.mark.parametrize(("what", "words"), [("knows_where", "localisation"), ("tracks_people", "tracker")])
def test_a_robot_that_hears_nothing_of_its_place_or_of_people_stops(file, what, words):
    """Within half a second, the lease and its latency; and it goes on when it hears of them again."""
    robot = gliding()
    prepared = prepare(as_seen(file, robot))
    sleep = robot.sleep

    def sleep_and_fail(seconds: float) -> None:
        sleep(seconds)
        setattr(robot, what, not 103.0 <= robot.t < 108.0)

    robot.sleep = sleep_and_fail
    live = LiveEpisode(prepared, robot=robot)
    live.run()
    deaf = [v for t, _, _, v in robot.path if 103.0 + 0.5 + 0.3 + 0.1 < t < 108.0]
    assert set(deaf) == {0.0}
    assert live.so_far().outcome == "success"
    told = live.so_far().disturbances[0]
    assert words in told.text
    assert told.t == pytest.approx(3.5, abs=0.11)
    assert told.end_s == pytest.approx(8.0, abs=0.11)


def test_in_its_shadow_nothing_is_commanded(file):
    robot = gliding()
    live = LiveEpisode(prepare(as_seen(file, robot)), robot=Shadow(robot))
    live.run()
    assert robot.log == []
    assert live.plan.steps


def test_in_its_shadow_a_robot_that_others_drive_is_followed(file):
    """Driven to a person by hand it counts as docked, and what would be said is in the trace."""
    robot = gliding()
    prepared = prepare(as_seen(file, robot))
    step = next(step for step in prepared.plan.steps if step.person == "host")
    distance = step.parameters["conversational_distance"] + BODIES_M
    angle = math.radians(step.parameters["approach_bearing"])
    there = (3.0 + distance * math.cos(angle), 3.0 + distance * math.sin(angle))
    sleep = robot.sleep

    def driven(seconds: float) -> None:
        sleep(seconds)
        robot.x, robot.y = there
        robot.heading_rad = math.atan2(3.0 - there[1], 3.0 - there[0])

    robot.sleep = driven
    live = LiveEpisode(prepared, robot=Shadow(robot))
    live.run()
    host = next(visit for visit in live.so_far().visits if visit.person == "host")
    assert host.outcome == "greeted"
    assert robot.log == []


@given(most=st.floats(0.05, 3.0))
@settings(max_examples=15)
def test_a_cap_on_the_speed_only_lowers(tmp_path_factory, most):
    file = load_scenario(written(tmp_path_factory.mktemp("s"), SCENARIO))
    robot = gliding()
    limits = file.scenario.limits.model_copy(update={"reach_s": 600.0, "time_s": 3000.0})
    file = replace(file, scenario=file.scenario.model_copy(update={"limits": limits}))
    carried_out(slowed(file, most), robot)
    speeds = [goal.speed_m_s for goal in robot.told("go") if isinstance(goal, MapGoal)]
    assert max(speeds) <= min(most, file.scenario.robot.max_speed_m_s)


def test_what_people_say_on_the_way_holds_from_then_on(here):
    text = SCENARIO + "changes:\n  - {at_s: 0.5, person: guest, says: {conversational_distance: 1.4}}\n"
    robot = gliding()
    episode = carried_out(load_scenario(written(here, text)), robot)
    guest = next(visit for visit in episode.visits if visit.person == "guest")
    assert guest.docked_at.distance_m == pytest.approx(1.4, abs=0.011)
    assert [one.kind for one in episode.disturbances] == ["message"]


def test_what_the_simulated_world_would_do_does_not_happen_to_a_real_robot(here):
    """Walks, faults and stops are those of the real world."""
    text = SCENARIO + (
        "changes:\n  - {at_s: 1.0, emergency_stop_s: 100}\n"
        "  - {at_s: 1.0, person: guest, moves_to_m: [7, 5]}\n"
    )
    episode = carried_out(load_scenario(written(here, text)), gliding())
    assert episode.outcome == "success"
    assert episode.disturbances == ()


def test_a_stop_holds_until_it_is_resumed(file):
    """While it is pressed and after it was released nothing is begun; only `resume` goes on."""
    robot = gliding()
    live = LiveEpisode(prepare(as_seen(file, robot)), robot=robot)
    sleep = robot.sleep

    def sleep_and_press(seconds: float) -> None:
        sleep(seconds)
        robot.pressed = "the red button" if 103.0 <= robot.t < 105.0 else False
        if robot.t >= 107.0:
            live.resume()

    robot.sleep = sleep_and_press
    live.run()
    assert live.so_far().outcome == "success"
    begun = [t for t, command, _ in robot.log if command in ("go", "perform") and 103.05 < t < 107.0]
    assert begun == []
    assert {v for t, _, _, v in robot.path if 103.4 < t < 107.0} == {0.0}


def test_a_run_of_ones_own_robot_has_a_folder_whose_page_and_trace_answer_why(here, comity, monkeypatch):
    monkeypatch.syspath_prepend(str(here))
    (here / "gliding_base.py").write_text(
        "from gliding import Gliding\n\n\ndef base():\n    print('ready')\n"
        "    return Gliding({'host': (3.0, 3.0, 0.0), 'guest': (6.0, 3.0, 180.0)})\n",
        encoding="utf-8",
    )
    written(here, SCENARIO)
    answer = json.loads(
        comity("run", "two.scenario.yaml", "--robot", "gliding_base:base", "--out", "own", "--json").out
    )
    assert answer["outcome"] == "success"
    assert answer["robot"] == "gliding_base:base"
    assert answer["loop"]["ticks"] > 100
    assert {"run.json", "scenario.yaml", "plan.json", "trace.jsonl", "frames.csv", "replay.html"} <= {
        *answer["files"]
    }
    assert "conversational_distance" in comity("trace", "own", "--why", "5").out
    assert comity("replay", "own").code == 0
    again = json.loads(comity("run", "own/scenario.yaml", "--out", "simulated", "--json").out)
    assert [v["person"] for v in again["visits"]] == [v["person"] for v in answer["visits"]]


@pytest.mark.parametrize(
    "name", ["nothing_here:Base", "math:nothing", "math:pi", "builtins:dict", "no_such_entry", "math"]
)
def test_what_is_no_robot_is_refused_before_anything_is_written(here, comity, name):
    said = comity("run", "johanna", "--robot", name)
    assert said.code == 2
    assert said.err.startswith("comity: expected")
    assert not (here / "runs").exists()


def test_a_robot_that_cannot_be_made_is_told_with_its_reason(here, monkeypatch):
    monkeypatch.syspath_prepend(str(here))
    (here / "off.py").write_text("class Base:\n    def __init__(self):\n        raise OSError('no route')\n")
    with pytest.raises(InputError, match="OSError: no route"):
        load_robot("off:Base")


@pytest.mark.parametrize(
    ("text", "named", "said"),
    [
        ("x = 1\nclass Base:\n  def go(self)\n", "Base", ("SyntaxError", ".py:3")),
        ("import math\n\nnorth = 1 / 0\n", "Base", ("ZeroDivisionError", ".py:3")),
        ("import no_such_library\n", "Base", ("no_such_library", ".py:1")),
        ("class Base:\n    pass\n", "Bse", ("'Bse'", "Did you mean 'Base'?")),
        ("class Base:\n    pass\n", "", ("without the name of the class",)),
    ],
    ids=["syntax", "exception", "import", "typo", "no class"],
)
def test_what_is_wrong_with_the_module_of_a_robot_is_said_with_its_line(here, monkeypatch, text, named, said):
    monkeypatch.syspath_prepend(str(here))
    module = f"broken_{abs(hash(text))}"
    (here / f"{module}.py").write_text(text, encoding="utf-8")
    with pytest.raises(InputError) as refused:
        load_robot(f"{module}:{named}")
    assert all(each in str(refused.value) for each in said)


def raising() -> None:
    raise OSError("no answer")


@pytest.mark.parametrize("call", ["localisation", "tracks"])
@pytest.mark.parametrize("says", [lambda: None, raising])
def test_a_robot_that_does_not_know_where_it_is_or_whom_it_sees_is_waited_for_and_then_refused(
    file, call, says
):
    robot = gliding()
    setattr(robot, call, says)
    before = robot.t
    with pytest.raises(InputError, match="knows where it is and whom it sees"):
        as_seen(file, robot)
    assert robot.t - before == pytest.approx(10.0, abs=0.2)


@pytest.mark.parametrize("call", ["localisation", "tracks"])
def test_nothing_is_commanded_before_both_are_heard(file, call):
    """The plan was made when they were; then the robot starts anew, and hears of it after 3 s."""
    robot = gliding()
    prepared, own, sleep = prepare(as_seen(file, robot)), getattr(robot, call), robot.sleep

    def sleep_and_hear(seconds: float) -> None:
        sleep(seconds)
        if robot.t >= 103.0:
            setattr(robot, call, own)

    setattr(robot, call, lambda: None)
    robot.sleep = sleep_and_hear
    live = LiveEpisode(prepared, robot=robot)
    live.run()
    assert live.so_far().outcome == "success"
    assert min(t for t, command, _ in robot.log if command == "go") >= 103.0


def test_an_installed_package_offers_its_robots_by_name(here, monkeypatch):
    monkeypatch.syspath_prepend(str(here))
    info = here / "offering-1.0.dist-info"
    info.mkdir()
    (info / "METADATA").write_text("Metadata-Version: 2.1\nName: offering\nVersion: 1.0\n", encoding="utf-8")
    (info / "entry_points.txt").write_text("[comity.robots]\nglider = offering:make\n", encoding="utf-8")
    (here / "offering.py").write_text(
        "from gliding import Gliding\n\n\ndef make():\n    return Gliding({})\n", encoding="utf-8"
    )
    assert isinstance(load_robot("glider"), Gliding)
    with pytest.raises(InputError, match="one of glider"):
        load_robot("another")


def test_from_python_a_robot_is_an_argument():
    robot = Gliding({"johanna": (4.0, 3.0, 180.0)})
    episode = comity.run("johanna", robot=robot, adults_only=True)
    assert episode.outcome == "success"
    assert episode.loop is not None
    assert episode.loop.status == "success"


def test_the_base_receives_parameters_that_only_it_knows_with_each_goal_towards_a_person(file):
    """A parameter reaches the robot by its name, such as the gaze that the rulebook `evidence` decides."""
    robot = gliding()
    episode = carried_out(file, robot, rulebook="evidence")
    goals = [goal for goal in robot.told("go") if goal.kind in ("navigate", "dock", "face")]
    assert {goal.to for goal in goals} == {"host", "guest"}
    for goal in goals:
        assert goal.parameters["mutual_gaze"] == episode.values[goal.to]["mutual_gaze"].number


@pytest.mark.parametrize("radius_m", [0.11, 0.25, 0.4])
def test_a_robot_of_any_size_stands_at_the_target_distance_between_the_bodies(here, radius_m):
    file = load_scenario(written(here, SCENARIO.replace("robot: {", f"robot: {{radius_m: {radius_m}, ")))
    robot = gliding()
    episode = carried_out(file, robot)
    last = episode.visits[-1]
    between_centres_m = math.dist((robot.x, robot.y), robot.people[last.person][:2])
    target_m = episode.values[last.person]["conversational_distance"].number
    assert between_centres_m == pytest.approx(target_m + radius_m + PERSON_RADIUS_M, abs=0.011)


def test_a_shadow_states_what_the_robot_states_of_its_reach_and_its_range(file):
    robot = gliding()
    robot.gesture_reach_m = {"wave": 2.0}
    assert Shadow(robot).gesture_reach_m == {"wave": 2.0}
    assert not hasattr(Shadow(gliding()), "gesture_reach_m")
