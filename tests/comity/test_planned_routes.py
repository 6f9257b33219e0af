"""The planned route is that of the plan, without what happens later; the driven path is another line."""

from __future__ import annotations

import math
from dataclasses import replace
from itertools import pairwise

import pytest

from comity.output.run_folder import open_run
from comity.replay.planned_routes import planned_routes
from comity.replay.saved_run import read_run

GUEST_WALKS_OFF = """schema_version: 1
name: two
place: {width_m: 9.0, height_m: 6.0}
robot: {at_m: [2.6, 3.2]}
people:
  guest: {at_m: [5.0, 5.0], facing_deg: -90}
  friend: {profile: arab_woman, at_m: [6.6, 1.8], facing_deg: 180}
goals: [{greet: guest}, {greet: friend}]
"""
CHANGE = "changes: [{at_s: 1.0, person: guest, moves_to_m: [8.0, 4.6], facing_deg: -90}]\n"


def routes_of(folder):
    run = read_run(open_run(folder))
    return run, planned_routes(run)


def length_m(points):
    return sum(math.dist(one, other) for one, other in pairwise(points))


def travel_m(steps):
    return sum(step.cost_parts.get("travel", 0) for step in steps) / 100


@pytest.mark.parametrize(
    "scenario",
    ["johanna", "two-visits", "guest-walks-off", "tea-visit", "door-shuts", "reception", "changes-her-mind"],
)
def test_the_planned_routes_are_as_long_as_their_plans_travel(scenario, comity, here):
    comity("run", scenario, "--out", "run")
    run, routes = routes_of(here / "run")
    plans = [run.plan, *(one for one in run.account.revisions if one.kind != "not_replanned")]
    assert len(routes) == len(plans)
    assert routes[0].points
    for route, plan in zip(routes, plans, strict=True):
        if route.points:
            legs = sum(step.action in ("Reach_user", "Return_to_user", "Fetch") for step in plan.steps)
            assert length_m(route.points) == pytest.approx(travel_m(plan.steps), abs=0.006 * legs)


def test_a_change_to_come_leaves_the_planned_route_as_it_is(comity, here):
    for name, text in (("calm", GUEST_WALKS_OFF), ("moved", GUEST_WALKS_OFF + CHANGE)):
        (here / f"{name}.scenario.yaml").write_text(text, encoding="utf-8")
        comity("run", f"{name}.scenario.yaml", "--out", name)
    (_, calm), (run, moved) = routes_of(here / "calm"), routes_of(here / "moved")
    assert len(calm) == 1
    assert moved[0] == calm[0]
    robot = run.frames.of("robot")
    assert min(math.dist(moved[0].points[1], xy) for xy in robot[:, :2].tolist()) > 0.1


def test_the_second_plan_starts_where_the_robot_is(comity, here):
    (here / "x.scenario.yaml").write_text(GUEST_WALKS_OFF + CHANGE, encoding="utf-8")
    comity("run", "x.scenario.yaml", "--out", "run")
    run, (_, second) = routes_of(here / "run")
    row = int((second.time_s - run.frames.time_s[0]) / (run.frames.time_s[1] - run.frames.time_s[0]) + 0.5)
    assert math.dist(second.points[0], run.frames.of("robot")[row, :2]) < 0.05


def test_a_plan_made_while_the_robot_touched_a_wall_has_no_route_and_the_others_have(comity, here):
    """Such a run crashed as its page was made."""
    (here / "x.scenario.yaml").write_text(GUEST_WALKS_OFF + CHANGE, encoding="utf-8")
    comity("run", "x.scenario.yaml", "--out", "run")
    run, (first, second) = routes_of(here / "run")
    poses = run.frames.poses.copy()
    poses[run.frames.time_s > second.time_s - 0.2, 0, 1] = 0.2499
    touching = replace(run, frames=replace(run.frames, poses=poses))
    assert planned_routes(touching) == (first, replace(second, points=()))
