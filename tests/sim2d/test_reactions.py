"""People with a comfort interval: they show it once to every approach, and the others stand still."""

from __future__ import annotations

import math
from dataclasses import replace

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from comity_sim2d import Comfort, Furniture, Person, RobotBody, Room, Scene, SceneError, Sensor, World, docked

AT_M = 0.8
TOO_CLOSE, TOO_FAR = (1.2, 1.5), (0.3, 0.5)
EXACT = Sensor()
TROUBLES = st.sampled_from(["step_back", "ask_farther", "turn_away", "lean_in", "ask_closer"])


def meeting(comfort: Comfort | None, *, furniture=(), posture="standing", sensor: Sensor = EXACT) -> Scene:
    """A robot that stands and looks at somebody who looks back, 0.8 m between the bodies."""
    person = Person("j", 2.0 + AT_M + 0.45, 2.0, math.pi, posture=posture, comfort=comfort)
    return Scene(Room.rectangle(6, 4), RobotBody(2.0, 2.0, sensor=sensor), (person,), furniture=furniture)


def after(scene: Scene, seconds: float = 3.0, seed: int = 0) -> World:
    world = World(scene, seed)
    world.run(seconds)
    return world


def gap(world: World) -> float:
    return docked(world.robot.pose, 0.25, world.people[0]).distance_m


@pytest.mark.parametrize(
    ("signal", "interval", "moves_m", "turns_deg"),
    [
        ("step_back", TOO_CLOSE, 0.20, 0),
        ("lean_in", TOO_FAR, -0.12, 0),
        ("turn_away", TOO_CLOSE, 0, 60),
        ("ask_farther", TOO_CLOSE, 0, 0),
        ("ask_closer", TOO_FAR, 0, 0),
    ],
)
def test_a_person_shows_what_is_wrong_and_truly_moves(signal, interval, moves_m, turns_deg):
    world = after(meeting(Comfort(*interval, shows=(signal,))))
    assert [shown.signal for shown in world.shown] == [signal]
    assert gap(world) == pytest.approx(AT_M + moves_m, abs=0.002)  # the robot makes room for who leans in
    bearing = docked(world.robot.pose, 0.25, world.people[0]).bearing_deg
    assert abs(bearing) == pytest.approx(turns_deg, abs=1e-6)


def test_who_is_at_ease_shows_nothing():
    world = after(meeting(Comfort(0.5, 1.1)))
    assert [shown.signal for shown in world.shown] == ["nothing"]
    assert gap(world) == pytest.approx(AT_M)


def test_without_a_comfort_interval_nobody_reacts():
    world = after(meeting(None))
    assert world.shown == ()
    assert world.robot.heard("j") == ()


@settings(max_examples=15)
@given(TROUBLES, st.integers(0, 10_000))
def test_what_somebody_does_not_use_is_never_seen(missing, seed):
    used = tuple(signal for signal in Comfort(0.1, 0.2).shows if signal != missing)
    for interval in (TOO_CLOSE, TOO_FAR):
        assert after(meeting(Comfort(*interval, shows=used)), 0.8, seed).shown[0].signal != missing


def test_one_approach_is_one_reaction():
    assert len(after(meeting(Comfort(*TOO_CLOSE)), 10.0).shown) == 1


def test_a_robot_that_passes_or_looks_elsewhere_is_not_reacted_to():
    scene = meeting(Comfort(*TOO_CLOSE))
    assert after(replace(scene, robot=replace(scene.robot, heading_rad=math.pi))).shown == ()


def test_nobody_steps_into_the_furniture():
    """A shelf 5 cm behind the person: they step as far as there is room."""
    shelf = Furniture.box("shelf", 2.0 + AT_M + 0.45 + 0.25 + 0.10, 2.0, width_m=0.2, depth_m=1.0)
    world = after(meeting(Comfort(*TOO_CLOSE, shows=("step_back",)), furniture=(shelf,)))
    assert AT_M < gap(world) < AT_M + 0.06


def test_who_sits_does_not_step():
    for seed in range(12):
        world = after(meeting(Comfort(*TOO_CLOSE), posture="seated"), 0.8, seed)
        assert world.shown[0].signal in {"ask_farther", "turn_away"}


def test_words_are_heard_as_late_as_people_are_seen():
    scene = meeting(Comfort(*TOO_FAR, shows=("ask_closer",)), sensor=Sensor(delay_s=0.5))
    world = World(scene)
    while not world.shown:
        world.step()
    assert world.robot.heard("j") == ()
    world.run(0.5)
    assert [words.text for words in world.robot.heard("j")] == ["A little closer, please."]
    assert world.robot.heard("j")[0].t == world.shown[0].t


@settings(max_examples=10)
@given(st.integers(0, 1000))
def test_the_same_seed_shows_the_same(seed):
    scene = meeting(Comfort(0.75, 0.95, chance=0.5), sensor=Sensor(0.02, 0.1))
    one, other = after(scene, 1.5, seed), after(scene, 1.5, seed)
    assert one.shown == other.shown
    assert one.frames.poses.tobytes() == other.frames.poses.tobytes()


@pytest.mark.parametrize("wrong", [(-0.1, 0.5), (0.5, 0.52), (0.9, 0.5)])
def test_an_interval_that_cannot_be_is_refused(wrong):
    with pytest.raises(SceneError, match=r"near_m|far_m"):
        Comfort(*wrong)
