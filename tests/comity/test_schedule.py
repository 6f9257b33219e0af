"""Happenings come at their times, in their order, for as many ticks as they take."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise

import pytest
from hypothesis import given
from hypothesis import strategies as st

from comity.schedule import Schedule, Stage
from comity.simulation.happenings import EmergencyStopPressed, WalkStart
from comity_sim2d import Person, RobotBody, Room, Scene, Wall, World
from tests.comity.nobody import Nobody


@dataclass(frozen=True)
class Note:
    """Writes down the tick of every step that it takes."""

    at_s: float
    ticks: int
    name: int
    seen: list

    def happen(self, stage: Stage) -> Iterator[None]:
        for _ in range(self.ticks):
            self.seen.append((round(stage.world.time_s, 6), self.name))
            yield


def stage_of(*people: Person, walls: tuple[Wall, ...] = ()) -> Stage:
    world = World(Scene(Room.rectangle(8.0, 6.0), RobotBody(1.0, 1.0), people, walls=walls))
    return Stage(world, Nobody(), Nobody())


def play(stage: Stage, schedule: Schedule, seconds: float) -> None:
    for _ in range(round(seconds * 20)):
        schedule.step(stage)
        stage.world.step()


@given(entries=st.lists(st.tuples(st.integers(0, 30), st.integers(1, 5)), max_size=6))
def test_each_begins_at_its_tick_and_takes_its_ticks_in_the_order_of_the_schedule(entries) -> None:
    seen: list[tuple[float, int]] = []
    notes = [Note(tick / 20, ticks, i, seen) for i, (tick, ticks) in enumerate(entries)]
    play(stage_of(), Schedule(notes), 2.0)
    for note in notes:
        mine = [t for t, name in seen if name == note.name]
        assert mine == pytest.approx([note.at_s + k / 20 for k in range(note.ticks)])
    begun = [name for _, name in seen]
    order = sorted(range(len(notes)), key=lambda i: notes[i].at_s)
    assert list(dict.fromkeys(begun)) == order


def test_the_button_is_held_for_its_time_and_two_are_held_until_both_are_released() -> None:
    stage = stage_of()
    schedule = Schedule([EmergencyStopPressed(0.5, 1.0), EmergencyStopPressed(1.0, 1.0, "the bumper")])
    pressed = []
    for _ in range(60):
        schedule.step(stage)
        pressed.append(stage.world.robot.emergency() is not False)
        stage.world.step()
    assert [tick / 20 for tick, held in enumerate(pressed) if held] == pytest.approx(
        [tick / 20 for tick in range(10, 40)]
    )


def test_a_walk_goes_round_walls_at_its_speed_and_ends_as_it_should() -> None:
    stage = stage_of(Person("anna", 3.0, 5.0, 0.0), walls=(Wall((4.0, 6.0), (4.0, 3.0)),))
    positions = []
    schedule = Schedule([WalkStart(0.0, "anna", (5.0, 5.0), math.pi / 2, 1.0)])
    for _ in range(160):
        schedule.step(stage)
        positions.append(stage.world.people[0].xy)
        stage.world.step()
    strides = [math.dist(a, b) for a, b in pairwise(positions)]
    assert max(strides) <= 1.0 / 20 + 1e-9
    assert min(y for _, y in positions) < 3.0, "around the end of the wall"
    assert stage.world.people[0].xy == pytest.approx((5.0, 5.0))
    assert stage.world.people[0].heading_rad == math.pi / 2


def test_whoever_walks_waits_for_the_robot_and_touches_nobody() -> None:
    """The robot stands in the corridor: Anna stops before it and goes on when it is gone."""
    walls = (Wall((0.0, 1.6), (8.0, 1.6)), Wall((0.0, 0.4), (8.0, 0.4)))
    stage = stage_of(Person("anna", 4.0, 1.0, math.pi), walls=walls)
    play(stage, Schedule([WalkStart(0.0, "anna", (0.5, 1.0), None, 1.0)]), 6.0)
    assert stage.world.robot_touches == ()
    gap_m = stage.world.people[0].xy[0] - 1.0 - 0.25 - 0.20
    assert 0.10 - 1e-6 <= gap_m < 0.16
