"""The pose beside a person: the wanted one where it is to be had, else the most desirable that is."""

import math
from dataclasses import replace

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from comity_fis import Interval
from comity_fis.defuzzification.moved_curve import MovedCurve
from comity_sim2d import (
    Furniture,
    Person,
    RobotBody,
    Room,
    RouteMap,
    Scene,
    Wall,
    Wish,
    choose_pose,
    free_bearing,
    pose_blocker,
    spot_pose,
)
from comity_sim2d.scene.o_space import OSpace
from comity_sim2d.scene.obstacles import floor_plan_of
from comity_sim2d.scene.surroundings import Surroundings
from tests.sim2d.tent import Tent

START = (0.6, 3.0)


def scene(*furniture: Furniture, walls: tuple[Wall, ...] = (), others: tuple[Person, ...] = ()) -> Scene:
    """Ada faces the robot's side of the room."""
    return Scene(
        Room.rectangle(8.0, 6.0),
        RobotBody(*START),
        (Person("ada", 4.0, 3.0, math.pi), *others),
        walls,
        furniture,
    )


def wish(bearing: float = 0.0, distance: float = 0.64, **more) -> Wish:
    curves = {
        "distance_desirability": Tent(0.45, 1.2, distance),
        "direction_desirability": Tent(0.0, 90.0, abs(bearing)),
        **more,
    }
    return Wish("ada", distance, bearing, **curves)


TABLE = Furniture.box("table", 2.9, 3.0, width_m=0.6, depth_m=0.3)


@given(limit=st.floats(1.0, 90.0), bearing=st.floats(0.0, 1.0))
def test_no_other_pose_than_within_the_limits_of_a_wish_is_tried(limit, bearing):
    curve = MovedCurve(Tent(0.0, 90.0, 45.0), 0.0, Interval(0.0, limit))
    tried = wish(bearing * limit, direction_desirability=curve).candidates()
    assert tried
    assert all(abs(towards) <= limit for _, towards in tried)


def test_the_wanted_pose_wins_where_it_is_free_however_little_it_is_desired() -> None:
    asked = wish(30.0, direction_desirability=Tent(0.0, 90.0, 0.0))
    pose = choose_pose(RouteMap(scene()), START, asked)
    assert pose is not None
    assert (pose.distance_m, pose.bearing_deg, pose.pose_free, pose.deviation_reason) == (
        0.64,
        30.0,
        True,
        None,
    )


def test_a_blocked_pose_gives_way_to_the_next_best_and_says_why() -> None:
    pose = choose_pose(RouteMap(scene(TABLE)), START, wish())
    assert pose is not None
    assert not pose.pose_free
    assert pose.bearing_deg > 0.0  # left before right among equals
    where = f"{pose.bearing_deg:.0f} deg farther to the person's left, at the same distance"
    assert pose.deviation_reason == (
        f"front (0 deg) at 0.640 m is blocked by the table; the best free pose is {where}"
    )


@pytest.mark.parametrize(
    ("distance", "bearing", "words"),
    [
        (0.95, 0.0, "on the same side, at 0.950 m"),
        (0.64, -35.0, "35 deg farther to the person's right, at the same distance"),
        (0.95, 35.0, "35 deg farther to the person's left, at 0.950 m"),
        (0.64, 0.4, "0.4 deg farther to the person's left, at the same distance"),
    ],
)
def test_a_deviation_is_a_sentence_whatever_changes(
    monkeypatch: pytest.MonkeyPatch, distance: float, bearing: float, words: str
) -> None:
    """Only the distance, only the bearing, both, and hardly anything."""
    monkeypatch.setattr(Wish, "candidates", lambda self: [(distance, bearing)])
    monkeypatch.setattr("comity_sim2d.navigation.pose_choice._obstacle", lambda *_: "is blocked by the table")
    pose = choose_pose(RouteMap(scene()), START, wish())
    assert pose is not None
    assert pose.deviation_reason == (
        f"front (0 deg) at 0.640 m is blocked by the table; the best free pose is {words}"
    )


THINGS = st.lists(
    st.tuples(st.floats(0.6, 7.4), st.floats(0.6, 5.4), st.floats(0.1, 1.2), st.floats(0.1, 1.2)), max_size=4
)
POSES = st.lists(st.tuples(st.floats(0.3, 3.0), st.floats(-90.0, 90.0)), min_size=1, max_size=40)


@given(
    things=THINGS,
    at=st.tuples(st.floats(0.5, 7.5), st.floats(0.5, 5.5)),
    facing=st.floats(-3, 3),
    poses=POSES,
)
@settings(max_examples=60, deadline=None)
def test_many_places_are_free_where_each_of_them_is(things, at, facing, poses) -> None:
    """One question about all places beside somebody has the answers of as many questions."""
    boxes = [Furniture.box(f"box {i}", x, y, width_m=w, depth_m=d) for i, (x, y, w, d) in enumerate(things)]
    walls = tuple(Wall((x, y), (x + w, y + d), 0.1) for x, y, w, d in things[::2])
    people = (Person("ada", *at, facing), Person("bo", 2.0, 2.0, 0.0), Person("cy", 2.0, 3.2, 0.0))
    plan = floor_plan_of(Room.rectangle(8.0, 6.0), walls, tuple(boxes), ())
    place = Surroundings(plan, people, 0.27, (OSpace(2.0, 2.6, 0.3, ("bo", "cy"), is_closed=True),))
    free = place.are_free([spot_pose(place, "ada", *pose).xy for pose in poses], visited="ada")
    assert free.tolist() == [pose_blocker(place, "ada", *pose) is None for pose in poses]


@given(
    st.floats(2.6, 3.4),
    st.floats(2.0, 4.0),
    st.floats(0.2, 1.0),
    st.floats(-90.0, 90.0),
    st.floats(0.45, 1.2),
)
@settings(max_examples=25, deadline=None)
def test_the_choice_is_the_most_desirable_of_all_that_are_free(
    x: float, y: float, size: float, bearing: float, distance: float
) -> None:
    """Against a search of its own over everything that could be chosen."""
    place = scene(Furniture.box("box", x, y, width_m=min(size, 2 * (3.75 - x)), depth_m=size))
    asked = wish(bearing, distance, direction_desirability=Tent(0.0, 90.0, 20.0))
    routes = RouteMap(place)
    pose = choose_pose(routes, START, asked)
    assert pose is not None
    if pose.pose_free:
        assert (pose.distance_m, pose.bearing_deg) == (distance, bearing)
        return
    score = asked.score(pose.distance_m, pose.bearing_deg)
    for d in [distance, *(0.05 * k for k in range(9, 25))]:
        for b in range(-90, 95, 5):
            if asked.score(d, b) > score + 1e-6:
                goal = spot_pose(place, "ada", d, b).xy
                assert pose_blocker(place, "ada", d, b) is not None or not routes.reaches(START, goal)


@given(
    st.floats(2.2, 3.2),
    st.floats(2.0, 4.0),
    st.floats(0.4, 1.8),
    st.sampled_from((-25.0, 0.0, 25.0)),
)
@settings(max_examples=40, deadline=None)
def test_no_free_place_is_better_in_distance_or_side_and_no_worse_in_the_other(
    x: float, y: float, size: float, bearing: float
) -> None:
    """Who asks for 1.4 m gets no 1.9 m on a side that suits as little as one where 1.4 m is free."""
    place = scene(Furniture.box("table", x, y, width_m=min(size, 2 * (3.75 - x)), depth_m=size))
    near, front = Tent(0.8, 2.0, 1.4), Tent(-25.0, 25.0, 0.0)
    asked = wish(bearing, 1.4, distance_desirability=near, direction_desirability=front)
    routes = RouteMap(place)
    pose = choose_pose(routes, START, asked)
    assert pose is not None
    if pose.pose_free:
        return
    here = (near(pose.distance_m), front(abs(pose.bearing_deg)))
    for d, b in asked.candidates():
        there = (near(d), front(abs(b)))
        if min(y - x for x, y in zip(here, there, strict=True)) >= -1e-9 and sum(there) > sum(here) + 1e-6:
            goal = spot_pose(place, "ada", d, b).xy
            assert pose_blocker(place, "ada", d, b) is not None or not routes.reaches(START, goal)


def test_undesired_directions_are_a_last_resort_and_behind_is_none() -> None:
    only_front = Tent(-10.0, 10.0, 0.0)
    wall = Wall((3.6, 2.2), (3.6, 3.8))
    pose = choose_pose(RouteMap(scene(walls=(wall,))), START, wish(direction_desirability=only_front))
    assert pose is not None
    assert 60.0 <= abs(pose.bearing_deg) <= 90.0
    boxed_in = (Wall((3.6, 1.6), (3.6, 4.4)), Wall((3.6, 1.6), (5.0, 1.6)), Wall((3.6, 4.4), (5.0, 4.4)))
    only_far = wish(distance=1.1, distance_desirability=Tent(0.45, 1.0, 0.64))
    assert choose_pose(RouteMap(scene(walls=boxed_in)), START, only_far) is None


def test_no_pose_is_nearer_than_the_safety_floor() -> None:
    pose = choose_pose(RouteMap(scene(TABLE)), START, wish(distance_desirability=Tent(0.0, 0.7, 0.64)))
    assert pose is not None
    assert pose.distance_m >= 0.30


def test_a_distance_that_was_asked_for_outright_is_not_traded() -> None:
    """2 m is beyond what the rules know; only the side may change."""
    table = Furniture.box("table", 1.5, 3.0, width_m=0.6, depth_m=0.6)
    asked = wish(distance=2.0, distance_desirability=Tent(0.45, 1.2, 0.64))
    pose = choose_pose(RouteMap(scene(table)), START, asked)
    assert pose is not None
    assert pose.distance_m == 2.0
    assert pose.bearing_deg != 0.0


def test_a_pose_behind_a_wall_is_not_beside_the_person() -> None:
    wall = Wall((3.6, 2.0), (3.6, 4.0))
    assert pose_blocker(scene(walls=(wall,)), "ada", 1.0, 0.0) == "wall 1"


@pytest.mark.parametrize(
    ("name", "called"),
    [
        ("table", "the table"),
        ("low table", "the low table"),
        ("tv-set", "the tv-set"),
        ("t1", "t1"),
        ("table 2", "table 2"),
        ("Billy", "Billy"),
        ("the screen", "the screen"),
        ("机", "机"),
    ],
)
def test_furniture_with_a_name_of_its_own_takes_no_article(name: str, called: str) -> None:
    assert pose_blocker(scene(replace(TABLE, name=name)), "ada", 0.64, 0.0) == called


def test_a_bystander_blocks_a_pose() -> None:
    bo = Person("bo", 2.6, 3.0, 0.0)
    assert pose_blocker(scene(others=(bo,)), "ada", 0.64, 0.0) == "bo"


def test_a_pose_that_is_free_but_cannot_be_reached_is_passed_over() -> None:
    """Ada stands in a doorless closet with room in front of her."""
    closet = tuple(
        Wall(a, b) for a, b in [((2.0, 1.0), (2.0, 5.0)), ((2.0, 1.0), (8.0, 1.0)), ((2.0, 5.0), (8.0, 5.0))]
    )
    place = scene(walls=closet)
    assert pose_blocker(place, "ada", 0.64, 0.0) is None
    assert choose_pose(RouteMap(place), START, wish()) is None


def test_the_free_bearing_is_the_nominal_one_where_that_is_free() -> None:
    assert free_bearing(scene(), "ada", 0.64, 41.3, low_deg=22.5, high_deg=90.0) == 41.3
    bearing = free_bearing(scene(TABLE), "ada", 0.64, 0.0, low_deg=-22.5, high_deg=22.5)
    assert bearing is None or abs(bearing) <= 22.5
    assert free_bearing(scene(TABLE), "ada", 0.64, 0.0, low_deg=-90.0, high_deg=90.0) is not None


@pytest.mark.parametrize(
    ("distance", "bearing", "named"),
    [
        (0.2, 0.0, "distance_m"),
        (0.64, 120.0, "bearing_deg"),
        (math.nan, 0.0, "distance_m"),
        (0.64, math.nan, "bearing_deg"),
    ],
)
def test_what_nobody_may_wish_for_is_refused(distance: float, bearing: float, named: str) -> None:
    with pytest.raises(ValueError, match=f"expected {named} "):
        Wish("ada", distance, bearing, Tent(0.45, 1.2, 0.64), Tent(0.0, 90.0, 0.0))


def test_a_spot_is_where_distance_and_bearing_say() -> None:
    """Positive bearings are to the person's left: Ada faces west, so her left is south."""
    front, left = spot_pose(scene(), "ada", 0.55, 0.0), spot_pose(scene(), "ada", 0.55, 90.0)
    assert front.xy == pytest.approx((3.0, 3.0))
    assert front.heading_rad == pytest.approx(0.0, abs=1e-9)
    assert left.xy == pytest.approx((4.0, 2.0))
    assert left.heading_rad == pytest.approx(math.pi / 2)


def test_each_wish_has_candidates_of_its_own_however_alike_the_wishes_are() -> None:
    near, far = Tent(0.8, 2.0, 0.9), Tent(0.8, 2.0, 1.8)
    asked = wish(0.0, 1.4, distance_desirability=near)
    otherwise = [replace(asked, distance_desirability=far), replace(asked, distance_m=1.2)]
    best = [each.candidates()[0] for each in (asked, *otherwise, asked)]
    assert best[0] == best[3] == (0.9, 0.0)
    assert best[1] == (1.8, 0.0)
    assert (1.2, 0.0) not in otherwise[1].candidates()
