"""Who is in the robot's way, in the world: around them where that is short, up to them where it is not."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from comity_sim2d import DockingPose, Person, RobotBody, Room, RouteMap, Scene, Wall, World
from comity_sim2d.robot.approach import Approach
from comity_sim2d.robot.obstructing_people import (
    HOLD_S,
    LONGEST_HOLD_S,
    MAY_FAIL,
    NEARER_M,
    PathObstruction,
)

WALL = (Wall((5.0, 0.0), (5.0, 2.2)), Wall((5.0, 3.8), (5.0, 6.0)))
"""With one gap, around y = 3."""
SECOND_GAP = (Wall((5.0, 1.2), (5.0, 2.2)), Wall((5.0, 3.8), (5.0, 6.0)))
POSE = DockingPose(0.8, 0.0)


@pytest.fixture
def world():
    """The robot and Johanna on both sides of walls, Marta between them."""

    def build(walls=(), marta=(5.0, 3.0)) -> World:
        people = (Person("johanna", 8.0, 3.0, math.pi), Person("marta", *marta, math.pi / 2))
        return World(Scene(Room.rectangle(10, 6), RobotBody(1.0, 3.0), people, walls=walls))

    return build


def motions(world: World, seconds: float = 12.0) -> list[str]:
    """The states that the motion goes through, and `blocked` where it makes no progress."""
    found: list[str] = []
    for _ in range(round(seconds * 20)):
        world.step()
        motion = world.robot.motion()
        state = "blocked" if motion.is_blocked else motion.state
        if not found or found[-1] != state:
            found.append(state)
    return found


def test_somebody_in_an_open_room_is_gone_round_at_once(world) -> None:
    here = world()
    here.robot.navigate("johanna", POSE, speed_m_s=0.7, detour_m=1.0)
    assert motions(here) == ["running", "succeeded"]


def test_somebody_in_the_only_gap_is_come_up_to_and_named(world) -> None:
    """At rest, at least as far from her as anybody likes, and without touching her."""
    here = world(WALL)
    here.robot.navigate("johanna", POSE, speed_m_s=0.7, detour_m=3.0)
    assert motions(here) == ["running", "blocked"]
    motion = here.robot.motion()
    assert motion.blocked_by == ("marta",)
    assert motion.text == "marta is in the way to johanna"
    reading = here.robot.read("marta")
    assert 0.449 <= reading.distance_m <= 0.6
    assert reading.speed_m_s < 0.02
    assert here.robot_touches == ()


def test_the_robot_goes_on_by_itself_when_she_makes_way(world) -> None:
    here = world(WALL)
    here.robot.navigate("johanna", POSE, speed_m_s=0.7, detour_m=3.0)
    assert motions(here) == ["running", "blocked"]
    here.move_person("marta", 6.0, 5.0, 0.0)
    here.step()
    assert motions(here) == ["running", "succeeded"]


@pytest.mark.parametrize(
    ("detour_m", "ends"), [(0.05, "blocked"), (3.0, "succeeded"), (math.inf, "succeeded")]
)
def test_a_way_round_is_taken_where_it_is_short_enough(world, detour_m: float, ends: str) -> None:
    here = world(SECOND_GAP)
    here.robot.navigate("johanna", POSE, speed_m_s=0.7, detour_m=detour_m)
    assert motions(here, 20.0)[-1] == ends


def test_a_wall_without_a_gap_is_nobodys_fault(world) -> None:
    here = world((Wall((5.0, 0.0), (5.0, 6.0)),), marta=(3.0, 3.0))
    here.robot.navigate("johanna", POSE, speed_m_s=0.7, detour_m=3.0)
    assert motions(here) == ["blocked"]
    assert not here.robot.motion().blocked_by


def test_a_pose_behind_somebody_in_the_only_gap_is_still_chosen(world) -> None:
    from comity_fis import load_rulebook

    values = load_rulebook("bruno2017").infer({})
    pose = world(WALL).robot.choose_pose(
        "johanna",
        distance_m=0.8,
        bearing_deg=0.0,
        distance_desirability=values["conversational_distance"].desirability,
        direction_desirability=values["approach_direction"].desirability,
    )
    assert (pose.distance_m, pose.bearing_deg, pose.pose_free) == (0.8, 0.0, True)


def test_the_emergency_stop_brakes_as_hard_as_the_base_may_whatever_it_was_told(world) -> None:
    here = world()
    here.robot.navigate("johanna", POSE, speed_m_s=0.7)
    here.run(3.0)
    before_m_s = here.robot.read("johanna").speed_m_s
    assert before_m_s > 0.3
    here.robot.emergency_stop.press("the bumper")
    here.robot.emergency_stop.press("the button")
    here.run(before_m_s / here.scene.robot.max_acceleration_m_s2 + 0.1)
    assert here.robot.read("johanna").speed_m_s < 1e-6
    here.robot.navigate("johanna", POSE, speed_m_s=0.7)
    here.run(1.0)
    assert here.robot.read("johanna").speed_m_s < 1e-6
    here.robot.emergency_stop.release("the bumper")
    assert here.robot.emergency() == "the button"
    here.robot.emergency_stop.release("the button")
    here.robot.navigate("johanna", POSE, speed_m_s=0.7)
    here.run(1.0)
    assert here.robot.read("johanna").speed_m_s > 0.2


SPEED_M_S, START, GOAL = 0.7, (3.0, 3.0), (6.75, 3.0)


def at_the_wall(**people: tuple[float, float]) -> RouteMap:
    """The robot on one side of two gaps, Johanna on the other; and others wherever they are now."""
    cast = {"johanna": (8.0, 3.0), **people}
    standing = tuple(Person(name, *xy, math.pi) for name, xy in cast.items())
    return RouteMap(Scene(Room.rectangle(10, 6), RobotBody(*START), standing, walls=SECOND_GAP))


IN, OUT, FAR_IN = (5.0, 3.0), (3.0, 5.0), (5.0, 0.6)
SHUT = at_the_wall(marta=IN, eve=FAR_IN)
LONG = at_the_wall(marta=IN)
OPEN = at_the_wall(marta=OUT, eve=FAR_IN)


def waits(maps: list[RouteMap], starts: list[tuple[float, float]] | None = None) -> list[bool]:
    """Whether it waits in each tick of 0.1 s, with the map and from the place of that tick."""
    obstruction, approach = PathObstruction(math.inf), Approach("johanna", POSE, SPEED_M_S)
    found = []
    for tick, ways in enumerate(maps):
        start = starts[tick] if starts else START
        obstruction.look(ways, start, GOAL, approach, tick * 0.1)
        found.append(obstruction.now is not None)
    return found


def lengths_s(waiting: list[bool]) -> list[float]:
    """How long each wait lasted that came to its end."""
    ends = [i for i in range(1, len(waiting)) if waiting[i - 1] and not waiting[i]]
    begins = [i for i in range(len(waiting)) if waiting[i] and (i == 0 or not waiting[i - 1])]
    return [(end - begin) * 0.1 for begin, end in zip(begins, ends, strict=False)]


@given(st.lists(st.tuples(st.integers(5, 30), st.sampled_from([SHUT, OPEN])), min_size=10, max_size=30))
def test_a_way_that_opens_and_shuts_is_mistrusted_for_longer_each_time(spells) -> None:
    """Where the robot gets no nearer, after three times it waits 1 s at least, then 2 s, then 4 s."""
    found = lengths_s(waits([ways for ticks, ways in spells for _ in range(ticks)]))
    for k, length_s in enumerate(found[1 + MAY_FAIL :]):
        assert length_s >= min(HOLD_S * 2.0**k, LONGEST_HOLD_S) - 1e-9


@given(st.lists(st.integers(1, 10), min_size=2, max_size=10))
def test_whoever_gets_nearer_each_time_goes_on_at_once(ticks) -> None:
    maps, starts = [], []
    for k, count in enumerate(ticks):
        for ways in (SHUT, OPEN):
            maps += [ways] * count
            starts += [(START[0] + k * 1.1 * NEARER_M, START[1])] * count
    waiting = waits(maps, starts)
    assert sum(waiting) >= len(ticks)
    assert not any(wait and ways is OPEN for wait, ways in zip(waiting, maps, strict=True))


def test_the_shorter_way_is_taken_as_soon_as_it_opens() -> None:
    assert waits([SHUT, OPEN]) == [True, False]


def test_a_way_that_is_short_enough_by_a_hair_is_waited_beside() -> None:
    """A way round that is now 1 cm too long and now 1 cm short enough, as noise has it, turns nobody."""
    around, direct = LONG.length(START, GOAL), OPEN.length(START, GOAL)
    near = at_the_wall(marta=(IN[0] + 0.001, IN[1]))
    obstruction, approach = PathObstruction(around - direct - 0.01), Approach("johanna", POSE, SPEED_M_S)
    obstruction.look(LONG, START, GOAL, approach, 0.0)
    assert obstruction.now is not None
    obstruction.detour_m += 0.02
    obstruction.look(near, START, GOAL, approach, 10.0)
    assert obstruction.now is not None
