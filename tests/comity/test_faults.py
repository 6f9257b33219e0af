"""Things go wrong, and the robot goes on or says why not: every fault is real, and the trace names it."""

from __future__ import annotations

import json
from itertools import pairwise
from pathlib import Path

import pytest
from fault_study import OUTCOMES, answers_of, episode, is_lost, place_of, played, row, tracks_of
from judging import Body, contacts_with_people
from places import FLAT, HALL

import comity as front_door
from comity.monitoring.replanning import WorldPlanner
from comity.preparation import prepare
from comity.scenario import load_scenario
from comity_executor import Execution, read_trace
from comity_fis import InputError
from comity_sim2d import Person, RobotBody, Room, Scene, World

VISIT = HALL + "faults:\n"
STUDY = FLAT + "goals: [{greet: guest}]\nfaults:\n"


@pytest.fixture
def run(here):
    """Run a visit with these faults."""

    def visit(*faults: str, text: str = VISIT, more: str = "", out: str | None = None):
        listed = "".join(f"  - {{{fault}}}\n" for fault in faults) or "  []\n"
        (here / "visit.scenario.yaml").write_text(text + listed + more)
        return front_door.run("visit.scenario.yaml", out=out)

    return visit


def chains(ran) -> list[str]:
    """Every chain with a fault in it, in words."""
    return [
        "; ".join(cause.text for cause in event.because)
        for event in ran.events
        if any(cause.kind == "fault" for cause in event.because)
    ]


def moved_m(ran, start_s: float, end_s: float) -> float:
    track = [body for body in tracks_of(ran)["robot"] if start_s <= body.t <= end_s]
    return sum(((b.x - a.x) ** 2 + (b.y - a.y) ** 2) ** 0.5 for a, b in pairwise(track))


def test_nothing_goes_wrong_and_no_fault_is_named(run):
    assert chains(run()) == []


def test_with_a_stuck_wheel_the_robot_stands_and_then_goes_on(run):
    ran = run("at_s: 2, fault: wheel stuck, for_s: 6")
    assert moved_m(ran, 0.5, 1.9) > 0.3
    assert moved_m(ran, 2.1, 7.9) < 0.001
    assert ran.outcome == "success"
    assert "fault at t=2 s: wheel stuck for 6 s; blocked: no progress towards anna" in chains(ran)[0]


def test_a_fault_that_held_the_robot_up_is_named_also_where_it_is_over_when_patience_is(run):
    """The robot stands for 3 s before it says that it is blocked, and gives up 2 s later."""
    ran = run("at_s: 2, fault: wheel stuck, for_s: 5")
    (failed,) = [event for event in ran.events if "Navigate" in event.node and event.status == "failure"]
    assert failed.t > 7.0
    assert failed.because[0].text == "fault at t=2 s: wheel stuck for 5 s"


def test_a_door_that_is_shut_elsewhere_is_not_behind_what_a_wheel_does(run):
    """The bedroom's door is on no way of this visit; it was named once the wheel was free."""
    ran = run(
        "at_s: 1, fault: door closes, door: bedroom",
        "at_s: 2, fault: wheel stuck, for_s: 5",
        text=STUDY,
    )
    held_up = [event for event in ran.events if "no progress" in str(event.because)]
    assert held_up
    assert {cause.text for event in held_up for cause in event.because if cause.kind == "fault"} == {
        "fault at t=2 s: wheel stuck for 5 s"
    }


def test_speech_that_fails_is_broken_off_and_said_again(run):
    ran = run("at_s: 3, fault: speech fails, for_s: 8")
    said = [act for act in ran.acts if act.act == "say"]
    assert [act.stopped for act in said] == [True] * (len(said) - 1) + [False]
    assert len(said) > 1
    assert all(act.t_start < 11.0 for act in said[:-1])
    assert ran.outcome == "success"
    assert "fault at t=3 s: speech fails for 8 s; say was broken off" in chains(ran)[0]


def test_asked_why_while_an_act_pauses_the_trace_says_before_which_attempt_and_until_when(run):
    ran = run("at_s: 3, fault: speech fails, for_s: 8")
    (first, second, *_) = (e for e in ran.events if e.node == "say(anna)" and e.status == "failure")
    says = "say was broken off, it pauses before attempt {} until t={:.2f} s"
    for attempt, failed in ((2, first), (3, second)):
        (why,) = (why for why in ran.why(failed.t + 0.5) if why.event.node == "say(anna)")
        assert why.because[1].text == says.format(attempt, failed.t + 1.0)
        (begins,) = (e.t for e in ran.events if e.node == "say(anna)" and failed.t < e.t <= failed.t + 1.0)
        assert begins == pytest.approx(failed.t + 1.0)
        timeout = next(node for node in ran.nodes if node.name == "Timeout 10 s(say, anna)")
        assert ran.history.why_node(timeout.path, failed.t + 0.5).switched_by == failed


def test_the_last_attempt_at_an_act_has_no_pause_after_it(run):
    ran = run("at_s: 3, fault: speech fails, for_s: 60", more="limits: {act_s: 2.5, replans: 0}\n")
    last = [e for e in ran.events if e.node == "say(anna)" and e.status == "failure"][-1]
    assert last.because[1].text == "say was broken off"


def test_a_fault_is_named_once_where_the_robot_sees_nothing(run):
    (told, *_) = (chain for chain in chains(run("at_s: 3, fault: sensor blind, for_s: 4")) if "sees" in chain)
    assert told.startswith("fault at t=3 s: sensor blind for 4 s; blocked: it sees nothing; Reach_user")


def test_a_robot_that_sees_nothing_stands_until_it_sees_again(run):
    ran = run("at_s: 3, fault: sensor blind, for_s: 4")
    assert moved_m(ran, 5.0, 6.9) < 0.001, "after it has braked"
    assert ran.outcome == "success"
    assert any("sensor blind for 4 s" in chain and "it sees nothing" in chain for chain in chains(ran))


def test_a_greeting_goes_on_a_moment_without_seeing(run):
    """Docked, the robot believes the last reading for `unseen_s`."""
    before = run()
    at_s = before.visits[0].docked_s + 0.2
    assert run(f"at_s: {at_s:.2f}, fault: sensor blind, for_s: 0.6").visits[0].docked_s == pytest.approx(
        before.visits[0].docked_s
    )


def test_whoever_walks_off_in_mid_greeting_is_followed_and_no_gesture_is_done_twice(run):
    at_s = run().visits[0].docked_s + 0.5
    ran = run(f"at_s: {at_s:.2f}, fault: person walks off, person: anna, by_m: 1.2, facing_deg: 180")
    assert ran.outcome == "success"
    assert any(f"at t={at_s:g} s: anna walks off" in chain and "docked?" in chain for chain in chains(ran))
    done = [(act.act, act.person) for act in ran.acts if not act.stopped]
    assert len(done) == len(set(done))


def test_whoever_stands_in_the_way_goes_back_where_they_came_from(run):
    ran = run("at_s: 1, fault: person in the way, person: marta, for_s: 3")
    marta = tracks_of(ran)["marta"]
    assert min(abs(body.y - 2.5) for body in marta) < 0.2, "on the straight way to Anna"
    assert (marta[-1].x, marta[-1].y) == pytest.approx((3.5, 0.6))
    assert ran.outcome == "success"
    assert ran.metrics.touches == 0


BYSTANDER = VISIT.replace(
    "goals: [{greet: anna}]",
    "  eve: {at_m: [3.5, 4.4], facing_deg: -90}\ngoals: [{greet: anna}, {wait_s: 20, with: anna}]",
)


def test_whoever_cannot_get_onto_the_way_for_others_stands_near_it_and_goes_back(run):
    there = "changes:\n  - {at_s: 1.2, person: eve, moves_to_m: [3.1, 2.4], speed_m_s: 3}\n"
    ran = run("at_s: 2, fault: person in the way, person: marta, for_s: 3", text=BYSTANDER, more=there)
    marta = tracks_of(ran)["marta"]
    assert 1.2 < max(body.y for body in marta) < 2.2, "Eve stands where she is to go"
    assert (marta[-1].x, marta[-1].y) == pytest.approx((3.5, 0.6))
    assert ran.outcome == "success"


def test_whoever_was_in_the_way_goes_back_round_others_who_stand_there_by_then(run):
    there = "changes:\n  - {at_s: 4.2, person: eve, moves_to_m: [3.3, 1.3], speed_m_s: 3}\n"
    ran = run("at_s: 2, fault: person in the way, person: marta, for_s: 6", text=BYSTANDER, more=there)
    tracks = tracks_of(ran)
    assert max(body.y for body in tracks["marta"]) == pytest.approx(2.5, abs=0.2)
    eve = tracks["eve"][-1]
    assert (eve.x, eve.y) == pytest.approx((3.3, 1.3)), "she stands there to the end"
    assert (tracks["marta"][-1].x, tracks["marta"][-1].y) == pytest.approx((3.5, 0.6))
    assert ran.outcome == "success"


def test_a_door_that_shuts_is_waited_for_and_one_that_stays_shut_ends_the_visit(run):
    short = run("at_s: 1, fault: door closes, door: study, for_s: 12", text=STUDY)
    assert short.outcome == "success"
    assert short.metrics.duration_s > 13.0
    for_good = run("at_s: 1, fault: door closes, door: study", text=STUDY)
    assert for_good.outcome == "failed"
    assert chains(for_good)[0].startswith("fault at t=1 s: study closes; study was shut")
    assert "no free and reachable place before guest" in for_good.visits[0].failure
    opened = run(
        "at_s: 1, fault: door closes, door: study", "at_s: 9, fault: door opens, door: study", text=STUDY
    )
    assert opened.outcome == "success"


@pytest.mark.parametrize(("pressed_s", "held_s"), [(3.0, 1.0), (5.0, 9.5), (6.0, 1.0)])
def test_a_stop_may_be_pressed_and_resumed_while_the_robot_waits_for_a_door(run, pressed_s, held_s):
    """The next plan may take over in the very tick in which it resumes."""
    stop = f"{{at_s: {pressed_s}, emergency_stop_s: {held_s}}}"
    more = f"changes: [{stop}]\nlimits: {{resumes: true}}\n"
    ran = run("at_s: 1, fault: door closes, door: study, for_s: 12", text=STUDY, more=more)
    stood = [(event.status, event.halt) for event in ran.events if event.node == "Stand_still"]
    assert stood == [("running", None), ("halted", "preempted")]
    assert ran.outcome == "success"


def test_a_walk_through_a_door_that_shuts_hinders_no_new_plan_for_others_and_no_picture(run):
    """What the robot plans in and what is drawn at the end are places in which that walk cannot be walked."""
    walker = "  kim: {at_m: [4.4, 4.9], walks: {route: [[7.2, 7.0], [4.4, 4.9]], loop: true}}\n"
    host = "  host: {at_m: [1.4, 1.4], facing_deg: 0}\n"
    text = STUDY.replace("people:\n", f"people:\n{walker}{host}")
    text = text.replace("{greet: guest}", "{greet: guest}, {greet: host}")
    ran = run("at_s: 4, fault: door closes, door: study", text=text, out="visit")
    outcomes = {visit.person: visit.outcome for visit in ran.visits}
    assert outcomes == {"guest": "unreached", "host": "greeted"}
    assert "in one place" not in "".join(chains(ran))
    assert Path("visit/picture.png").exists()


def test_a_door_stays_shut_until_the_last_that_shut_it_is_over(run):
    ran = run(
        "at_s: 1, fault: door closes, door: study, for_s: 12",
        "at_s: 2, fault: door closes, door: study, for_s: 2",
        text=STUDY,
    )
    assert [(turn.t, turn.is_open) for turn in ran.door_turns] == [(1.0, False), (13.0, True)]


@pytest.mark.parametrize(("fault", "door"), [("opens", "study"), ("closes", "bath")])
def test_a_door_that_is_so_already_is_not_turned_back(run, fault: str, door: str):
    """The study is open, the bath is shut from the start."""
    assert run(f"at_s: 1, fault: door {fault}, door: {door}, for_s: 2", text=STUDY).door_turns == ()


def test_a_door_that_is_opened_for_a_while_is_named_with_its_fault_when_it_shuts(run):
    ran = run(
        "at_s: 1, fault: door opens, door: study, for_s: 4",
        "at_s: 20, fault: door opens, door: study",
        text=STUDY.replace("place: {map: apartment}", "place: {map: apartment, doors: {study: closed}}"),
    )
    assert [(turn.t, turn.is_open) for turn in ran.door_turns] == [(1.0, True), (5.0, False), (20.0, True)]
    told = " ".join(chains(ran))
    assert "fault at t=1 s: study opens for 4 s; study was opened" in told
    assert "fault at t=1 s: study opens for 4 s; study was shut" in told
    assert ran.outcome == "success"


def test_where_a_run_is_late_for_a_fault_the_difference_names_it(comity, here):
    (here / "calm.scenario.yaml").write_text(VISIT + "  []\n")
    (here / "stuck.scenario.yaml").write_text(VISIT + "  - {at_s: 0, fault: wheel stuck, for_s: 3}\n")
    for name in ("calm", "stuck"):
        assert comity("run", f"{name}.scenario.yaml", "--out", name).code == 0
    assert "fault at t=0 s: wheel stuck for 3 s" in comity("trace", "calm", "--diff", "stuck").out
    (*_, apart) = comity("trace", "calm", "--diff", "stuck", "--json").json["differences"]
    assert "fault" in json.dumps(apart)


def test_a_planner_that_fails_is_asked_again(run):
    """Anna cannot be reached for a while; the calls for another plan raise, and the third answers."""
    ran = run(
        "at_s: 0, fault: door closes, door: study, for_s: 10",
        "at_s: 0, fault: planner fails, calls: 2",
        text=STUDY,
    )
    assert ran.outcome == "success"
    told = [
        event for event in ran.events if event.because and event.because[0].text.endswith("planner fails")
    ]
    assert len(told) == 2
    assert {event.status for event in told} == {"not_replanned"}


def test_what_is_permitted_can_be_told_while_the_robot_stands_where_somebody_was(here):
    """Marta has walked away since the plan was made, and the robot is where she stood."""
    (here / "visit.scenario.yaml").write_text(VISIT + "  []\n")
    prepared = prepare(load_scenario("visit.scenario.yaml"))
    world = World(prepared.scene, seed=0, route_map=prepared.route_map)
    world.move_person("marta", 3.0, 2.5, 0.0)
    world.step()
    planner = WorldPlanner(prepared, world)
    world.move_person("marta", 7.0, 0.5, 0.0)
    world.step()
    execution = Execution(prepared.plan, world.robot, prepared.values)
    while abs(world.robot.pose.x_m - 3.0) > 0.2:
        execution.tick()
        world.step()
    assert planner.permitted(execution._course(world.time_s)) is None, "all of it is"


@pytest.mark.parametrize(
    "leaf",
    ["docked?", "Navigate_to_user(anna)", "say", "Give_up", "all_greeted?", "plan_holds?", "emergency?"],
)
def test_a_leaf_that_raises_fails_with_its_cause_and_the_visit_goes_on(run, leaf: str):
    at_s = run().visits[0].docked_s + 0.2 if leaf == "docked?" else 1.0
    ran = run(f"at_s: {at_s:.2f}, fault: leaf raises, leaf: '{leaf}', times: 2")
    assert ran.outcome == "success"
    raised = [
        event for event in ran.events if any(c.text.endswith(f"leaf {leaf} raises") for c in event.because)
    ]
    assert bool(raised) == (leaf != "Give_up"), "which is not ticked, as nothing fails"
    if leaf == "emergency?":
        assert {event.halt for event in raised if event.halt} == {"emergency"}


@pytest.mark.parametrize("leaf", ["plan_holds?", "Give_up", "all_greeted?", "emergency?", "given_up?"])
def test_everybody_ends_with_an_outcome_and_a_reason_whatever_leaf_keeps_raising(run, leaf: str):
    """The wheel is stuck for good, so that the visit has to be given up; at the cap or at the limit."""
    for time_s in (300, 6):
        ran = run(
            f"at_s: 0, fault: leaf raises, leaf: '{leaf}', times: 1000",
            "at_s: 1, fault: wheel stuck, for_s: 1000",
            more=f"limits: {{time_s: {time_s}}}\n",
        )
        assert ran.outcome in ("failed", "stopped")
        assert [visit.outcome for visit in ran.visits] == ["unreached"]
        assert all(visit.failure for visit in ran.visits)
        if ran.outcome == "stopped":
            assert ran.visits[0].failure == (
                "the scenario's limit of 6 s was reached (`time_s` of its limits allows more)"
            )


def test_two_faults_of_one_part_last_until_both_are_over(run):
    ran = run("at_s: 2, fault: wheel stuck, for_s: 2", "at_s: 3, fault: wheel stuck, for_s: 3")
    assert moved_m(ran, 2.1, 5.9) < 0.001
    assert ran.outcome == "success"


def test_the_run_folder_the_trace_and_its_answers_name_the_fault(comity, here, run):
    run("at_s: 2, fault: wheel stuck, for_s: 6")
    assert comity("run", "visit.scenario.yaml", "--out", "one").code == 0
    events = comity("trace", "one", "--events", "--node", "Navigate").out
    assert "(fault at t=2 s: wheel stuck for 6 s)" in " ".join(events.split())
    why = comity("trace", "one", "--why", "8").out
    assert "(fault at t=2 s: wheel stuck for 6 s)" in " ".join(why.split())
    (answer, *_) = comity("trace", "one", "--why", "8", "--json").json["why"]
    assert answer["because"][0] == {
        "kind": "fault",
        "text": "fault at t=2 s: wheel stuck for 6 s",
        "value": None,
    }
    assert [c.kind for event in read_trace(here / "one" / "trace.jsonl") for c in event.because].count(
        "fault"
    )
    assert comity("run", "one/scenario.yaml", "--out", "two", "--json").code == 0
    digests = [json.loads((here / name / "run.json").read_text())["trace_sha256"] for name in ("one", "two")]
    assert digests[0] == digests[1], "the resolved scenario has the faults"


@pytest.mark.parametrize(
    ("fault", "expected"),
    [
        ("{at_s: 2, fault: wheel stuk, for_s: 2}", ["'wheel stuk'", "wheel stuck"]),
        ("{at_s: 2, for_s: 2}", ["the key 'fault'"]),
        ("{at_s: 2, fault: wheel stuck}", ["the key 'for_s'"]),
        ("{at_s: 2, fault: sensor blind, for_s: -1}", ["for_s", "-1"]),
        ("{at_s: -2, fault: planner fails}", ["at_s", "-2"]),
        ("{at_s: 2, fault: planner fails, calls: 0}", ["calls", "0"]),
        ("{at_s: 2, fault: planner fails, person: anna}", ["a known key", "'person'"]),
        ("{at_s: 2, fault: person walks off, person: ana}", ["'ana'", "a person from `people`", "anna"]),
        ("{at_s: 2, fault: door closes, door: kitchen}", ["a door of the map", "'kitchen'", "Use a map"]),
        ("{at_s: 2, fault: leaf raises, leaf: sai}", ["a leaf of the plan's tree", "'sai'", "say"]),
        ("{at_s: 2, fault: leaf raises, leaf: Goal}", ["a leaf of the plan's tree", "'Goal'"]),
        ("wheel stuck", ["mapping"]),
        (
            "{at_s: 2, fault: person walks off, person: anna, speed_m_s: 0}",
            ["speed_m_s above 0, got 0. Give a number of metres per second above 0."],
        ),
        (
            "{at_s: 2, fault: person walks off, person: anna, speed_m_s: 5}",
            ["Give a number of metres per second up to 3."],
        ),
        ("{at_s: 1, fault: wheel stuk, for_s: 1}", ["a known fault", "Did you mean 'wheel stuck'?"]),
    ],
)
def test_a_fault_that_cannot_be_is_refused_with_its_line(comity, here, fault: str, expected: list[str]):
    (here / "visit.scenario.yaml").write_text(VISIT + f"  - {fault}\n")
    said = comity("run", "visit.scenario.yaml")
    assert said.code == 2
    assert "visit.scenario.yaml:10" in said.err.replace("\n", "")
    words = " ".join(said.err.split())
    assert all(each in words for each in expected), words
    assert not (here / "runs").exists()


def test_a_door_of_the_map_is_named_where_another_is_misspelt(comity, here):
    (here / "flat.scenario.yaml").write_text(STUDY + "  - {at_s: 2, fault: door closes, door: studi}\n")
    words = " ".join(comity("run", "flat.scenario.yaml").err.split())
    assert "'studi'" in words
    assert "study" in words


def test_the_judge_sees_a_planted_collision():
    """Somebody is put before a robot at full speed, too near for it to stop: the robot is to blame."""
    scene = Scene(Room.rectangle(8.0, 4.0), RobotBody(1.0, 2.0), (Person("anna", 7.0, 2.0, 0.0),))
    world = World(scene)
    world.robot.navigate("anna", pose_of(1.0), speed_m_s=0.7)
    world.run(2.5)
    robot = world.robot.pose
    world.move_person("anna", robot.x_m + 0.25 + 0.20 + 0.05, robot.y_m, 0.0)
    world.run(1.0)
    tracks: dict[str, list[Body]] = {}
    for t, entity, x, y, heading, radius in world.frames.rows():
        tracks.setdefault(entity, []).append(Body(t, x, y, heading, radius))
    (contact,) = contacts_with_people(tracks)
    assert (contact.entity, contact.by_robot) == ("anna", True)


def pose_of(distance_m: float):
    from comity_sim2d import DockingPose

    return DockingPose(distance_m, 180.0)


def test_a_robot_that_just_stands_is_counted_as_lost():
    there = place_of(0)
    stuck = [{"at_s": 0.0, "fault": "wheel stuck", "for_s": 250.0}]
    answer = {"possible": True, "outcome": played(there, stuck, 0).outcome}
    assert is_lost(answer)


def test_a_run_ends_at_rest_also_where_the_robot_goes_back_before_somebody_at_the_end():
    assert episode(196)["at_rest"]


def hold(answers) -> None:
    """What is claimed of schedules."""
    assert [answer for answer in answers if "exception" in answer] == []
    assert {answer["outcome"] for answer in answers} <= set(OUTCOMES)
    assert all(answer["at_rest"] for answer in answers)
    assert [answer for answer in answers if answer["by_robot"]] == []
    possible = [answer for answer in answers if answer["possible"]]
    assert len(possible) > 0.7 * len(answers)
    assert sum(map(is_lost, possible)) <= 0.03 * len(possible)
    assert sorted(answer["ratio"] for answer in possible)[len(possible) // 2] <= 1.25


def test_random_schedules_end_as_they_should():
    """A fixed sample of the study."""
    hold([episode(seed) for seed in range(100, 120)])


@pytest.mark.study
def test_a_thousand_random_schedules_end_as_they_should():
    """The table in docs/how-to/let-things-go-wrong.md; `pytest -s` prints it."""
    answers = answers_of(1000)
    print(row("any", answers))
    hold(answers)


def test_a_door_that_somebody_stands_in_waits_and_the_trace_says_for_whom(run):
    text = FLAT.replace("people:", "people:\n  dan: {at_m: [6.4, 4.4], facing_deg: 0}", 1)
    ran = run(
        "at_s: 1, fault: door closes, door: study",
        text=text + "changes: [{at_s: 6, person: dan, moves_to_m: [5.5, 4.0]}]\n"
        "goals: [{greet: guest}]\nfaults:\n",
    )
    (turn,) = ran.door_turns
    assert turn.t > 6.0
    told = "fault at t=1 s: study closes; the door 'study' cannot be shut: dan stands in it; it waits"
    assert sum(told in chain for chain in chains(ran)) == 1


def test_a_door_that_furniture_keeps_open_cannot_be_told_to_shut(here):
    (here / "narrow.map.yaml").write_text(
        "schema_version: 1\nname: narrow\n"
        "rooms: {hall: {box_m: [0, 0, 4, 4]}, study: {box_m: [4, 0, 4, 4]}}\n"
        "doors: {study: {at_m: [4, 2], width_m: 1.4}}\n"
        "furniture: [{name: crate, box_m: [3.8, 2.45, 0.5, 0.5]}]\n"
    )
    text = (
        "schema_version: 1\nname: visit\nplace: {map: narrow.map.yaml}\nrobot: {at_m: [1, 1]}\n"
        "people: {guest: {at_m: [6.5, 2], facing_deg: 180}}\ngoals: [{greet: guest}]\nfaults:\n"
        "  - {at_s: 1, fault: FAULT}\n"
    )
    scenario = here / "visit.scenario.yaml"
    for fault in ("door closes, door: study", "door opens, door: study, for_s: 3"):
        scenario.write_text(text.replace("FAULT", fault))
        with pytest.raises(InputError, match=r"yaml:8: .*'study', in which the crate stands.*Move the crate"):
            front_door.run("visit.scenario.yaml")
    scenario.write_text(text.replace("FAULT", "door opens, door: study"))
    assert front_door.run("visit.scenario.yaml").outcome == "success"
