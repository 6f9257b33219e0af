"""Passing people at a reduced margin: slowly, past adults who let the robot pass, and past no others."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from comity_fis.proxemics import PERSON_MARGIN_M
from comity_sim2d import DockingPose, Person, RobotBody, Room, Scene, SceneError, Sensor, World
from comity_sim2d.people.said import GO_AHEAD, Said
from comity_sim2d.robot.acts import ASK_TO_PASS, NORMAL, ActManner, Spoken
from comity_sim2d.scene.margin_facts import MarginFacts

WIDTH_M, MARGIN_M = 1.27, 0.25
TICK_M_S = 1e-6
ADULT = MarginFacts(age_years=40.0, walks_unaided=True, hears_well=True, sees_well=True)
TO_ROBOT = math.pi
ANNA = Person("anna", 3.0, WIDTH_M / 2, TO_ROBOT, steps_aside=True, margin_facts=ADULT)
AT_THE_WALL = replace(ANNA, y_m=0.25, steps_aside=False, lets_pass=True)


@dataclass(frozen=True)
class Question:
    """What the executor's request for passage is to the robot."""

    to: str
    act: str = ASK_TO_PASS
    text: str = "Excuse me, may I pass?"
    thing: str | None = None
    manner: ActManner = NORMAL
    latin: str | None = None
    utterance: Spoken | None = None


@dataclass(frozen=True)
class Ran:
    """One way along the corridor."""

    world: World
    arrived: bool
    gap_m: Any
    """From Anna in every frame."""
    speed_m_s: Any

    @property
    def fastest_near_m_s(self) -> float:
        """Beside her, nearer than the full margin."""
        near = np.minimum(self.gap_m[1:], self.gap_m[:-1]) < PERSON_MARGIN_M - 1e-3
        return float(self.speed_m_s[near].max(initial=0.0))


def run(
    anna: Person = ANNA,
    *,
    robot: RobotBody | None = None,
    room: Room | None = None,
    asks: bool = True,
    for_s: float = 40.0,
    others: tuple[Person, ...] = (),
) -> Ran:
    """Send the robot past her along a corridor, to ask her once it has waited for 2 s."""
    bert = Person("bert", 7.0, WIDTH_M / 2, TO_ROBOT)
    body = robot or RobotBody(0.6, WIDTH_M / 2, margin_m=MARGIN_M)
    world = World(Scene(room or Room.rectangle(9.0, WIDTH_M), body, (anna, bert, *others)))
    world.robot.navigate("bert", DockingPose(0.64, 0.0), speed_m_s=0.5)
    waits_s, has_asked = 0.0, not asks
    while world.time_s < for_s and world.robot.motion().state == "running":
        world.step()
        waits_s += world.step_s if "anna" in world.robot.motion().blocked_by else 0.0
        if not has_asked and waits_s >= 2.0:
            world.robot.perform(Question("anna"))
            has_asked = True
    frames = world.frames
    here, her = frames.of("robot")[:, :2], frames.of("anna")[:, :2]
    gap_m = np.hypot(*(here - her).T) - anna.radius_m - body.radius_m
    speed_m_s = np.hypot(*np.diff(here, axis=0).T) / np.diff(frames.time_s)
    return Ran(world, world.robot.motion().state == "succeeded", gap_m, speed_m_s)


def test_an_adult_who_steps_aside_lets_the_robot_pass_slowly() -> None:
    ran = run()
    assert ran.arrived
    assert MARGIN_M <= ran.gap_m.min() < 0.29
    assert 0.1 < ran.fastest_near_m_s <= 0.2 + TICK_M_S
    (leave,) = ran.world.margin_decisions
    assert (leave.person, leave.clearance_m, leave.reasons) == ("anna", MARGIN_M, ())


def test_an_adult_who_says_yes_lets_the_robot_pass_and_stays() -> None:
    ran = run(AT_THE_WALL)
    assert ran.arrived
    assert ran.gap_m.min() >= MARGIN_M
    assert ran.fastest_near_m_s <= 0.2 + TICK_M_S
    assert ran.world.robot.heard("anna") == (Said(ran.world.robot.heard("anna")[0].t, "anna", GO_AHEAD),)
    assert ran.world.people[0].xy == AT_THE_WALL.xy


FAILS: dict[str, dict[str, Any]] = {
    "silent": {"steps_aside": False, "lets_pass": False},
    "a child": {"margin_facts": replace(ADULT, age_years=17.9)},
    "age not disclosed": {"margin_facts": replace(ADULT, age_years=None)},
    "hears less": {"margin_facts": replace(ADULT, hears_well=False)},
    "sees less": {"margin_facts": replace(ADULT, sees_well=False)},
    "mobility aid": {"margin_facts": replace(ADULT, walks_unaided=False)},
    "seated": {"posture": "seated", "steps_aside": False, "lets_pass": True},
    "from behind": {"heading_rad": 0.0, "steps_aside": False, "lets_pass": True},
}


@st.composite
def unfit(draw: st.DrawFn) -> Person:
    """A person who would let the robot pass, but for one condition, near the wall or in the middle."""
    steps = draw(st.booleans())
    person = replace(
        ANNA,
        y_m=draw(st.floats(0.25, 0.45)),
        heading_rad=TO_ROBOT + draw(st.floats(-1.0, 1.0)),
        steps_aside=steps,
        lets_pass=not steps,
    )
    return replace(person, **draw(st.sampled_from(list(FAILS.values()))))


@settings(max_examples=12, deadline=None)
@given(unfit(), st.floats(1.27, 1.45), st.sampled_from([0.24, 0.25, 0.28]))
def test_a_person_who_fails_any_condition_is_never_passed_nearer_than_the_full_margin(
    person: Person, width_m: float, margin_m: float
) -> None:
    robot = RobotBody(0.6, width_m / 2, margin_m=margin_m)
    ran = run(person, robot=robot, room=Room.rectangle(9.0, width_m), for_s=25.0)
    assert ran.gap_m.min() >= PERSON_MARGIN_M - 1e-3
    assert all(decision.reasons for decision in ran.world.margin_decisions)


def test_without_a_question_a_person_is_not_passed_nearer_however_willing() -> None:
    ran = run(AT_THE_WALL, asks=False, for_s=20.0)
    assert ran.gap_m.min() >= PERSON_MARGIN_M - 1e-3
    assert ran.world.margin_decisions == ()


def test_the_default_margin_is_kept_from_people_who_step_aside() -> None:
    ran = run(robot=RobotBody(0.6, WIDTH_M / 2), for_s=25.0)
    assert not ran.arrived
    assert ran.gap_m.min() >= PERSON_MARGIN_M - 1e-3
    assert ran.world.people[0].xy != ANNA.xy


def test_where_stepping_aside_leaves_room_the_full_margin_is_kept() -> None:
    ran = run(room=Room.rectangle(9.0, 1.6))
    assert ran.arrived
    assert ran.gap_m.min() >= PERSON_MARGIN_M - 1e-3


def test_another_route_however_long_comes_first() -> None:
    block = ((1.6, WIDTH_M), (5.0, WIDTH_M), (5.0, 3.0), (1.6, 3.0))
    room = Room(((0.0, 0.0), (9.0, 0.0), (9.0, 6.0), (0.0, 6.0)), holes=(block,))
    robot = RobotBody(0.6, WIDTH_M / 2, margin_m=MARGIN_M)
    bert = Person("bert", 7.0, WIDTH_M / 2, TO_ROBOT)
    world = World(Scene(room, robot, (AT_THE_WALL, bert)))
    world.robot.navigate("bert", DockingPose(0.64, 0.0), speed_m_s=0.5, detour_m=0.5)
    has_asked = False
    while world.time_s < 60.0 and world.robot.motion().state == "running":
        world.step()
        if not has_asked and "anna" in world.robot.motion().blocked_by:
            world.run(2.0)
            world.robot.perform(Question("anna"))
            has_asked = True
    assert has_asked
    assert [decision.reasons for decision in world.margin_decisions] == [("another route keeps the margin",)]


def test_leave_ends_when_the_person_walks_off_and_begins_with_another_question_only() -> None:
    world = World(
        Scene(
            Room.rectangle(9.0, WIDTH_M),
            RobotBody(0.6, WIDTH_M / 2, margin_m=MARGIN_M),
            (
                AT_THE_WALL,
                Person("bert", 7.0, WIDTH_M / 2, TO_ROBOT),
            ),
        )
    )
    world.robot.navigate("bert", DockingPose(0.64, 0.0), speed_m_s=0.5)
    has_asked = False
    while not world.margin_decisions:
        world.step()
        if not has_asked and "anna" in world.robot.motion().blocked_by:
            world.run(2.0)
            world.robot.perform(Question("anna"))
            has_asked = True
    assert world.margin_decisions[0].end_s is None
    world.move_person("anna", 3.4, 0.25, TO_ROBOT)
    world.run(0.1)
    assert world.margin_decisions[0].end_s == pytest.approx(world.time_s - world.step_s)
    world.run(8.0)
    gap_m = math.dist(world.robot.pose.xy, world.people[0].xy) - 0.45
    assert gap_m >= PERSON_MARGIN_M - 1e-3
    assert len(world.margin_decisions) == 1


def test_a_person_not_in_view_is_not_passed_nearer() -> None:
    """A robot that sees ahead only loses the person beside it from view: it has to keep the full margin."""
    robot = RobotBody(0.6, WIDTH_M / 2, margin_m=MARGIN_M, sensor=Sensor(field_of_view_deg=60.0))
    ran = run(AT_THE_WALL, robot=robot)
    ends = [decision.end_s for decision in ran.world.margin_decisions if not decision.reasons]
    lost_s = min((end_s for end_s in ends if end_s is not None), default=math.inf)
    before = ran.world.frames.time_s <= lost_s
    assert ran.fastest_near_m_s <= 0.2 + TICK_M_S
    assert ran.gap_m[before].min() >= MARGIN_M


def test_a_noisy_robot_keeps_the_margin_that_it_states() -> None:
    sensor = Sensor(sigma_m=0.01, delay_s=0.05)
    robot = RobotBody(0.6, WIDTH_M / 2, margin_m=0.275, sensor=sensor, max_acceleration_m_s2=0.6)
    ran = run(robot=robot, room=Room.rectangle(9.0, 1.31))
    assert ran.gap_m.min() >= 0.15
    assert ran.fastest_near_m_s <= 0.2 + TICK_M_S


@pytest.mark.parametrize(
    "person",
    [
        {"posture": "seated", "steps_aside": True},
        {"reacts": "curious", "lets_pass": True},
        {"lets_pass": "yes"},
        {"margin_m": 0.31},
        {"margin_m": -0.1},
    ],
    ids=str,
)
def test_people_who_cannot_answer_so_are_refused(person: dict[str, Any]) -> None:
    with pytest.raises(SceneError):
        replace(ANNA, **{"steps_aside": False, **person})


def test_nobody_starts_with_a_reduced_margin() -> None:
    with pytest.raises(SceneError, match=r"0\.3 m at the start"):
        Scene(Room.rectangle(9.0, WIDTH_M), RobotBody(0.6, WIDTH_M / 2), (replace(ANNA, margin_m=0.2),))
