"""People on foot pass through nobody and nothing; who stands stays; the same seed is the same crowd."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import assume, example, given, settings
from hypothesis import strategies as st
from shapely import LineString, Point

from comity_sim2d import (
    DockingPose,
    Frames,
    Furniture,
    Group,
    PassersBy,
    Person,
    RobotBody,
    Room,
    Scene,
    SceneError,
    Walk,
    Wall,
    World,
)
from comity_sim2d.scene.footpath import Footpaths
from comity_sim2d.scene.obstacles import floor_plan
from comity_sim2d.scene.placing import place

SEEDS = st.integers(0, 10_000)
FEW = settings(max_examples=8, deadline=None)
ROOM = Room.rectangle(9.0, 7.0)
ACROSS = Wall((5.0, 0.0), (5.0, 7.0))
HALL = Scene(
    ROOM,
    RobotBody(0.6, 0.6),
    (Person("seated", 4.5, 6.0, -math.pi / 2, posture="seated"), Person("standing", 7.5, 2.0, math.pi)),
    walls=(Wall((4.5, 0.0), (4.5, 2.2)),),
    furniture=(Furniture.box("column", 3.0, 4.0, width_m=0.6, depth_m=0.6),),
    passers_by=PassersBy(14),
)


def after(scene: Scene, seconds: float, seed: int = 0) -> World:
    world = World(scene, seed)
    world.run(seconds)
    return world


def gaps(frames: Frames) -> np.ndarray:
    """Between all bodies at all times, from the frames alone."""
    at = frames.poses[..., 0] + 1j * frames.poses[..., 1]
    radii = np.array(frames.radius_m)
    one, other = np.triu_indices(len(radii), 1)
    return np.abs(at[:, one] - at[:, other]) - radii[one] - radii[other]


def place_of(world: World, name: str) -> complex:
    x, y, _ = world.frames.of(name)[-1]
    return complex(x, y)


@FEW
@given(SEEDS)
def test_nobody_passes_through_anybody_or_anything(seed):
    from shapely import LineString, Polygon, box

    frames = after(HALL, 20.0, seed).frames
    assert gaps(frames).min() > -1e-9
    solids = [LineString([(4.5, 0.0), (4.5, 2.2)]).buffer(0.05), box(2.7, 3.7, 3.3, 4.3)]
    floor = Polygon(ROOM.corners)
    for path, radius in zip(np.moveaxis(frames.poses[:, 1:, :2], 1, 0), frames.radius_m[1:], strict=True):
        body = LineString(path + 1e-12 * np.arange(len(path))[:, None]).buffer(radius - 1e-3)
        assert floor.covers(body)
        assert not any(solid.intersects(body) for solid in solids)


@FEW
@given(SEEDS)
def test_who_stands_or_sits_stays_exactly_there(seed):
    frames = after(HALL, 15.0, seed).frames
    for name in ("seated", "standing"):
        assert np.ptp(frames.of(name), axis=0).tolist() == [0.0, 0.0, 0.0]


@FEW
@given(SEEDS)
def test_the_same_seed_is_the_same_crowd_to_the_bit(seed):
    one, other = (after(HALL, 5.0, seed).frames.poses.tobytes() for _ in range(2))
    assert one == other


def test_another_seed_is_another_crowd():
    assert after(HALL, 0.1, 1).frames.poses.tobytes() != after(HALL, 0.1, 2).frames.poses.tobytes()


def crossing(rng: np.random.Generator, count: int) -> tuple[Person, ...]:
    """People who walk straight across a square, all at once."""
    people = []
    for i in range(count):
        x, y, u, v = rng.uniform(0.5, 9.5, 4)
        people.append(Person(f"p{i}", x, y, rng.uniform(-3, 3), walk=Walk(((u, v),))))
    return tuple(people)


def square(people: tuple[Person, ...], **more) -> Scene:
    try:
        return Scene(Room.rectangle(10, 10), RobotBody(0.3, 0.3), people, **more)
    except SceneError:
        assume(False)
        raise


@FEW
@given(SEEDS, st.randoms())
def test_the_order_in_which_people_are_written_means_nothing(seed, dice):
    people = crossing(np.random.default_rng(seed), 8)
    shuffled = list(people)
    dice.shuffle(shuffled)
    one, other = after(square(people), 4.0), after(square(tuple(shuffled)), 4.0)
    for person in people:
        assert place_of(one, person.name) == pytest.approx(place_of(other, person.name), abs=1e-6)


@FEW
@given(SEEDS)
def test_the_mirrored_scene_has_the_mirrored_outcome(seed):
    people = crossing(np.random.default_rng(seed), 8)
    mirrored = tuple(
        replace(
            p,
            x_m=p.y_m,
            y_m=p.x_m,
            heading_rad=math.pi / 2 - p.heading_rad,
            walk=Walk((p.walk.route[0][::-1],)),
        )
        for p in people
    )
    one, other = after(square(people), 4.0), after(square(mirrored, keep_to="left"), 4.0)
    for person in people:
        there = place_of(other, person.name)
        assert place_of(one, person.name) == pytest.approx(complex(there.imag, there.real), abs=1e-6)


@pytest.mark.parametrize(("keep_to", "sign"), [("right", -1), ("left", 1)])
def test_two_who_meet_head_on_pass_on_the_side_that_people_keep_to(keep_to, sign):
    pair = (
        Person("east", 1.0, 2.0, 0.0, walk=Walk(((9.0, 2.0),))),
        Person("west", 9.0, 2.0, math.pi, walk=Walk(((1.0, 2.0),))),
    )
    frames = after(Scene(Room.rectangle(10, 4), RobotBody(5, 0.3), pair, keep_to=keep_to), 9.0).frames
    east, west = frames.of("east"), frames.of("west")
    meeting = int(np.argmin(np.abs(east[:, 0] - west[:, 0])))
    assert math.copysign(1, east[meeting, 1] - west[meeting, 1]) == sign
    assert east[-1, :2] == pytest.approx([9.0, 2.0], abs=0.5)
    assert west[-1, :2] == pytest.approx([1.0, 2.0], abs=0.5)


def test_a_walk_goes_around_things_pauses_and_goes_on():
    """From one room to the other through the gap in the wall, 3 s of standing there, and back."""
    walk = Walk(((8.0, 1.0), (1.0, 1.0)), loop=True, speed_m_s=1.2, pauses_s=(3.0, 0.0))
    scene = Scene(
        Room.rectangle(9, 7), RobotBody(0.6, 6.0), (Person("p", 1.0, 1.0, 0.0, walk=walk),), HALL.walls
    )
    frames = after(scene, 20.0).frames
    path = frames.of("p")
    speed = np.hypot(*np.diff(path[:, :2], axis=0).T) * 20
    there = np.hypot(path[1:, 0] - 8.0, path[1:, 1] - 1.0) < 0.15
    still = there & (speed == 0.0)
    assert still.sum() / 20 == pytest.approx(3.0, abs=0.2)
    assert np.hypot(path[:, 0] - 1.0, path[:, 1] - 1.0)[200:].min() < 0.5
    assert np.percentile(speed[speed > 0.5], 50) == pytest.approx(1.2, abs=0.05)
    assert speed.max() <= 1.3 * 1.2 + 1e-9


def test_people_walk_around_the_space_that_a_group_keeps_open():
    pair = (Person("a", 5.0, 1.3, math.pi / 2), Person("b", 5.0, 4.7, -math.pi / 2))
    walker = Person("w", 1.0, 3.0, 0.0, walk=Walk(((9.0, 3.0),)))
    scene = Scene(
        Room.rectangle(10, 6), RobotBody(0.5, 0.5), (*pair, walker), groups=(Group("talk", ("a", "b")),)
    )
    space = scene.o_spaces[0]
    path = after(scene, 15.0).frames.of("w")
    assert np.hypot(path[:, 0] - space.x_m, path[:, 1] - space.y_m).min() > 0.8 * space.radius_m
    assert path[-1, 0] > 8.5


CIRCLE = tuple(
    Person(f"g{k}", 4 + 0.9 * math.cos(angle), 3 + 0.9 * math.sin(angle), angle + math.pi)
    for k, angle in enumerate((0.0, math.tau / 3, 2 * math.tau / 3))
)
TALK = Scene(
    Room.rectangle(8, 6),
    RobotBody(0.5, 0.5),
    CIRCLE,
    groups=(Group("talk", tuple(one.name for one in CIRCLE)),),
    passers_by=PassersBy(6),
)
"""Three who talk in the middle of a room, which keep a disc of 0.70 m open, and people who pass."""


@given(SEEDS, st.sampled_from([(), ((4.0, 3.0), (7.0, 1.0))]))
def test_no_passer_by_starts_in_the_space_of_a_group_or_wants_to_go_there(seed, between):
    """Not even where the middle of the group is a point that they are to walk between."""
    space = TALK.o_spaces[0]
    middle = complex(*space.xy)
    for one in place(replace(TALK, passers_by=PassersBy(6, between)), seed):
        assert min(abs(at - middle) for at in (one.at, *one.stops)) >= space.radius_m + 0.2


@FEW
@given(SEEDS)
@example(3)  # where one is pushed off her way, to where it leads through the group
def test_no_passer_by_walks_through_the_space_of_a_group(seed):
    space, frames = TALK.o_spaces[0], after(TALK, 20.0, seed).frames
    assert max(space.depth_m(frames.of(f"passer-by {n}")[:, :2]).max() for n in range(1, 7)) < 0.0


@given(st.floats(0.0, 0.2), st.floats(-math.pi, math.pi))
def test_who_ends_close_to_somebody_walks_around_the_others_all_the_same(near_m, turn):
    """The last steps to a place that little off the body of somebody lead past nobody else's space."""
    group, radius_m = (4.0, 3.0, 0.7), 0.2
    friend = (7.0, 3.0, 0.2)
    paths = Footpaths(floor_plan(Scene(Room.rectangle(8, 6), RobotBody(0.5, 0.5))), radius_m, (group, friend))
    reach = friend[2] + radius_m + near_m
    goal = (friend[0] + reach * math.cos(turn), friend[1] + reach * math.sin(turn))
    way = paths.between((1.0, 3.0), goal)
    assert way is not None
    assert way[-1] == goal
    assert LineString([(1.0, 3.0), *way]).distance(Point(group[:2])) >= group[2] + radius_m


def test_a_crowd_keeps_moving():
    """Nobody stays stuck: over a minute everybody covers ground in every quarter of it."""
    path = after(HALL, 60.0).frames.poses[:, 3:, :2]
    for quarter in np.array_split(path, 4):
        assert (np.hypot(*np.ptp(quarter, axis=0).T) > 1.0).all()


def test_however_often_passers_by_turn_their_headings_are_angles():
    """In a narrow place they turn round every few seconds: after minutes it was 47 times 360 degrees."""
    narrow = Scene(Room.rectangle(3, 2), RobotBody(0.4, 0.4), passers_by=PassersBy(2))
    headings = after(narrow, 60.0).frames.poses[..., 2]
    assert np.abs(headings).max() <= math.pi
    assert np.abs(np.diff(np.unwrap(headings, axis=0), axis=0)).max() <= math.pi * 0.05 + 1e-9


def test_passers_by_go_between_the_points_that_are_given():
    scene = Scene(
        Room.rectangle(16, 3), RobotBody(8, 0.4), passers_by=PassersBy(6, between=((1.5, 1.5), (14.5, 1.5)))
    )
    x = after(scene, 60.0).frames.poses[:, 1:, 0]
    assert (x.min(axis=0) < 3.0).all()
    assert (x.max(axis=0) > 13.0).all()


@FEW
@given(SEEDS)
@example(34)  # a passer-by between the robot and the end of the wall, with no way on
@example(993)  # the same, and so close to the wall that no way began there
@example(130)  # it lets people pass for so long that it takes 64 s
def test_a_robot_on_its_way_through_a_crowd_touches_nobody_and_gets_there(seed):
    scene = replace(HALL, passers_by=PassersBy(8))
    world = World(scene, seed)
    world.robot.dock("standing", DockingPose(0.8, 0.0), speed_m_s=0.7)
    while world.robot.motion().state != "succeeded" and world.time_s < 120.0:
        world.step()
    assert world.robot.motion().state == "succeeded"
    assert world.robot_touches == ()


@pytest.mark.parametrize(
    ("people", "more", "message"),
    [
        ((Person("p", 1, 3, 0, walk=Walk(((20.0, 1.0),))),), {}, "points that can be walked to"),
        (
            (Person("p", 1, 3, 0, walk=Walk(((4.0, 3.0), (4.5, 1.0)))),),
            {"walls": HALL.walls},
            "overlaps wall 1",
        ),
        ((), {"passers_by": PassersBy(1000)}, "no room"),
        ((), {"passers_by": PassersBy(1, between=((1.0, 3.0), (99.0, 1.0)))}, "not inside the room"),
        ((), {"passers_by": PassersBy(1, between=((1.0, 3.0), (0.1, 0.1)))}, "not inside the room"),
        (
            (),
            {"passers_by": PassersBy(1, between=((1.0, 3.0), (4.3, 1.0))), "walls": HALL.walls},
            "overlaps wall 1",
        ),
        (
            (),
            {"passers_by": PassersBy(1, between=((1.0, 3.0), (7.0, 3.0))), "walls": (ACROSS,)},
            "no way from",
        ),
    ],
)
def test_walks_that_cannot_be_are_refused(people, more, message):
    scene = Scene(ROOM, RobotBody(0.6, 0.6), people, **more)
    with pytest.raises(SceneError, match=message):
        World(scene)


@FEW
@given(SEEDS)
def test_nobody_wants_to_walk_through_a_wall_without_a_gap(seed):
    scene = Scene(ROOM, RobotBody(0.6, 0.6), walls=(ACROSS,), passers_by=PassersBy(6))
    for one in place(scene, seed):
        assert len({stop.real < ACROSS.start[0] for stop in (one.at, *one.stops)}) == 1
    behind = ((6.0, 1.0), (6.0, 3.0))
    for one in place(replace(scene, passers_by=PassersBy(6, between=behind)), seed):
        assert min(stop.real for stop in (one.at, *one.stops)) > ACROSS.start[0]


def test_passers_by_find_room_in_a_narrow_lane_across_a_large_place():
    lane = ((0, 0), (90, 88), (90, 90), (88, 90))
    scene = Scene(Room(lane), RobotBody(88.5, 88.5), passers_by=PassersBy(3))
    assert all(len(one.stops) >= 1 for seed in range(20) for one in place(scene, seed))


def test_who_sits_does_not_walk():
    with pytest.raises(SceneError, match="somebody who stands"):
        Person("p", 1, 1, 0, posture="seated", walk=Walk(((2.0, 2.0),)))


@given(aside_m=st.floats(-0.3, 0.3), speed_m_s=st.floats(0.15, 0.4))
@settings(max_examples=12, deadline=None)
def test_who_steps_slowly_round_the_robot_goes_on_facing_where_they_want_to_go(
    aside_m: float, speed_m_s: float
) -> None:
    """It stands in their way, and they have to step aside; they do not turn to where they step."""
    walker = Person("walker", 1.0, 3.5, 0.0, walk=Walk(((8.0, 3.5),), speed_m_s=speed_m_s))
    world = after(Scene(ROOM, RobotBody(3.0, 3.5 + aside_m), (walker,)), 10.0)
    x, y, heading = world.frames.poses[:, world.frames.entities.index("walker")].T
    wanted = np.arctan2(3.5 - y, 8.0 - x)
    assert np.abs(heading - wanted).max() < math.radians(25.0)
