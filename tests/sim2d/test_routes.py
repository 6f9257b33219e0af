"""Routes: shortest, clear of everything, and around people as far as they like where that is possible."""

import math
import random
from itertools import pairwise

import networkx as nx
import pytest
from hypothesis import HealthCheck, assume, example, given, settings
from hypothesis import strategies as st
from shapely import LineString, Point, Polygon

from comity_sim2d import Furniture, Person, RobotBody, Room, RouteMap, Scene, SceneError, Wall
from comity_sim2d.navigation.route_map import MOST_SEARCHES

START, GOAL = (0.6, 0.6), (6.4, 4.4)
FEW = settings(max_examples=30, deadline=None, suppress_health_check=[HealthCheck.filter_too_much])


def room_with(seed: int, people: int = 2) -> Scene:
    rng = random.Random(seed)
    furniture = tuple(
        Furniture.box(
            f"box {i}",
            rng.uniform(0.5, 6.5),
            rng.uniform(0.5, 4.5),
            width_m=rng.uniform(0.2, 1.2),
            depth_m=rng.uniform(0.2, 1.2),
            angle_rad=rng.uniform(0.0, math.pi),
        )
        for i in range(6)
    )
    crowd = tuple(Person(f"p{i}", rng.uniform(0.5, 6.5), rng.uniform(0.5, 4.5), 0.0) for i in range(people))
    try:
        return Scene(Room.rectangle(7.0, 5.0), RobotBody(*START), crowd, furniture=furniture)
    except SceneError:
        assume(False)
        raise


@given(st.integers(0, 10_000))
@FEW
def test_a_route_is_never_shorter_than_the_straight_line_and_equals_it_where_nothing_is_between(
    seed: int,
) -> None:
    scene = room_with(seed)
    route = RouteMap(scene).route(START, GOAL)
    assume(route is not None)
    straight = math.dist(START, GOAL)
    line = LineString([START, GOAL])
    gaps = [Polygon(piece.corners).distance(line) for piece in scene.furniture]
    gaps += [Point(p.pose.xy).distance(line) - 0.45 for p in scene.people]
    assert route.length_m >= straight - 1e-9
    if min(gaps) > 0.56:  # beyond all margins
        assert route.length_m == straight


@given(st.integers(0, 10_000))
@FEW
def test_a_route_stays_clear_of_furniture_walls_and_people(seed: int) -> None:
    """Of people to half a centimetre, by which the chords of a rounded corner may cut their arc."""
    scene = room_with(seed)
    routes = RouteMap(scene)
    assume(routes.surroundings.blocker(START) is None)
    route = routes.route(START, GOAL)
    assume(route is not None)
    line = LineString(route.points)
    assert Polygon(scene.room.corners).exterior.distance(line) > 0.25 + 0.04
    for piece in scene.furniture:
        assert Polygon(piece.corners).distance(line) > 0.25 + 0.04
    for person in scene.people:
        assert Point(person.pose.xy).distance(line) > 0.45 + 0.30 - 0.005


@given(st.integers(0, 10_000))
@settings(max_examples=8, deadline=None, suppress_health_check=[HealthCheck.filter_too_much])
def test_a_route_is_the_shortest(seed: int) -> None:
    """Against Dijkstra on a fine grid, which can only be longer (by up to 8 % where it zigzags)."""
    scene = room_with(seed, people=0)
    route = RouteMap(scene).route(START, GOAL)
    on_grid = grid_length(scene, 0.1)
    assume(route is not None and on_grid is not None)
    assert route.length_m <= on_grid + 0.15


def grid_length(scene: Scene, cell: float) -> float | None:
    solid = [Polygon(piece.corners) for piece in scene.furniture]
    free = {
        (i, j)
        for i in range(3, 68)
        for j in range(3, 48)
        if all(shape.distance(Point(i * cell, j * cell)) >= 0.30 for shape in solid)
    }
    graph = nx.Graph()
    for i, j in sorted(free):
        for di, dj in ((1, 0), (0, 1), (1, 1), (1, -1)):
            if (i + di, j + dj) in free:
                graph.add_edge((i, j), (i + di, j + dj), weight=cell * math.hypot(di, dj))
    ends = (round(START[0] / cell), round(START[1] / cell)), (round(GOAL[0] / cell), round(GOAL[1] / cell))
    if not all(end in graph for end in ends) or not nx.has_path(graph, *ends):
        return None
    return float(nx.shortest_path_length(graph, *ends, weight="weight"))


@given(st.integers(0, 10_000))
@FEW
def test_reachable_means_that_there_is_a_route(seed: int) -> None:
    routes = RouteMap(room_with(seed))
    for goal in (GOAL, (0.6, 4.4), (6.4, 0.6)):
        if routes.surroundings.blocker(goal) is None:
            assert routes.reaches(START, goal) == (routes.length(START, goal) is not None)


@given(st.integers(0, 10_000))
@FEW
def test_whatever_is_reached_is_among_what_may_be(seed: int) -> None:
    routes = RouteMap(room_with(seed, 4))
    goals = [(x / 2, y / 2) for x in range(1, 16) for y in range(1, 12)]
    may = routes.may_reach(START, goals).tolist()
    assert all(may[i] for i, goal in enumerate(goals) if routes.reaches(START, goal))
    assert not all(may)


@given(st.integers(0, 10_000))
@example(229)  # an arc inside the polygon that goes around the same corner
@FEW
def test_no_route_is_shorter_than_the_least_length_and_where_there_is_none_there_is_no_route(
    seed: int,
) -> None:
    routes = RouteMap(room_with(seed))
    for goal in (GOAL, (0.6, 4.4), (6.4, 0.6)):
        if routes.surroundings.blocker(goal) is None:
            least, length = routes.least_length(START, goal), routes.length(START, goal)
            assert length is None or (least is not None and math.dist(START, goal) - 1e-5 < least <= length)


def test_the_least_length_leads_around_walls() -> None:
    scene = Scene(Room.rectangle(7.0, 5.0), RobotBody(*START), walls=(Wall((3.0, 0.0), (3.0, 4.0)),))
    assert RouteMap(scene).least_length(START, (6.0, 0.6)) > 8.0


def test_a_way_to_where_the_robot_stands_has_no_length_and_no_less() -> None:
    scene = Scene(Room.rectangle(7.0, 5.0), RobotBody(*START))
    assert RouteMap(scene).least_length(START, START) == 0.0


def corridor(width: float, own: float | None) -> Scene:
    """A corridor along x with someone in the middle of it."""
    bystander = Person("bo", 3.0, width / 2, 0.0, personal_distance_m=own)
    return Scene(Room.rectangle(6.0, width), RobotBody(0.6, width / 2), (bystander,))


@pytest.mark.parametrize("own", [0.5, 0.8, 1.1])
def test_a_bystander_is_passed_at_their_own_distance_where_there_is_room(own: float) -> None:
    route = RouteMap(corridor(5.0, own)).route((0.6, 2.5), (5.4, 2.5))
    assert route is not None
    gap = Point(3.0, 2.5).distance(LineString(route.points)) - 0.45
    assert gap == pytest.approx(own, abs=0.01)


def test_a_bystander_is_passed_nearer_where_there_is_no_other_way() -> None:
    """A corridor of 2.4 m leaves 0.45 m at most."""
    route = RouteMap(corridor(2.4, 1.0)).route((0.6, 1.2), (5.4, 1.2))
    assert route is not None
    gap = Point(3.0, 1.2).distance(LineString(route.points)) - 0.45
    assert 0.30 - 0.01 <= gap <= 0.45


def test_nobody_is_passed_within_the_safety_margin() -> None:
    assert RouteMap(corridor(1.8, 0.3)).route((0.6, 0.9), (5.4, 0.9)) is None


def test_a_long_way_round_is_preferred_to_someones_own_space() -> None:
    bystander = Person("bo", 3.0, 0.9, 0.0, personal_distance_m=0.9)
    wall = Wall((1.5, 1.9), (4.5, 1.9))
    scene = Scene(Room.rectangle(6.0, 4.0), RobotBody(0.6, 0.9), (bystander,), walls=(wall,))
    route = RouteMap(scene).route((0.6, 0.9), (5.4, 0.9))
    assert route is not None
    assert max(y for _, y in route.points) > 2.1


def test_a_start_inside_a_margin_is_led_out_of_it() -> None:
    scene = Scene(Room.rectangle(6.0, 4.0), RobotBody(0.26, 2.0))
    route = RouteMap(scene).route((0.26, 2.0), (5.0, 2.0))
    assert route is not None
    assert route.points[0] == (0.26, 2.0)


def test_no_way_is_none() -> None:
    wall = Wall((3.0, 0.0), (3.0, 4.0))
    scene = Scene(Room.rectangle(6.0, 4.0), RobotBody(1.0, 2.0), walls=(wall,))
    assert RouteMap(scene).length((1.0, 2.0), (5.0, 2.0)) is None


def test_a_door_of_twenty_centimetres_more_than_the_robot_is_wide_enough() -> None:
    walls = (Wall((3.0, 0.0), (3.0, 1.6)), Wall((3.0, 2.4), (3.0, 4.0)))
    scene = Scene(Room.rectangle(6.0, 4.0), RobotBody(1.0, 2.0), walls=walls)
    assert RouteMap(scene).length((1.0, 0.6), (5.0, 0.6)) is not None


def test_a_route_does_not_depend_on_what_was_asked_before() -> None:
    scene = Scene(
        Room.rectangle(7.0, 5.0),
        RobotBody(*START),
        (Person("ada", 3.5, 3.5, 0.0),),
        furniture=(Furniture.box("box", 3.0, 2.0, width_m=1.0, depth_m=2.0),),
    )
    fresh, used = RouteMap(scene), RouteMap(scene)
    for goal in ((6.4, 0.6), (0.6, 4.4), (3.0, 2.6)):
        used.length(START, goal)
    assert fresh.route(START, GOAL) == used.route(START, GOAL)


def test_bends_allow_the_speed_that_their_radius_allows() -> None:
    """Around a corner v^2 <= a r, so the limit is never below that of the tightest arc, 0.30 m."""
    scene = Scene(
        Room.rectangle(6.0, 4.0),
        RobotBody(0.6, 0.6),
        furniture=(Furniture.box("box", 3.0, 1.0, width_m=1.0, depth_m=2.0),),
    )
    route = RouteMap(scene).route((0.6, 0.6), (5.4, 0.6))
    assert route is not None
    limits = [route.bend_limit(0.01 * k, 0.4, 0.3) for k in range(int(route.length_m * 100))]
    assert min(limits) > math.sqrt(0.4 * 0.29)
    turns = [math.atan2(b[1] - a[1], b[0] - a[0]) for a, b in pairwise(route.points)]
    assert max(abs(b - a) for a, b in pairwise(turns)) < math.radians(4.0)


@given(st.floats(0.29, 0.6), st.floats(-math.pi, math.pi))
@settings(max_examples=60, deadline=None)
def test_the_way_to_a_free_place_beside_a_bystander_keeps_30_cm(gap: float, angle: float) -> None:
    """Also round that person, to a place that is hardly free."""
    bo = Person("bo", 3.0, 3.0, 0.0)
    scene = Scene(Room.rectangle(6.0, 6.0), RobotBody(0.6, 3.0), (bo,))
    goal = (3.0 + (0.45 + gap) * math.cos(angle), 3.0 + (0.45 + gap) * math.sin(angle))
    routes = RouteMap(scene)
    if routes.surroundings.blocker(goal) is not None:
        assert gap < 0.305
        return
    route = routes.route((0.6, 3.0), goal)
    assert route is not None
    assert Point(bo.xy).distance(LineString(route.points)) >= 0.45 + 0.30


def test_in_a_crowd_of_hundreds_a_route_takes_few_searches_and_keeps_out_of_everybody() -> None:
    """Every way around some of a crowd crosses others of it: not one search for each of them."""

    class Counting(RouteMap):
        searches = 0

        def _around(self, kept):
            self.searches += 1
            return super()._around(kept)

    crowd = tuple(Person(f"p{i}", 2 + i % 18 * 0.95, 2 + i // 18 * 0.95, 0.0) for i in range(18 * 18))
    routes = Counting(Scene(Room.rectangle(22.0, 22.0), RobotBody(1.0, 1.0), crowd))
    route = routes.route((1.0, 1.0), (21.0, 21.0))
    line = LineString(route.points)
    assert min(Point(person.xy).distance(line) for person in crowd) > 0.45 + 0.30 - 0.01
    assert routes.searches <= 2 * (MOST_SEARCHES + 1)


@given(st.floats(0.0, 75.0), st.floats(0.605, 0.65), st.booleans())
@example(45.0, 0.605, True)
@settings(max_examples=15, deadline=None)
def test_a_way_leads_through_a_slanted_slot_narrower_than_a_cell_of_the_grid(
    angle_deg: float, width: float, beside: bool
) -> None:
    """The robot's centre has 5 mm to 5 cm there, also where somebody beside the way has to be weighed."""
    a, half = math.radians(angle_deg), (width + 0.1) / 2
    along, across = (0.6 * math.cos(a), 0.6 * math.sin(a)), (-half * math.sin(a), half * math.cos(a))
    low, high = ((6 - across[0], 4 - across[1]), (6 + across[0], 4 + across[1]))
    sides = [((x - along[0], y - along[1]), (x + along[0], y + along[1])) for x, y in (low, high)]
    ends = [(sides[0][0], (sides[0][0][0], 0.0)), (sides[1][1], (sides[1][1][0], 8.0))]
    walls = tuple(Wall(*line) for line in (*sides, *ends))
    people = (Person("bob", 2.6, 4.5, 0.0),) if beside else ()
    scene = Scene(Room.rectangle(12.0, 8.0), RobotBody(1.0, 4.0), people, walls=walls)
    route = RouteMap(scene).route((1.0, 4.0), (11.0, 4.0))
    line = LineString(route.points)
    assert min(LineString([wall.start, wall.end]).distance(line) for wall in walls) > 0.25 + 0.05
