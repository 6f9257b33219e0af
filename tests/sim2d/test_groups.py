"""Groups: the space between people who stand together follows from how they stand, and turns with them."""

from __future__ import annotations

import math
from dataclasses import replace

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from shapely import LineString, Point

from comity_fis import load_rulebook
from comity_fis.proxemics import PERSON_MARGIN_M
from comity_sim2d import (
    DockingPose,
    Group,
    Person,
    RobotBody,
    Room,
    RouteMap,
    Scene,
    SceneError,
    Wish,
    World,
    choose_pose,
    o_space,
    spot_pose,
)
from comity_sim2d.scene.o_space import o_space_of_those_left

VALUES = load_rulebook("bruno2017").infer({})
DESIRABILITIES = tuple(
    VALUES[name].desirability for name in ("conversational_distance", "approach_direction")
)
ANGLES = st.floats(-math.pi, math.pi)
PLACES = st.floats(-20.0, 20.0)


def circle(
    count: int, reach_m: float, turn_rad: float = 0.0, at: tuple[float, float] = (0.0, 0.0)
) -> list[Person]:
    """People on a circle who face its middle."""
    angles = [turn_rad + math.tau * k / count for k in range(count)]
    return [
        Person(f"p{k}", at[0] + reach_m * math.cos(a), at[1] + reach_m * math.sin(a), a + math.pi)
        for k, a in enumerate(angles)
    ]


@given(st.integers(2, 8), st.floats(0.6, 1.5), ANGLES, PLACES, PLACES)
def test_who_face_one_another_in_a_circle_keep_its_middle_open(count, reach, turn, x, y):
    space = o_space(circle(count, reach, turn, (x, y)))
    assert space.xy == pytest.approx((x, y), abs=1e-9)
    assert space.radius_m == pytest.approx(reach - 0.20)


@given(st.lists(st.tuples(PLACES, PLACES, ANGLES), min_size=2, max_size=6), st.randoms())
def test_no_member_stands_in_the_space_and_their_order_means_nothing(stands, rng):
    people = [Person(f"p{i}", *stand) for i, stand in enumerate(stands)]
    space = o_space(people)
    for person in people:
        gap = math.dist(space.xy, person.xy) - person.radius_m
        assert space.radius_m <= max(gap, 0.0) + 1e-9
    rng.shuffle(people)
    again = o_space(people)
    assert (*again.xy, again.radius_m) == pytest.approx((*space.xy, space.radius_m))


def test_side_by_side_the_space_is_before_them():
    space = o_space([Person("a", 0.0, 0.0, math.pi / 2), Person("b", 0.8, 0.0, math.pi / 2)])
    assert space.x_m == pytest.approx(0.4)
    assert space.y_m == pytest.approx(0.4)
    assert space.radius_m == pytest.approx(math.hypot(0.4, 0.4) - 0.20)


@pytest.mark.parametrize("turn_deg", [0.0, 15.0, 60.0, 90.0, -75.0])
def test_two_stand_closed_who_look_at_one_another_and_open_who_look_another_way(turn_deg):
    """Both turn to the same side; from 60 degrees on somebody else can stand before them."""
    turn = math.radians(turn_deg)
    pair = [Person("a", 0.0, 0.0, turn), Person("b", 1.4, 0.0, math.pi - turn)]
    assert o_space(pair).is_closed == (abs(turn_deg) < 30.0)


@given(st.integers(2, 4), st.floats(0.9, 1.3), ANGLES, st.floats(0.45, 1.09), st.integers(0, 3))
def test_a_member_of_a_circle_is_greeted_from_its_rim(count, reach, turn, distance, whom):
    """Judged by plain geometry: the robot's disc is outside of the circle that the group keeps open."""
    people = tuple(circle(count, reach, turn, (5.0, 5.0)))
    group = Group("talk", tuple(person.name for person in people))
    scene = Scene(Room.rectangle(10, 10), RobotBody(1, 1), people, groups=(group,))
    wish = Wish(f"p{whom % count}", distance, 0.0, *DESIRABILITIES)
    pose = choose_pose(RouteMap(scene), (1.0, 1.0), wish)
    assert pose is not None
    spot = spot_pose(scene, wish.person, pose.distance_m, pose.bearing_deg)
    assert math.dist(spot.xy, (5.0, 5.0)) >= reach - 0.20 + 0.25 - 1e-6
    assert not pose.pose_free
    assert "is blocked by" in pose.deviation_reason


@given(ANGLES, st.floats(0.0, 1.9), ANGLES, st.floats(2.6, 4.0), ANGLES)
def test_who_has_to_go_into_the_middle_of_a_group_goes_no_deeper_than_there(turn, deep_m, there, off_m, here):
    """Four people in a circle of 4 m leave room between two of them; it leads the same way out again.

    From inside the margin of one of them it would first go straight out, into the middle.
    """
    people = tuple(circle(4, 2.0, turn, (5.0, 5.0)))
    group = Group("talk", tuple(person.name for person in people))
    scene = Scene(Room.rectangle(10, 10), RobotBody(1, 1), people, groups=(group,))
    inside, outside = (
        (5.0 + reach * math.cos(angle), 5.0 + reach * math.sin(angle))
        for reach, angle in ((deep_m, there), (off_m, here))
    )
    assume(all(person.gap_m(inside, scene.robot.radius_m) >= PERSON_MARGIN_M for person in people))
    routes = RouteMap(scene)
    for route in (routes.route(outside, inside), routes.route(inside, outside)):
        if route is not None:
            line = LineString([route.at(route.length_m * k / 200) for k in range(201)])
            assert Point(5.0, 5.0).distance(line) >= deep_m - 0.03


def test_a_scene_knows_its_groups():
    people = tuple(circle(3, 0.8, at=(4.0, 3.0)))
    scene = Scene(Room.rectangle(8, 6), RobotBody(1, 1), people, groups=(Group("trio", ("p0", "p1", "p2")),))
    assert scene.o_spaces[0].xy == pytest.approx((4.0, 3.0))


@pytest.mark.parametrize(
    ("groups", "message"),
    [
        ((("one", ("p0",)),), "at least two"),
        ((("two", ("p0", "q")),), "people of the scene"),
        ((("two", ("p0", "p1")), ("more", ("p1", "p2"))), "nobody in two groups"),
    ],
)
def test_groups_that_cannot_be_are_refused(groups, message):
    people = tuple(circle(3, 0.8, at=(4.0, 3.0)))
    with pytest.raises(SceneError, match=message):
        Scene(Room.rectangle(8, 6), RobotBody(1, 1), people, groups=tuple(Group(*group) for group in groups))


@given(gone=st.sets(st.sampled_from(["p0", "p1", "p2", "q", "nobody"])))
def test_without_some_people_their_groups_shrink_and_a_group_of_one_ends(gone: set[str]) -> None:
    room = Room(((-5.0, -5.0), (5.0, -5.0), (5.0, 5.0), (-5.0, 5.0)))
    names = ("p0", "p1", "p2", "q")
    people = tuple(Person(name, 1.0 * i, 0.0, 0.0) for i, name in enumerate(names))
    scene = Scene(room, RobotBody(0.0, -3.0), people, groups=(Group("talk", names[:3]),))
    left = scene.without(gone)
    members = tuple(name for name in names[:3] if name not in gone)
    assert [person.name for person in left.people] == [name for name in names if name not in gone]
    assert [group.members for group in left.groups] == ([members] if len(members) > 1 else [])


@given(st.sets(st.integers(0, 3)), st.floats(0.51, 3.0), st.floats(-math.pi, math.pi))
def test_the_space_of_a_group_is_that_of_those_who_have_not_left_it(gone, away_m, angle):
    """Who takes a small step belongs to it still; where one is left or nobody, there is none."""
    turns = [math.pi / 2 * k for k in range(4)]
    members = tuple(Person(f"p{k}", math.cos(a), math.sin(a), a + math.pi) for k, a in enumerate(turns))

    def moved(person: Person, by_m: float) -> Person:
        return replace(
            person, x_m=person.x_m + by_m * math.cos(angle), y_m=person.y_m + by_m * math.sin(angle)
        )

    now = [moved(person, away_m if k in gone else 0.3) for k, person in enumerate(members)]
    stay = [person for k, person in enumerate(members) if k not in gone]
    assert o_space_of_those_left(members, now) == (o_space(stay) if len(stay) > 1 else None)
    assert o_space_of_those_left(members, members) == o_space(members)
    names = tuple(person.name for person in stay)
    left = Group("all", tuple(person.name for person in members)).of_those_left(members, now)
    assert left == (Group("all", names) if len(stay) > 1 else None)


def test_the_robot_goes_through_where_a_group_stood_once_it_has_parted():
    """Two face each other across the straight way; one walks off, and the way is straight."""
    people = (
        Person("a", 4.0, 2.0, math.pi / 2, personal_distance_m=0.35),
        Person("b", 4.0, 4.0, -math.pi / 2, personal_distance_m=0.35),
        Person("goal", 7.5, 3.0, math.pi),
    )
    scene = Scene(Room.rectangle(8.0, 6.0), RobotBody(0.6, 3.0), people, groups=(Group("talk", ("a", "b")),))

    def farthest_m(leaves: bool) -> float:
        world = World(scene)
        if leaves:
            world.move_person("b", 7.0, 0.6, 0.0)
        world.robot.dock("goal", DockingPose(0.8, 0.0), speed_m_s=0.7)
        world.run(20.0)
        return float(abs(world.frames.poses[:, 0, 1] - 3.0).max())

    assert farthest_m(leaves=False) > 1.0
    assert farthest_m(leaves=True) < 0.1
