"""No gesture is planned within whose reach a wall or a body would be."""

from __future__ import annotations

import math

import pytest
from gliding import gliding, written
from hypothesis import given, settings
from hypothesis import strategies as st
from shapely import LineString, Point, Polygon, box

from comity.live.start import as_seen
from comity.planning.request import spots_of
from comity.preparation import prepare
from comity.scenario import load_scenario
from comity_domain import REACH_M, Spot, reach_of
from comity_fis import InputError, load_rulebook

ROOM = (8.0, 6.0)
ROBOT_M, PERSON_M, THICK_M = 0.25, 0.20, 0.10
SCENARIO = """schema_version: 1
name: near
rulebook: {rulebook}
place: {{width_m: 8, height_m: 6, walls_m: [[[{wall}, {side}], [{to}, {side}]]]}}
robot: {{at_m: [1, 1], gesture_reach_m: {stated}}}
people:
  anna:
    at_m: [5.2, {y}]
    facing_deg: {facing}
    profile: {{name: anna, culture: {culture}}}
    situation: {{touch_consent: given, formality: formal}}
  ben: {{at_m: [{ben}, 3.9], facing_deg: 270, profile: unknown}}
goals: [{{greet: anna}}]
"""
STATED = ("{}", "{wave: 0.9, bow: 0.6}", "{nod: 0.2}", "{handshake: 0.3}")


def prepared_in(folder, **case):
    path = folder / "near.scenario.yaml"
    path.write_text(SCENARIO.format(to=case["wall"] + 1.2, **case), encoding="utf-8")
    return prepare(load_scenario(str(path)))


@settings(max_examples=40)
@given(
    y=st.floats(1.2, 3.0),
    facing=st.integers(-180, 180),
    wall=st.floats(2.4, 4.2),
    side=st.floats(1.8, 3.6),
    ben=st.floats(3.0, 6.5),
    culture=st.sampled_from(["DEU", "JPN", "Arab countries", "IND", "unknown"]),
    rulebook=st.sampled_from(["bruno2017", "evidence"]),
    stated=st.sampled_from(STATED),
)
def test_what_is_planned_hits_nothing(tmp_path_factory, **case):
    """Judged by the shapes alone: before and beside the robot where the plan has it greet."""
    try:
        found = prepared_in(tmp_path_factory.mktemp("e"), **case)
    except InputError:
        return  # somebody would stand in the wall
    asked = found.asked
    if not asked.request.visitees:
        return
    (visitee,) = asked.request.visitees
    spots = spots_of(found.scene, found.route_map, visitee)
    for greet in (step for step in found.plan.steps if step.action == "Greet_person"):
        reach = next(step for step in found.plan.steps if step.action == "Reach_user")
        reach_m = reach_of(greet.arguments[-1], found.file.scenario.robot.gesture_reach_m)
        at = spots[Spot("anna", reach.arguments[2])]
        towards = math.atan2(at[1] - case["y"], at[0] - 5.2)
        if reach_m == 0.0:
            continue
        hand = swept(at, towards + math.pi, reach_m - 0.01, forwards=greet.arguments[-1] != "wave")
        ends = [(case["wall"], case["side"]), (case["wall"] + 1.2, case["side"])]
        assert not hand.intersects(LineString(ends).buffer(THICK_M / 2))
        assert box(0, 0, *ROOM).covers(hand)
        assert not hand.intersects(Point(case["ben"], 3.9).buffer(PERSON_M - 0.01))
    assert not set(_gestures(found.plan)) & set(_hits(asked))


def swept(at, heading, reach_m, *, forwards):
    """Forwards as wide as the body, else all that is before and beside it."""
    tip = at[0] + reach_m * math.cos(heading), at[1] + reach_m * math.sin(heading)
    if forwards:
        return LineString([at, tip]).buffer(ROBOT_M)
    turns = (-math.pi / 2, -math.pi / 4, 0.0, math.pi / 4, math.pi / 2)
    wide_m = 3 * (ROBOT_M + reach_m)
    fan = [(at[0] + wide_m * math.cos(heading + t), at[1] + wide_m * math.sin(heading + t)) for t in turns]
    return Polygon(fan).intersection(Point(at).buffer(ROBOT_M + reach_m))


def _gestures(plan):
    return [step.arguments[-1] for step in plan.steps if step.action == "Greet_person"]


def _hits(asked):
    return {gesture for visitee in asked.request.visitees for gesture in visitee.now.hits}


USUAL = {"y": 3.0, "facing": 180, "side": 2.55, "ben": 7.5, "culture": "JPN", "rulebook": "bruno2017"}


@pytest.mark.parametrize(
    ("wall", "stated", "out"),
    [
        (0.2, "{}", set()),
        (3.6, "{}", {"wave"}),
        (3.6, "{wave: 0.1}", set()),
        (3.6, "{nod: 0.5}", {"nod", "wave"}),
    ],
)
def test_a_robot_may_state_how_far_its_gestures_reach(here, wall, stated, out):
    found = prepared_in(here, **USUAL, wall=wall, stated=stated)
    assert _hits(found.asked) == out
    reasons = found.asked.request.visitees[0].now.hits.values()
    assert all("wall 1 would be 0.15 m from the robot on the front side of anna" in each for each in reasons)


def test_the_reach_of_a_gesture_that_nobody_knows_is_refused_with_its_line(here):
    """Those of the rulebook in use are known, also where Comity has no reach of its own for them."""
    own = load_rulebook("bruno2017").parameters["greeting_gesture"].categories
    known = {*REACH_M, *(one.name for one in own)}
    prepared_in(here, **USUAL, wall=0.2, stated="{" + ", ".join(f"{one}: 0.1" for one in sorted(known)) + "}")
    with pytest.raises(InputError, match=r":\d+: expected a gesture of the rulebook bruno2017.*'moonwalk'"):
        prepared_in(here, **USUAL, wall=0.2, stated="{moonwalk: 1}")


def test_the_greeted_persons_own_body_counts_but_for_what_they_consented_to(here):
    stated = "{wave: 1.5, handshake: 1.5}"
    found = prepared_in(here, **USUAL, wall=0.2, stated=stated)
    hits = found.asked.request.visitees[0].now.hits
    assert "anna would be" in hits["wave"]
    assert "handshake" not in hits


def test_a_robot_of_ones_own_states_its_reach_too(here):
    text = SCENARIO.format(**USUAL, wall=0.2, to=1.4, stated="{}")
    file = load_scenario(written(here, text))
    robot = gliding()
    robot.people = {"anna": (5.2, 3.0, 180.0), "ben": (7.5, 3.9, 270.0)}
    robot.gesture_reach_m = {"wave": 2.0}
    assert "wave" in _hits(prepare(as_seen(file, robot)).asked)
    robot.gesture_reach_m = {"wave": -1}
    with pytest.raises(InputError, match="gesture_reach_m"):
        as_seen(file, robot)
