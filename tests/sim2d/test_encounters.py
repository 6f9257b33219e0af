"""Random rooms: the robot comes at nobody, stands still for nothing, and stops where planning said it can."""

import math

import pytest
from docking_study import CASES, figures, visit, visits_of
from encounter_study import PASSERS_BY_FROM, SOFT_FROM, answers_of, episode, judged

from comity_sim2d import Person, RobotBody, Room, Scene, World
from comity_sim2d.pose import Twist

SAMPLE = (*range(5, 17), 1954)
"""Of the 10,000 of the study: rooms without the longest ways, to be quick, and one where the first look, 3 cm
off, shuts the only way on the robot's map."""

PASSING = (*range(PASSERS_BY_FROM, PASSERS_BY_FROM + 10), 100332)
"""Rooms with passers-by who react to the robot; in the last, on two wheels, it crept up to a box before it
turned on the spot there."""

SOFT = (*range(SOFT_FROM, SOFT_FROM + 5), 200013, 200044, 200058)
"""Rooms in which the base has little jerk; in the last two it came at a box inside its bend."""


@pytest.fixture(scope="module")
def answers() -> list[dict[str, object]]:
    return [answer for seed in (*SAMPLE, *PASSING, *SOFT) if "by_robot" in (answer := episode(seed))]


def test_the_robot_comes_at_nobody_and_nothing(answers) -> None:
    assert [answer["seed"] for answer in answers if answer["by_robot"]] == []


def test_the_robot_does_not_stand_still_where_a_way_is_free(answers) -> None:
    assert [answer["seed"] for answer in answers if answer["outcome"] == "froze"] == []


def test_sides_that_planning_takes_for_free_are_reached_where_nobody_walks(answers) -> None:
    still = [answer for answer in answers if not (answer["walkers"] or "passers_by" in answer)]
    assert len(still) >= 5
    assert [answer["seed"] for answer in still if not answer["on_side"]] == []


def blind_world(monkeypatch, *people: Person) -> World:
    """A robot that drives to the right whatever there is."""
    world = World(Scene(Room.rectangle(6.0, 4.0), RobotBody(1.0, 2.0), people))
    monkeypatch.setattr(world.robot, "control", lambda: Twist(0.5, 0.0, 0.0))
    return world


def test_the_judge_sees_a_robot_that_drives_into_somebody(monkeypatch) -> None:
    world = blind_world(monkeypatch, Person("ada", 2.5, 2.1, 0.0))
    world.run(4.0)
    assert judged(world.scene, world.frames) == {"by_robot": 1, "by_people": 0}


def test_the_judge_sees_a_robot_that_drives_into_a_wall(monkeypatch) -> None:
    world = blind_world(monkeypatch)
    world.run(10.0)
    assert judged(world.scene, world.frames) == {"by_robot": 1, "by_people": 0}


def test_the_judge_does_not_blame_a_robot_that_somebody_walks_into(monkeypatch) -> None:
    world = World(Scene(Room.rectangle(6.0, 4.0), RobotBody(1.0, 2.0), (Person("ada", 3.0, 2.0, math.pi),)))
    world.robot.emergency_stop.press("it does not step aside")
    for _ in range(60):
        ada = world.people[0]
        world.move_person("ada", ada.x_m - 0.04, ada.y_m, ada.heading_rad)
        world.step()
    assert judged(world.scene, world.frames)["by_robot"] == 0
    assert judged(world.scene, world.frames)["by_people"] >= 1


@pytest.mark.parametrize(
    ("case", "distance_m", "angle_deg"),
    [("static", 0.01, 1.0), ("noisy", 0.03, 3.0), ("drifting", 0.05, 5.0), ("differential", 0.01, 2.0)],
)
def test_docking_is_as_exact_as_promised(case: str, distance_m: float, angle_deg: float) -> None:
    """95th percentile of a sample; `python tests/docking_study.py` takes 1,000 starts."""
    got = figures([visit(CASES[case], seed) for seed in range(6)])
    assert got.arrived == 1.0
    assert got.distance_m[1] <= distance_m
    assert max(got.bearing_deg[1], got.facing_deg[1]) <= angle_deg


@pytest.mark.parametrize("seed", [221, 282, 309, 784])
def test_two_wheels_that_have_docked_stay_where_they_are_and_turned_to_the_person(seed: int) -> None:
    """Of the thousand starts of the study, those from which the robot rolled on, and turned round again."""
    errors = visit(CASES["differential, noisy"], seed)
    assert errors.arrived
    assert max(errors.distance_m) <= 0.03
    assert max(errors.facing_deg) <= 3.0


@pytest.mark.study
@pytest.mark.parametrize(
    ("case", "distance_m", "angle_deg"),
    [("static", 0.01, 1.0), ("noisy", 0.03, 3.0), ("drifting", 0.05, 5.0)],
)
def test_docking_is_as_exact_as_promised_over_a_thousand_starts(
    case: str, distance_m: float, angle_deg: float
) -> None:
    got = figures(visits_of(case, 1000))
    assert got.arrived >= 0.99
    assert got.distance_m[1] <= distance_m
    assert max(got.bearing_deg[1], got.facing_deg[1]) <= angle_deg
    assert case != "static" or got.distance_m[2] <= 0.01


@pytest.mark.study
def test_ten_thousand_encounters() -> None:
    answers = [answer for answer in answers_of(10_000) if "by_robot" in answer]
    assert [answer["seed"] for answer in answers if answer["by_robot"]] == []
    assert sum(answer["outcome"] == "froze" for answer in answers) <= 0.01 * len(answers)
    still = [answer for answer in answers if not (answer["walkers"] or "passers_by" in answer)]
    assert sum(bool(answer["on_side"]) for answer in still) >= 0.95 * len(still)
