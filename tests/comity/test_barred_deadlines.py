"""With a deadline a goal is planned for as without one, also where people stand in the way."""

from __future__ import annotations

import math
from dataclasses import replace

import pytest
from hypothesis import HealthCheck, assume, example, given
from hypothesis import strategies as st
from sampling import sampled

from comity.planning.request import ask
from comity.preparation import prepare
from comity.scenario import load_scenario
from comity_domain import make_plan, visits_of
from comity_domain.problem.measuring import fully_measured
from comity_sim2d import PastPeople, RouteMap, Scene, SceneError

MAP = """\
schema_version: 1
name: rooms
rooms: {left: {box_m: [0, 0, 4, 5]}, passage: {box_m: [4, 1.6, 5, 1.5]}, right: {box_m: [9, 0, 4, 5]}}
doors: {one: {at_m: [4, 2.35], width_m: 1.0}, two: {at_m: [9, 2.35], width_m: 1.0}}
locations: {start: {at_m: [1, 2.5], facing_deg: 0}, shelf: {at_m: [1, 1], facing_deg: 0}}
"""
SCENARIO = """\
schema_version: 1
name: barred
place: {{map: rooms.map.yaml}}
robot: {{at: start}}
people:
  anna: {{profile: german_woman, at_m: [11.5, 2.35], facing_deg: 180}}
  ben: {{profile: arab_man, at_m: [1.5, 4.2], facing_deg: -90}}
  kim: {{at_m: [3, 1], facing_deg: 90}}
goals: [{goals}]
"""
ONE = "{greet: anna, by_s: 300}"
TWO = "{greet: anna, by_s: 300}, {greet: ben, by_s: 300}"
FETCHED = "{greet: anna, by_s: 300}, {offer: tea, to: anna, from: shelf}"
KIM_COMES = "changes: [{at_s: 4, person: kim, moves_to_m: [4, 2.35]}]\n"

Place = tuple[float, float, float]


@pytest.fixture
def scenario(here):
    """A scenario's file: from the left room a passage leads to anna on the right."""

    def write(goals: str, more: str = "") -> str:
        (here / "rooms.map.yaml").write_text(MAP)
        path = here / "barred.scenario.yaml"
        path.write_text(SCENARIO.format(goals=goals) + more)
        return str(path)

    return write


def standing(scene: Scene, robot: Place, *people: Place) -> Scene:
    """The scene with everybody elsewhere."""
    x_m, y_m, heading_rad = robot
    moved = tuple(
        replace(person, x_m=x, y_m=y, heading_rad=heading)
        for person, (x, y, heading) in zip(scene.people, people, strict=True)
    )
    body = replace(scene.robot, x_m=x_m, y_m=y_m, heading_rad=heading_rad)
    return replace(scene, robot=body, people=moved)


HEADINGS = st.sampled_from([0.0, math.pi / 2, math.pi, -math.pi / 2])
PASSAGE = st.tuples(st.floats(3.5, 9.5), st.floats(1.9, 2.8), HEADINGS)
ANYWHERE = PASSAGE | st.tuples(st.floats(0.5, 3.5) | st.floats(9.5, 12.5), st.floats(0.5, 4.5), HEADINGS)

KIM_IN_THE_DOOR = (1.0, 2.5, 0.0), (11.5, 2.35, math.pi), (1.5, 4.2, 0.0), (4.0, 2.35, 0.0)
BESIDE_ANNA = (6.073, 2.708, 0.0), (5.985, 2.250, -1.353), (10.9, 2.8, 0.0), (7.79, 2.03, 0.0)


@pytest.mark.parametrize("goals", [ONE, TWO, FETCHED], ids=["one", "two", "fetched"])
@sampled(8, suppress_health_check=[HealthCheck.function_scoped_fixture, HealthCheck.filter_too_much])
@given(places=st.tuples(ANYWHERE, ANYWHERE, ANYWHERE, PASSAGE), past=st.booleans())
@example(places=KIM_IN_THE_DOOR, past=True)
@example(places=BESIDE_ANNA, past=False)
def test_wherever_there_is_a_way_there_is_what_it_takes(scenario, goals, places, past):
    """Also from a side of somebody that is cut off from where the reckoning sends the robot."""
    prepared = prepare(load_scenario(scenario(goals)))
    try:
        scene = standing(prepared.scene, *places)
    except SceneError:
        assume(False)
        raise
    route_map = PastPeople(scene) if past else RouteMap(scene)
    timed = ask(scene, route_map, prepared.visitees)
    timeless = ask(scene, route_map, tuple(replace(each, by_s=None) for each in prepared.visitees))
    assert fully_measured(timed.request).travel == fully_measured(timeless.request).travel
    assert timed.unreachable == timeless.unreachable


def test_who_bars_the_way_is_told_and_asked_to_make_way_as_without_a_deadline(comity, scenario):
    timed, timeless = (
        comity("run", scenario(goal, KIM_COMES), "--json").json["revisions"]
        for goal in ("{greet: anna, by_s: 200}", "{greet: anna}")
    )
    told = [(revision["t"], revision["because"]) for revision in timed]
    assert told == [(revision["t"], revision["because"]) for revision in timeless]
    texts = [text for _, because in told for text in because]
    assert any(text.startswith("the choices stay: they cost") for text in texts), "reckoned past kim"
    assert any("no free and reachable place before anna" in text for text in texts)
    assert any("kim is in the way" in text.split("; ") for text in texts)


@pytest.mark.parametrize("kim", [(3.0, 1.0, 0.0), (4.0, 2.35, 0.0)], ids=["aside", "in the door"])
@pytest.mark.parametrize(("by_s", "order"), [(300, ["anna", "ben"]), (34, ["ben", "anna"])])
def test_deadlines_decide_the_order_also_past_somebody_in_the_way(scenario, kim, by_s, order):
    """Ben is farther away than anna."""
    prepared = prepare(load_scenario(scenario(f"{{greet: anna}}, {{greet: ben, by_s: {by_s}}}")))
    scene = standing(prepared.scene, (1.0, 2.5, 0.0), (10.0, 1.2, math.pi), (12.0, 4.0, math.pi), kim)
    plan = make_plan(ask(scene, PastPeople(scene), prepared.visitees).request)
    assert [visit.spot.place for visit in visits_of(plan)] == order
