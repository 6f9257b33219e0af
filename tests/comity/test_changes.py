"""Episodes in which things change: numbers are bound anew, plans are made anew, and the trace says why."""

from __future__ import annotations

import json
import math
import re

import pytest

import comity as front_door
from comity.live_episode import LiveEpisode
from comity.monitoring.replanning import WorldPlanner
from comity.preparation import prepare
from comity.scenario import load_scenario
from comity_executor import ExecutionState, NoPlanUpdate, PlanUpdate, read_nodes, read_trace
from comity_sim2d import World

LOUNGE = """\
schema_version: 1
name: lounge
place: {width_m: 10, height_m: 6}
robot: {at_m: [1, 3]}
people:
  anna: {profile: german_woman, at_m: [5, 5], facing_deg: -90}
  bob: {profile: arab_man, at_m: [8, 1.5], facing_deg: 180}
goals:
  - greet: anna
  - greet: bob
changes:
"""
BOB_ASKS = "  - {at_s: 3, person: bob, says: {conversational_distance: 1.4}}\n"
ANNA_GOES = "  - {at_s: 2, person: anna, moves_to_m: [9, 5], facing_deg: -90}\n"
STOP = "  - {at_s: 4, emergency_stop_s: 2.5}\n"
RESUMES = "limits: {resumes: true}\n"


@pytest.fixture
def run(here):
    """Run the lounge with these changes."""

    def lounge(*changes: str, more: str = ""):
        (here / "lounge.scenario.yaml").write_text(LOUNGE + "".join(changes or ["  []\n"]) + more)
        return front_door.run("lounge.scenario.yaml")

    return lounge


def of_plans(episode):
    return [event for event in episode.events if event.status in ("rebound", "replanned", "not_replanned")]


def texts(event) -> str:
    return "\n".join(cause.text for cause in event.because)


def test_nothing_changes_and_nothing_is_revised(run):
    assert of_plans(run()) == []


def test_a_wish_on_the_way_binds_new_numbers_to_the_same_choices_and_says_how_that_is_known(run):
    """Bob's distance is a behaviour parameter; his side and greeting, action parameters, stay as planned."""
    before, after = run(), run(BOB_ASKS)
    (event,) = of_plans(after)
    assert (event.status, event.node, event.t) == ("rebound", "plan_holds?", pytest.approx(3.0))
    assert "bob asked for conversational_distance 1.4" in texts(event)
    assert "conversational_distance of bob 0.8753 -> 1.4000 (setting)" in texts(event)
    assert re.search(r"they cost \d+ cm now, and an exact search .* finds nothing cheaper", texts(event))
    (_, old), (_, new) = before.visits, after.visits
    assert old.docked_at.distance_m == pytest.approx(0.8753, abs=0.01)
    assert new.docked_at.distance_m == pytest.approx(1.4, abs=0.01)
    assert new.greeting == old.greeting
    assert new.wanted.bearing_deg == old.wanted.bearing_deg
    assert len(after.nodes) == len(before.nodes), "the tree is the same one"


def test_somebody_who_walks_elsewhere_makes_another_plan_cheaper_and_the_numbers_say_so(run):
    episode = run(ANNA_GOES)
    (event,) = of_plans(episode)
    assert event.status == "replanned"
    assert re.search(r"anna moved by 4\.\d\d m", texts(event))
    kept, other = map(int, re.search(r"would cost (\d+) cm now, others (\d+) cm", texts(event)).groups())
    assert other < kept
    assert episode.outcome == "success"
    anna, bob = episode.visits
    assert bob.docked_s < anna.docked_s, "the order is the other way round"
    assert run().visits[0].docked_s < run().visits[1].docked_s


def test_new_plans_have_a_cap_and_then_the_choices_stay(run):
    (event,) = of_plans(run(ANNA_GOES, more="limits: {replans: 0}\n"))
    assert event.status == "rebound"
    assert "the limit of new plans is reached" in texts(event)


CONSENTING = "german_host, situation: {touch_consent: given}, at_m: [5, 5]"


@pytest.mark.parametrize("replans", [0, 1, 4])
def test_consent_taken_back_and_a_wish_are_kept_whether_or_not_new_plans_are_used_up(here, replans):
    text = LOUNGE.replace("german_woman, at_m: [5, 5]", CONSENTING).replace("  - greet: bob\n", "")
    asks = "  - {at_s: 1, person: anna, says: {greeting_modality: gestural}}\n"
    changes_her_mind = "  - {at_s: 1.5, person: anna, says: {greeting_modality: both}}\n"
    withdraws = "  - {at_s: 2, person: anna, situation: {touch_consent: withheld}}\n"
    (here / "lounge.scenario.yaml").write_text(
        text + asks + changes_her_mind + withdraws + f"limits: {{replans: {replans}}}\n"
    )
    episode = front_door.run("lounge.scenario.yaml")
    assert episode.outcome == "success"
    acts = [act.act for act in episode.acts]
    assert "say" in acts  # both, as she asked last
    assert len(acts) > 1
    assert "handshake" not in acts


WITHDRAWS = "  - {at_s: 2, person: anna, situation: {touch_consent: withheld}}\n"


@pytest.mark.parametrize("broken", ["fails for good", "fails once"])
def test_no_never_means_yes_because_no_new_plan_is_to_be_had(here, broken: str):
    """Consent is withdrawn on the way, in the moment in which planning breaks down: nobody is touched."""
    text = LOUNGE.replace("german_woman, at_m: [5, 5]", CONSENTING) + WITHDRAWS
    calls = {"fails for good": [1000] * 5, "fails once": [1]}[broken]
    fails = [f"  - {{at_s: 1.9, fault: planner fails, calls: {count}}}" for count in calls]
    (here / "lounge.scenario.yaml").write_text(text + "\n".join(["faults:", *fails]))
    live = LiveEpisode(prepare(load_scenario("lounge.scenario.yaml")))
    planned = {step.person: step.arguments[-1] for step in live.plan.steps if step.action == "Greet_person"}
    assert planned["anna"] == "handshake"
    live.run()
    episode = live.so_far()
    anna, bob = sorted(episode.visits, key=lambda visit: visit.person)
    assert bob.outcome == "greeted"
    assert "handshake" not in (act.act for act in episode.acts)
    assert (anna.outcome == "greeted") == (broken != "fails for good")
    if broken == "fails for good":
        assert episode.outcome == "partial"
        assert "anna is not to be greeted" in anna.failure
        assert any("no longer permitted" in texts(event) for event in of_plans(episode))
    before, after = episode.frames.of("robot")[-2:]
    assert before == pytest.approx(after), "the robot is at rest"


def test_who_seems_to_stand_in_the_robot_hinders_neither_a_new_plan_nor_a_ban(here):
    """A touch, or a noisy look that is taken for one: they are taken to stand beside it."""
    (here / "lounge.scenario.yaml").write_text(LOUNGE.replace("changes:\n", ""))
    prepared = prepare(load_scenario("lounge.scenario.yaml"))
    world = World(prepared.scene)
    planner = WorldPlanner(prepared, world)
    x_m, y_m = world.robot.pose.xy
    world.move_person("anna", x_m + 0.3, y_m, 0.0)
    world.step()
    course = ExecutionState(world.time_s, prepared.plan, prepared.values, (), {}, may_replan=True)
    assert planner.permitted(course) is None, "all of it is, wherever anybody stands"
    assert isinstance(planner.replan(course), PlanUpdate)


def test_who_seems_to_stand_in_the_robot_where_there_is_no_room_beside_it_hinders_a_new_plan_for_now(here):
    """Behind a robot in a recess 70 cm wide there are 20 cm: it may pass."""
    recess = "height_m: 6, walls_m: [[[0, 2.6], [1, 2.6]], [[0, 3.4], [1, 3.4]]]"
    text = (
        LOUNGE.replace("changes:\n", "")
        .replace("height_m: 6", recess)
        .replace("at_m: [1, 3]", "at_m: [0.5, 3]")
    )
    (here / "lounge.scenario.yaml").write_text(text)
    prepared = prepare(load_scenario("lounge.scenario.yaml"))
    world = World(prepared.scene)
    planner = WorldPlanner(prepared, world)
    world.move_person("anna", 0.25, 3.0, 0.0)
    world.step()
    course = ExecutionState(world.time_s, prepared.plan, prepared.values, (), {}, may_replan=True)
    refused = planner.replan(course)
    assert isinstance(refused, NoPlanUpdate)
    assert refused.may_pass
    assert "no new plan while anna and others seem to be in one place" in refused.because[-1].text
    world.move_person("anna", 5.0, 5.0, -math.pi / 2)
    world.step()
    assert isinstance(planner.replan(course), PlanUpdate)


def test_wishes_do_not_use_up_the_new_plans_for_other_changes(here):
    """Anna changes her mind twice before she walks off, and one new plan is allowed."""
    text = LOUNGE.replace("german_woman", "german_host")
    asks = "  - {at_s: 0.5, person: anna, says: {greeting_modality: gestural}}\n"
    asks_again = "  - {at_s: 1, person: anna, says: {greeting_modality: both, greeting_gesture: nod}}\n"
    (here / "lounge.scenario.yaml").write_text(
        text + asks + asks_again + ANNA_GOES + "limits: {replans: 1}\n"
    )
    told = of_plans(front_door.run("lounge.scenario.yaml"))
    assert [event.status for event in told] == ["replanned"] * 3
    assert "anna moved" in texts(told[-1])


def test_nobody_is_greeted_again_by_a_new_plan(run):
    """Bob walks away when Anna has been greeted, and the plan is made anew for him alone."""
    walks = "  - {at_s: 14, person: bob, moves_to_m: [8, 5], facing_deg: 90}\n"
    episode = run(walks, STOP, more=RESUMES)
    assert episode.outcome == "success"
    said = [(act.act, act.person) for act in episode.acts if not act.stopped]
    assert len(said) == len(set(said))


def test_an_emergency_stop_halts_everything_and_the_visits_go_on_when_the_robot_is_told_to_resume(run):
    episode = run(STOP, more=RESUMES)
    halts = [event for event in episode.events if event.halt == "emergency"]
    assert {round(event.t, 6) for event in halts} == {4.0}
    assert episode.outcome == "success"
    still = [
        step for t, step in zip(episode.frames.time_s[1:], speeds(episode), strict=True) if 5.5 <= t <= 6.4
    ]
    assert max(still) < 1e-6
    assert episode.metrics.duration_s == pytest.approx(run().metrics.duration_s + 3.5, abs=2.0)


def test_without_it_an_episode_ends_at_rest_as_soon_as_the_robot_stands(run):
    episode = run(STOP)
    assert episode.outcome == "stopped"
    assert {visit.outcome for visit in episode.visits} == {"unreached"}
    assert all("the emergency stop is pressed" in visit.failure for visit in episode.visits)
    ends_s = episode.events[-1].t
    assert 4.0 < ends_s < 5.0
    assert speeds(episode)[-1] == 0.0
    assert all(event.halt == "emergency" for event in episode.events if event.status == "halted")


def test_after_a_stop_the_plan_is_looked_at_again(run):
    episode = run(STOP, more=RESUMES)
    (revision,) = episode.revisions
    assert revision.because[0].text == "the stop was released, and the robot was told to resume"
    (rebound,) = [event for event in episode.events if event.status in ("rebound", "replanned")]
    assert rebound.t == pytest.approx(6.5)


def test_a_short_press_of_the_emergency_stop_does_not_release_a_long_one(run):
    presses = "  - {at_s: 3, emergency_stop_s: 5}\n", "  - {at_s: 4, emergency_stop_s: 0.5}\n"
    episode = run(*presses, more=RESUMES)
    times = zip(episode.frames.time_s[1:], speeds(episode), strict=True)
    assert max(step for t, step in times if 4.6 <= t <= 7.9) < 1e-6
    assert episode.outcome == "success"


def speeds(episode):
    from comity_sim2d import speeds_m_s

    return speeds_m_s(episode.frames).tolist()


def test_values_can_be_changed_from_python_while_an_episode_runs(here, run):
    run()
    prepared = prepare(load_scenario("lounge.scenario.yaml"))
    asked = front_door.infer("arab_man")
    wishes = prepared.rulebook.infer(dict(asked.inputs), settings={"conversational_distance": 1.2})
    live = LiveEpisode(prepared)
    live.change("bob", wishes, "bob was learnt to like more room")
    live.run()
    episode = live.so_far()
    assert episode.visits[1].docked_at.distance_m == pytest.approx(1.2, abs=0.01)
    assert "bob was learnt to like more room" in texts(of_plans(episode)[0])
    with pytest.raises(KeyError, match="eve"):
        live.change("eve", wishes, "nobody")


BLOCKED = """\
schema_version: 1
name: gap
place:
  width_m: 10
  height_m: 6
  walls_m: [[[5, 0], [5, 2.2]], [[5, 3.8], [5, 6]]]
robot: {at_m: [1, 3]}
people:
  johanna: {profile: german_woman, at_m: [8, 3], facing_deg: 180}
  marta: {profile: japanese_woman, at_m: [6, 5], facing_deg: 180}
goals: [{greet: johanna}]
changes:
  - {at_s: 0.5, person: marta, moves_to_m: [5, 3], speed_m_s: 1.5}
"""


def test_who_walks_into_the_only_gap_is_asked_to_pass_and_the_robot_goes_on(here):
    (here / "gap.scenario.yaml").write_text(BLOCKED + "  - {at_s: 12, person: marta, moves_to_m: [6, 5]}\n")
    episode = front_door.run("gap.scenario.yaml")
    asked = [act for act in episode.acts if act.act == "ask_to_pass"]
    assert {act.person for act in asked} == {"marta"}
    assert asked[0].text == "Excuse me, Marta, may I pass?"
    assert episode.outcome == "success"
    assert episode.metrics.touches == 0


def test_whom_the_first_plan_could_not_reach_is_drawn_where_a_later_one_goes_for_them(comity, here):
    said = comity("run", "comity-bench-1/blocks-the-only-gap", "--out", "gap")
    assert said.code == 1, said.err
    assert (here / "gap" / "picture.png").is_file()


def test_who_stays_in_the_only_gap_ends_the_visit_with_the_reason_when_patience_is_over(here):
    (here / "gap.scenario.yaml").write_text(BLOCKED + "limits: {patience_s: 10}\n")
    episode = front_door.run("gap.scenario.yaml")
    assert episode.outcome == "failed"
    assert (
        episode.visits[0].failure
        == "marta was asked to let the robot pass, and the way was not free within 6 s"
    )
    last = of_plans(episode)[-1]
    assert (last.status, last.because[-1].text) == ("not_replanned", "10 s of waiting for the way are over")
    assert [act.person for act in episode.acts if act.act == "ask_to_pass"] == ["marta"] * 2
    assert episode.metrics.duration_s < 100


def test_a_run_with_changes_is_written_read_asked_and_run_again(comity, here):
    """The folder reads back; text, JSON and page know what became of the plan; the scenario runs again."""
    (here / "lounge.scenario.yaml").write_text(
        LOUNGE + ANNA_GOES + "  - {at_s: 9, person: anna, says: {conversational_distance: 1.4}}\n"
    )
    said = comity("run", "lounge.scenario.yaml", "--out", "one")
    assert said.code == 0
    assert ": replanned" in said.out
    assert "bound to new numbers" in said.out
    answer = json.loads((here / "one" / "run.json").read_text())
    assert [revision["kind"] for revision in answer["revisions"]] == ["replanned", "rebound"]
    trace = here / "one" / "trace.jsonl"
    nodes, events = read_nodes(trace), read_trace(trace)
    assert [event.status for event in events if event.status == "replanned"] == ["replanned"]
    assert all(nodes[event.path].name == event.node for event in events)
    shown = comity("trace", "one", "--why", "plan_holds?").out
    assert "plan_holds? was bound to new numbers" in shown
    assert "plan_holds? was replanned" not in shown, "only the last of each node"
    listed = comity("trace", "one", "--events", "--node", "plan_holds?", "--json").json
    assert "replanned" in [event["status"] for event in listed["events"]]
    assert "replanned" in (here / "one" / "replay.html").read_text()
    assert comity("run", "one/scenario.yaml", "--out", "two", "--json").code == 0
    assert (here / "two" / "trace.jsonl").read_bytes() == trace.read_bytes()


@pytest.mark.parametrize(
    ("change", "expected"),
    [
        ("{at_s: 2, person: eve, moves_to_m: [1, 1]}", ["'eve'", "a person from `people`"]),
        ("{at_s: 2, person: anna}", ["one of moves_to_m, says, situation, emergency_stop_s", "none of them"]),
        (
            "{at_s: 2, person: anna, moves_to_m: [1, 1], says: {conversational_distance: 1}}",
            ["moves_to_m and says"],
        ),
        ("{at_s: 2, moves_to_m: [1, 1]}", ["`person`", "Add `person: ...`"]),
        ("{at_s: 2, person: anna, emergency_stop_s: 1}", ["no `person`", "it is the robot that stops"]),
        ("{at_s: 2, person: anna, moves_to_m: [99, 1]}", ["anna can walk to", "[99.0, 1.0]"]),
        ("{at_s: 2, person: anna, says: {conversational_distance: 9}}", ["conversational_distance", "9"]),
        ("{at_s: 2, person: anna, says: {conversational_distanse: 1}}", ["conversational_distanse"]),
        ("{at_s: 2, person: anna, situation: {noise: 1}}", ["'noise'", "the situation of anna"]),
        ("{at_s: -1, emergency_stop_s: 1}", ["at_s", "-1"]),
    ],
)
def test_a_change_that_cannot_be_is_refused_with_its_line(comity, here, change: str, expected: list[str]):
    (here / "lounge.scenario.yaml").write_text(LOUNGE + f"  - {change}\n")
    said = comity("run", "lounge.scenario.yaml")
    assert said.code == 2
    assert "lounge.scenario.yaml:12" in said.err.replace("\n", "")
    words = " ".join(said.err.split())
    assert all(each in words for each in expected), words
    assert not (here / "runs").exists()
