"""Where the robot stands to fetch something: of all free places the one with the shortest way."""

from __future__ import annotations

import math

import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from comity_sim2d import Furniture, Person, RobotBody, Room, RouteMap, Scene, SceneError, Wall, standing_place
from comity_sim2d.navigation.fetching import _poses
from comity_sim2d.pose import XY, Pose

START = (0.6, 3.0)


def room(table: Furniture, *people: Person, walls: tuple[Wall, ...] = ()) -> Scene:
    return Scene(Room.rectangle(8.0, 6.0), RobotBody(*START), people, walls, (table,))


def shortest(scene: Scene, routes: RouteMap) -> Pose | None:
    """Found by measuring the ways to all places."""
    ways = []
    for number, pose in enumerate(_poses(scene, "table")):
        if routes.surroundings.blocker(pose.xy) is None and routes.reaches(START, pose.xy):
            length_m = routes.length(START, pose.xy)
            ways.append((math.inf if length_m is None else round(length_m, 6), number, pose))
    return min(ways)[2] if ways else None


class Counted(RouteMap):
    """Routes that are counted as they are measured."""

    def __init__(self, scene: Scene) -> None:
        super().__init__(scene)
        self.measured: list[XY] = []

    def length(self, start, goal, *, keep=None):
        self.measured.append(goal)
        return super().length(start, goal, keep=keep)


@given(
    at=st.tuples(st.floats(2.0, 6.5), st.floats(1.0, 5.0)),
    wide=st.floats(0.3, 2.0),
    turned=st.floats(0.0, math.pi),
    ada=st.tuples(st.floats(1.5, 7.5), st.floats(0.5, 5.5)),
    gap=st.floats(0.3, 1.2),
)
@settings(max_examples=60, deadline=None)
def test_no_free_place_has_a_shorter_way(at: XY, wide: float, turned: float, ada: XY, gap: float) -> None:
    table = Furniture.box("table", *at, width_m=wide, depth_m=0.6, angle_rad=turned)
    wall = Wall((3.0, 0.0), (3.0, 6.0 - gap))
    try:
        scene = room(table, Person("ada", *ada, 0.0), walls=(wall,))
    except SceneError:
        assume(False)
    assert standing_place(scene, RouteMap(scene), "table") == shortest(scene, RouteMap(scene))


@pytest.mark.parametrize("y", [3.0, 1.2])
def test_places_whose_way_cannot_be_the_shortest_are_not_measured(y: float) -> None:
    scene = room(Furniture.box("table", 5.0, y, width_m=2.0, depth_m=0.8))
    routes = Counted(scene)
    assert standing_place(scene, routes, "table") is not None
    assert len(routes.measured) <= 2 < len(list(_poses(scene, "table"))) / 4


def test_a_table_in_a_room_without_a_door_has_no_place() -> None:
    table = Furniture.box("table", 5.0, 3.0, width_m=1.0, depth_m=0.8)
    scene = room(table, walls=(Wall((3.0, 0.0), (3.0, 6.0)),))
    assert standing_place(scene, RouteMap(scene), "table") is None
