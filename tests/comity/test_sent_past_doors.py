"""Doors that shut before somebody who is sent somewhere: another way, or a wait, and never through a leaf."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st
from sampling import sampled
from shapely import LineString, distance, points

from comity.schedule import Schedule, Stage
from comity.simulation.breakdowns import DoorTurns, StandInTheWay, WalkOff
from comity.simulation.happenings import WalkStart as Sent
from comity.simulation.sent_way import DOOR_GAP_M
from comity_sim2d import DockingPose, Door, PassersBy, Person, RobotBody, Room, Scene, Wall, World

NEAR, FAR = Door("near", (4.0, 1.0), (4.0, 2.0)), Door("far", (4.0, 4.5), (4.0, 5.5))
LOBBY = Door("lobby", (5.0, 1.0), (5.0, 2.0))
WALLS = (
    Wall((4.0, 0.0), (4.0, 1.0), 0.1),
    Wall((4.0, 2.0), (4.0, 4.5), 0.1),
    Wall((4.0, 5.5), (4.0, 6.0), 0.1),
    Wall((5.0, 0.0), (5.0, 1.0), 0.1),
    Wall((5.0, 2.0), (5.0, 2.6), 0.1),
    Wall((4.0, 2.6), (5.0, 2.6), 0.1),
)
ANN = Person("ann", 1.0, 1.5, 0.0)
BEYOND = (7.0, 1.5)
"""Through a lobby with a door on either side, or through the far door."""


class Listener:
    """A planner and a tree to which things are told."""

    def __init__(self) -> None:
        self.notes: list[tuple[str, str, str | None]] = []

    def note(self, about, text, fault) -> None:
        self.notes.append((about, text, fault))


def scene_with(**more) -> Scene:
    robot = RobotBody(1.0, 5.0)
    return Scene(Room.rectangle(8.0, 6.0), robot, (ANN,), walls=WALLS, doors=(NEAR, FAR, LOBBY), **more)


def turned(door: str, at_s: float, for_s: float | None = None, *, opens: bool = False) -> DoorTurns:
    return DoorTurns(at_s, door, opens, for_s, f"{door} turns")


def played(
    happenings, seconds: float, scene: Scene | None = None, *, seed: int = 0, visits: str | None = None
) -> tuple[World, Listener]:
    world, listener = World(scene or scene_with(), seed), Listener()
    stage, schedule = Stage(world, listener, listener), Schedule(happenings)
    if visits is not None:
        world.robot.dock(visits, DockingPose(0.6, 0.0), speed_m_s=0.7)
    for _ in range(round(seconds / world.step_s)):
        schedule.step(stage)
        world.step()
    return world, listener


def least_gap_m(world: World, name: str = "ann") -> float:
    """Between somebody and the walls and whatever leaf was shut just then."""
    frames, radius_m = world.frames, world.people[0].radius_m
    at = points(frames.of(name)[:, :2])
    gaps_m = [distance(at, LineString([wall.start, wall.end])) - wall.thickness_m / 2 for wall in WALLS]
    for door in world.scene.doors:
        shut = np.full(len(at), not door.is_open)
        for turn in world.door_turns:
            if turn.door == door.name:
                shut[frames.time_s > turn.t + 1e-9] = not turn.is_open
        gap_m = distance(at, LineString([door.start, door.end])) - door.thickness_m / 2
        gaps_m.append(np.where(shut, gap_m, np.inf))
    return float(np.min(gaps_m)) - radius_m


def place_of(world: World) -> tuple[float, float]:
    return world.people[0].xy


def test_who_was_sent_through_a_door_that_shuts_takes_the_other_one() -> None:
    world, listener = played([Sent(0.0, "ann", BEYOND, 1.0, 1.0), turned("near", 1.0)], 15.0)
    assert world.people[0].pose == pytest.approx((*BEYOND, 1.0))
    assert least_gap_m(world) > 0.0
    assert world.frames.of("ann")[:, 1].max() > 4.5, "through the far door"
    way = "ann goes another way to (7, 1.5): the closed door 'near' is in the way"
    assert listener.notes == [("near", way, "near turns")]


def test_where_there_is_no_other_way_they_wait_before_the_door_and_go_on_when_it_opens() -> None:
    sent = [Sent(0.0, "ann", BEYOND, None, 1.0), turned("far", 0.5), turned("near", 1.0, 10.0)]
    world, listener = played(sent, 20.0)
    x = world.frames.of("ann")[:, 0]
    before_m = 4.0 - NEAR.thickness_m / 2 - ANN.radius_m - x[world.frames.time_s < 11.0].max()
    assert DOOR_GAP_M - 1e-9 <= before_m <= DOOR_GAP_M + 0.02
    assert place_of(world) == pytest.approx(BEYOND)
    assert least_gap_m(world) > 0.0
    waits = "ann waits before the closed door 'near': no other way leads to (7, 1.5)"
    assert listener.notes == [("near", waits, "near turns"), ("near", "ann goes on to (7, 1.5)", None)]


def test_who_waits_takes_another_door_that_opens() -> None:
    sent = [turned("far", 0.0, 8.0), Sent(0.5, "ann", BEYOND, None, 1.0), turned("near", 1.0)]
    world, _ = played(sent, 25.0)
    assert place_of(world) == pytest.approx(BEYOND)
    assert world.frames.of("ann")[:, 1].max() > 4.5, "through the far door"


def test_who_sets_out_where_every_door_has_shut_meanwhile_waits_too() -> None:
    sent = [turned("far", 0.0), turned("near", 0.0, 9.0), Sent(1.0, "ann", BEYOND, None, 1.0)]
    world, _ = played(sent, 20.0)
    assert place_of(world) == pytest.approx(BEYOND)


def test_who_is_shut_in_between_two_doors_stands_there_until_one_opens() -> None:
    sent = [Sent(0.0, "ann", BEYOND, None, 1.0), turned("near", 3.5), turned("lobby", 3.5, 6.0)]
    world, _ = played(sent, 15.0)
    t, x = world.frames.time_s, world.frames.of("ann")[:, 0]
    assert 4.2 < x[(t > 3.5) & (t < 9.5)].min() <= x[(t > 3.5) & (t < 9.5)].max() < 4.8
    assert place_of(world) == pytest.approx(BEYOND)


def test_who_waits_for_a_door_may_be_sent_elsewhere() -> None:
    sent = [Sent(0.0, "ann", BEYOND, None, 1.0), turned("far", 0.5), turned("near", 1.0)]
    world, _ = played([*sent, Sent(6.0, "ann", (1.0, 3.0), None, 1.0)], 12.0)
    assert place_of(world) == pytest.approx((1.0, 3.0))


def test_a_door_is_waited_for_longer_than_people_are() -> None:
    """Whoever goes to stand in the robot's way goes back home when a door lets them."""
    bob = Person("bob", 7.0, 5.4, -math.pi / 2)
    scene = replace(scene_with(), robot=RobotBody(6.5, 0.8), people=(ANN, bob))
    happenings = [
        StandInTheWay(0.0, "ann", 3.0, 2.0, "ann in the way"),
        turned("far", 5.0, 20.0),
        turned("near", 5.0, 20.0),
    ]
    world, _ = played(happenings, 40.0, scene, visits="bob")
    x = world.frames.of("ann")[:, 0]
    assert x[world.frames.time_s < 24.0].min() < x[0] + 1e-9 < 4.0 < x[round(24.0 / world.step_s)], (
        "she waits"
    )
    assert place_of(world) == pytest.approx(ANN.xy)


TIMES = st.integers(0, 240).map(lambda tick: tick / 20)
SPEEDS = st.sampled_from([0.4, 1.0, 3.0])
PLACES = st.sampled_from([BEYOND, (1.0, 4.0), (4.5, 1.5), (7.0, 5.5), (3.7, 5.0)])
TURNS = st.builds(
    turned,
    st.sampled_from(["near", "far", "lobby"]),
    TIMES,
    st.sampled_from([None, 0.5, 4.0]),
    opens=st.booleans(),
)
SENT = st.one_of(
    st.builds(Sent, TIMES, st.just("ann"), PLACES, st.sampled_from([None, 0.5]), SPEEDS),
    st.builds(WalkOff, TIMES, st.just("ann"), st.just(3.0), st.none(), SPEEDS, st.just("fault")),
)


@sampled(20)
@given(
    turns=st.lists(TURNS, min_size=1, max_size=6),
    sent=st.lists(SENT, min_size=1, max_size=3),
    passing=st.sampled_from([None, PassersBy(2)]),
    seed=st.integers(0, 100),
)
@example([turned("near", 2.6, 4.0)], [Sent(0.0, "ann", BEYOND, None, 1.0)], None, 0)
def test_nobody_who_is_sent_gets_into_a_leaf_or_a_wall(turns, sent, passing, seed) -> None:
    world, _ = played([*turns, *sent], 18.0, scene_with(passers_by=passing), seed=seed)
    assert least_gap_m(world) > -1e-9
    steps_m = np.hypot(*np.diff(world.frames.of("ann")[:, :2], axis=0).T)
    assert steps_m.max() <= 3.0 * world.step_s + 1e-9


@sampled(8)
@given(turns=st.lists(TURNS, max_size=5), speed_m_s=SPEEDS, to_m=PLACES, at_s=TIMES)
def test_whoever_is_sent_gets_there_once_all_doors_are_open(turns, speed_m_s, to_m, at_s) -> None:
    opened = [turned(door, 25.0, opens=True) for door in ("near", "far", "lobby")]
    world, _ = played([*turns, Sent(at_s, "ann", to_m, None, speed_m_s), *opened], 70.0)
    assert place_of(world) == pytest.approx(to_m)


SHUT_OUT = """\
schema_version: 1
name: shut-out
place: {map: apartment}
robot: {at: front door}
people:
  host: {at: living room}
  guest: {at_m: [5.0, 4.4], facing_deg: 180}
goals:
  - greet: host
changes:
  - {at_s: 1, person: guest, moves_to_m: [7.5, 5.0], facing_deg: 180}
faults:
  - {at_s: 1.2, fault: door closes, door: study, for_s: 3}
"""


def test_the_trace_and_the_run_tell_who_waits_before_which_door_and_that_they_go_on(here, comity) -> None:
    """As for the robot, in the chain of causes of what became of the plan."""
    (here / "shut-out.scenario.yaml").write_text(SHUT_OUT)
    run = comity("run", "shut-out.scenario.yaml", "--out", "told", "--json").json
    waits = "guest waits before the closed door 'study': no other way leads to (7.5, 5)"
    told = [reason for revision in run["revisions"] for reason in revision["because"]]
    assert (told.count(waits), told.count("guest goes on to (7.5, 5)")) == (1, 1)
    assert run["outcome"] == "success"
    assert waits in " ".join(comity("trace", "told", "--events").out.split())
