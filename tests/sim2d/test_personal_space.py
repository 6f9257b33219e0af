"""Passing people: each at their own distance, what it costs to come nearer, and around groups."""

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from shapely import LineString, Point

from comity_sim2d import Group, Person, RobotBody, Room, RouteMap, Scene, Wall
from comity_sim2d.paths.cost_grid import way_cost
from comity_sim2d.paths.personal_space import FRONT, PersonalSpace, bounding_box
from comity_sim2d.scene.o_space import OSpace, o_space

OWN = st.floats(0.45, 1.2)
ANGLES = st.floats(-math.pi, math.pi)


def space(own: float, heading: float = 0.0) -> PersonalSpace:
    return PersonalSpace(1.0, 2.0, heading, contact_m=0.45, own_m=own, floor_m=0.75)


def at(centre: PersonalSpace, reach: float, angle: float) -> np.ndarray:
    """The point at a distance in a direction off the heading."""
    turned = centre.heading_rad + angle
    return np.array([[centre.x_m + reach * math.cos(turned), centre.y_m + reach * math.sin(turned)]])


@given(OWN, ANGLES, st.sampled_from([math.pi / 2, -math.pi / 2, math.pi]))
def test_the_level_set_passes_through_the_persons_own_distance_at_the_sides_and_behind(
    own: float, heading: float, angle: float
) -> None:
    one = space(own, heading)
    assert one.depth_m(at(one, 0.45 + own, angle))[0] == pytest.approx(0.0, abs=1e-9)
    assert one.discomfort(at(one, 0.45 + own - 0.01, angle))[0] > 0.0
    assert one.discomfort(at(one, 0.45 + own + 1e-6, angle))[0] == 0.0


@given(OWN, ANGLES)
def test_to_the_front_it_reaches_half_as_far_again(own: float, heading: float) -> None:
    one = space(own, heading)
    assert one.depth_m(at(one, 0.45 + FRONT * own, 0.0))[0] == pytest.approx(0.0, abs=1e-9)


@given(OWN, ANGLES, st.floats(0.0, 1.1))
@settings(deadline=None)
def test_a_straight_way_past_a_person_costs_their_distance_times_the_square_of_the_share_lost(
    own: float, heading: float, share: float
) -> None:
    """Behind them, where the space is a circle: the cost there is made from this law."""
    one = space(own, heading)
    along = np.linspace(-2.5, 2.5, 5001)
    reach, angle = np.hypot(along, 0.45 + share * own), math.pi + np.arctan2(along, 0.45 + share * own)
    way = np.concatenate([at(one, *polar) for polar in zip(reach.tolist(), angle.tolist(), strict=True)])
    cost = one.discomfort(way).sum() * 0.001
    assert cost == pytest.approx(own * max(0.0, 1.0 - share) ** 2, abs=1e-3 * own)


@given(OWN, ANGLES, ANGLES, st.floats(0.0, 1.5), st.floats(0.0, 1.5))
def test_discomfort_falls_with_the_distance(
    own: float, heading: float, angle: float, near: float, far: float
) -> None:
    one = space(own, heading)
    near, far = (one.discomfort(at(one, 0.45 + gap, angle))[0] for gap in sorted((near, far)))
    assert near >= far - 1e-12  # but for rounding


@given(OWN, ANGLES, ANGLES, st.floats(0.5, 3.0))
def test_a_place_that_has_to_be_is_left_out_and_nothing_grows(
    own: float, heading: float, angle: float, reach: float
) -> None:
    one = space(own, heading)
    (xy,) = at(one, reach, angle).tolist()
    less = one.leaving_out((xy[0], xy[1]), 0.005, least_m=0.45)
    assert less.depth_m(np.array([xy]))[0] <= -0.005 + 1e-9
    around = at(one, 1.0, 0.0) + np.random.default_rng(0).normal(0.0, 1.0, (50, 2))
    assert (less.depth_m(around) <= one.depth_m(around) + 1e-12).all()


def between(near: float, far: float, width: float = 3.4) -> Scene:
    """A passage with somebody at either wall, looking across; the robot has to go between the two."""
    people = (
        Person("near", 4.0, 0.2, math.pi / 2, personal_distance_m=near),
        Person("far", 4.0, width - 0.2, -math.pi / 2, personal_distance_m=far),
    )
    return Scene(Room.rectangle(8.0, width), RobotBody(0.6, width / 2), people)


def passing_gaps(scene: Scene, goal: tuple[float, float]) -> dict[str, float]:
    route = RouteMap(scene).route(scene.robot.pose.xy, goal)
    assert route is not None
    line = LineString(route.points)
    return {person.name: Point(person.xy).distance(line) - 0.45 for person in scene.people}


POINTS = st.lists(st.tuples(st.floats(-6, 8), st.floats(-6, 8)), min_size=1, max_size=4)


@given(OWN, ANGLES, POINTS)
def test_what_is_beyond_a_space_is_nowhere_inside_it(own: float, heading: float, points: list) -> None:
    """So a way far from somebody need not be held against them point by point."""
    places = np.array(points)
    for kept in (space(own, heading), OSpace(1.0, 2.0, own)):
        if kept.is_beyond(bounding_box(places)):
            assert kept.depth_m(places).max() < 0.0


def test_two_people_of_different_profiles_are_passed_differently() -> None:
    """Where there is no room for both, whoever minds less is passed nearer, and by much."""
    gaps = passing_gaps(between(0.5, 1.2), (7.4, 1.7))
    assert gaps["far"] - gaps["near"] > 0.3
    swapped = passing_gaps(between(1.2, 0.5), (7.4, 1.7))
    assert swapped["near"] == pytest.approx(gaps["far"], abs=0.1)
    alike = passing_gaps(between(0.8, 0.8), (7.4, 1.7))
    assert alike["near"] == pytest.approx(alike["far"], abs=0.1)


POLISHED_M = 0.03
"""What is left of the grid in a way: corners move by centimetres, and arcs cut them."""
LOOKS = st.sampled_from([0.0, math.pi / 2, -math.pi / 2])
"""Along the passage, into it, to the wall."""


def opposite(own: tuple[float, float], room: float, look: float, *, mirrored: bool = False) -> list[float]:
    """The gaps at which two are passed who stand opposite each other, `room` between them for the gaps."""
    width = 1.7 + room
    people = (
        Person("a", 4.0, 0.4, look, personal_distance_m=own[0]),
        Person("b", 4.0, width - 0.4, -look, personal_distance_m=own[1]),
    )
    if mirrored:
        people = tuple(replace(p, y_m=width - p.y_m, heading_rad=-p.heading_rad) for p in people)
    scene = Scene(Room.rectangle(8.0, width), RobotBody(0.6, width / 2), people)
    gaps = passing_gaps(scene, (7.4, width / 2))
    return [gaps["a"], gaps["b"]]


def room_for(share: float, own: tuple[float, float], look: float) -> float:
    """What is to be divided between two: a share of what they want together, both floors at least."""
    return max(0.7, share * sum(own) * (FRONT if look > 0.0 else 1.0))


@given(OWN, OWN, st.floats(0.3, 1.0), LOOKS)
@settings(max_examples=20, deadline=None)
def test_between_two_whoever_wants_more_room_keeps_no_less_and_both_lose_about_the_same_share(
    one: float, other: float, share: float, look: float
) -> None:
    own = (min(one, other), max(one, other))
    gaps = opposite(own, room_for(share, own, look), look)
    assert gaps[1] >= gaps[0] - 0.02
    if min(gaps) > 0.34:  # nobody at the floor
        lost = [
            1.0 - gap / (each * (FRONT if look > 0.0 else 1.0)) for gap, each in zip(gaps, own, strict=True)
        ]
        assert abs(lost[1] - lost[0]) < 0.2


@given(OWN, OWN, st.floats(0.3, 1.0), LOOKS)
@settings(max_examples=10, deadline=None)
def test_a_mirrored_passage_is_passed_in_a_mirrored_way(
    one: float, other: float, share: float, look: float
) -> None:
    room = room_for(share, (one, other), look)
    gaps = opposite((one, other), room, look)
    assert opposite((one, other), room, look, mirrored=True) == pytest.approx(gaps, abs=POLISHED_M)


@given(OWN, OWN, OWN, st.floats(0.3, 1.0), LOOKS)
@settings(max_examples=10, deadline=None)
def test_more_room_wanted_never_brings_the_robot_nearer(
    one: float, other: float, more: float, share: float, look: float
) -> None:
    less, more = sorted((one, more))
    room = room_for(share, (less, other), look)
    assert opposite((more, other), room, look)[0] >= opposite((less, other), room, look)[0] - POLISHED_M


def test_in_a_narrow_passage_whoever_wants_the_most_is_not_passed_the_nearest() -> None:
    """A bell-shaped cost is flat deep inside a large space: with one, 1.2 m got 0.35 m and 0.8 m got 0.75."""
    gaps = opposite((1.2, 0.8), 1.1, math.pi / 2)
    assert gaps[0] > gaps[1] + 0.1


@given(OWN, OWN, st.floats(2.9, 3.6))
@settings(max_examples=15, deadline=None)
def test_the_route_is_cheaper_than_any_straight_passage_between_them(
    near: float, far: float, width: float
) -> None:
    """The search against all passages on a line along the corridor, by the same cost; 5 % for its cells."""
    scene = between(near, far, width)
    start, goal = scene.robot.pose.xy, (7.4, width / 2)
    routes = RouteMap(scene)
    route = routes.route(start, goal)
    assert route is not None
    spaces = routes.spaces(start, goal)
    passages = [
        way_cost([start, (2.4, y), (5.6, y), goal], spaces) for y in np.arange(0.96, width - 0.95, 0.05)
    ]
    assert way_cost(route.points, spaces) <= 1.05 * min(passages)


def test_a_short_detour_is_made_and_an_endless_one_is_not() -> None:
    """A wall between two corridors: the other one is free of people, but its door is far away."""

    def gap(door_m: float) -> float:
        wall = Wall((1.2, 2.0), (door_m, 2.0))
        bystander = Person("bo", 2.5, 0.4, math.pi / 2, personal_distance_m=1.2)
        scene = Scene(Room.rectangle(60.0, 4.0), RobotBody(0.6, 1.0), (bystander,), walls=(wall,))
        return passing_gaps(scene, (4.6, 1.0))["bo"]

    assert gap(3.8) >= 0.9
    assert 0.3 <= gap(58.0) < 0.85


def test_nobody_walks_through_the_space_of_a_group() -> None:
    """Four people in a circle of 4 m: between two of them there is room, and the way leads around."""
    angles = [0.25 * math.pi + 0.5 * math.pi * k for k in range(4)]
    people = tuple(
        Person(
            f"p{k}", 4.0 + 2.0 * math.cos(a), 4.0 + 2.0 * math.sin(a), a - math.pi, personal_distance_m=0.45
        )
        for k, a in enumerate(angles)
    )
    scene = Scene(Room.rectangle(8.0, 8.0), RobotBody(0.6, 4.0), people)
    group = o_space(people)
    assert group.xy == pytest.approx((4.0, 4.0))
    assert group.radius_m == pytest.approx(1.8)
    alone = RouteMap(scene).route((0.6, 4.0), (7.4, 4.0))
    assert alone is not None
    assert Point(4.0, 4.0).distance(LineString(alone.points)) < 1.0
    grouped = replace(scene, groups=(Group("talk", tuple(person.name for person in people)),))
    together = RouteMap(grouped).route((0.6, 4.0), (7.4, 4.0))
    assert together is not None
    assert Point(4.0, 4.0).distance(LineString(together.points)) - 0.25 >= 1.8 - 0.002


def test_two_people_face_to_face_share_what_is_between_them() -> None:
    one, other = Person("a", 0.0, 0.0, 0.0), Person("b", 1.2, 0.0, math.pi)
    assert o_space([one, other]) == OSpace(
        pytest.approx(0.6), pytest.approx(0.0, abs=1e-12), pytest.approx(0.4), ("a", "b"), is_closed=True
    )
    with pytest.raises(ValueError, match="two people"):
        o_space([one])


def test_a_user_who_is_docked_to_is_no_bystander() -> None:
    """The way to the place before somebody leads to it, however much space they like."""
    user = Person("user", 4.0, 2.0, math.pi, personal_distance_m=1.2)
    scene = Scene(Room.rectangle(8.0, 4.0), RobotBody(0.6, 2.0), (user,))
    route = RouteMap(scene).route((0.6, 2.0), (2.95, 2.0), keep={"user": 0.6})
    assert route is not None
    assert route.length_m == pytest.approx(2.35)
