"""Maps: rooms whose union is the floor, walls between, doors in walls, named places that can be reached."""

from __future__ import annotations

import math
from dataclasses import replace
from itertools import combinations
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st
from shapely import LineString, Point, Polygon

from comity_fis.errors import InputError, Where
from comity_sim2d import (
    DockingPose,
    Person,
    RobotBody,
    RouteMap,
    SceneError,
    World,
    load_map,
    random_spot,
    shipped_maps,
)
from comity_sim2d.paths.visibility import VisibilityGraph
from comity_sim2d.pose import Pose
from comity_sim2d.scene.obstacles import floor_plan, floor_plan_of
from comity_sim2d.scene.passers_by import PassersBy
from comity_sim2d.scene.robot_body import Sensor
from comity_sim2d.senses.sight import Sight

TWO_ROOMS = """\
schema_version: 1
name: two-rooms
rooms:
  kitchen: {box_m: [0, 0, 4, 4]}
  hall: {box_m: [4, 0, 4, 4]}
doors:
  kitchen: {at_m: [4, 2], width_m: 1.0}
furniture:
  - {name: table, box_m: [1, 3, 1, 0.6]}
locations:
  stove: {at_m: [1, 1], facing_deg: 90}
  window: {at_m: [7, 1]}
"""


def written(folder: Path, text: str) -> Path:
    path = folder / "some.map.yaml"
    path.write_text(text, encoding="utf-8")
    return path


@pytest.fixture(scope="module")
def shut_rooms(tmp_path_factory: pytest.TempPathFactory):
    """The two rooms with the door between them shut."""
    place = load_map(written(tmp_path_factory.mktemp("maps"), TWO_ROOMS)).with_doors({"kitchen": False})
    return floor_plan(place.scene(RobotBody(1.0, 1.0)))


@pytest.fixture
def two_rooms(tmp_path: Path):
    return load_map(written(tmp_path, TWO_ROOMS))


@pytest.mark.parametrize("name", shipped_maps())
def test_every_location_of_a_shipped_map_is_reached_from_every_other_with_all_doors_open(name: str) -> None:
    place = load_map(name).with_doors({door.name: True for door in load_map(name).doors})
    start = place.locations[0]
    routes = RouteMap(place.scene(RobotBody(*start.xy)))
    for location in place.locations:
        route = routes.route(start.xy, location.xy)
        assert route is not None, f"{start.name} to {location.name}"
        assert LineString([*route.points, location.xy]).length >= math.dist(start.xy, location.xy) - 1e-6


@pytest.mark.parametrize("name", shipped_maps())
def test_a_shipped_map_is_named_as_its_file_and_says_what_it_is(name: str) -> None:
    place = load_map(name)
    assert place.name == name
    assert place.about.endswith(".")
    assert len(place.locations) >= 4


def test_between_rooms_that_touch_stands_a_wall_with_a_gap_for_the_door(two_rooms) -> None:
    solid = sum(math.dist(wall.start, wall.end) + wall.thickness_m for wall in two_rooms.walls)
    assert [wall.name for wall in two_rooms.walls] == ["the wall between hall and kitchen"] * 2
    # The ends of walls are round: at the gap each piece stops half its thickness before the door.
    assert solid == pytest.approx(4.0 - 1.0 + 0.1)
    (door,) = two_rooms.doors
    assert math.dist(door.start, door.end) == pytest.approx(1.0)


def test_rooms_that_overlap_are_one_space(tmp_path: Path) -> None:
    text = TWO_ROOMS.replace("hall: {box_m: [4, 0, 4, 4]}", "hall: {box_m: [3, 1, 5, 2]}")
    place = load_map(written(tmp_path, text[: text.index("doors:")]))
    assert place.walls == ()
    assert Polygon(place.room.corners).area == pytest.approx(16 + 8)


def test_a_closed_door_leaves_no_route_and_an_open_one_does(two_rooms) -> None:
    robot, goal = RobotBody(1.0, 1.0), (7.0, 1.0)
    open_, closed = two_rooms.scene(robot), two_rooms.with_doors({"kitchen": False}).scene(robot)
    assert RouteMap(open_).route((1.0, 1.0), goal) is not None
    assert RouteMap(closed).route((1.0, 1.0), goal) is None
    assert floor_plan(closed).blocker((4.0, 2.0), 0.2).name == "the closed door 'kitchen'"
    assert floor_plan(closed).wall_between((3.0, 2.0), (5.0, 2.0)) == "the closed door 'kitchen'"
    assert floor_plan(open_).wall_between((3.0, 2.0), (5.0, 2.0)) is None


@given(st.floats(0.1, 3.9), st.floats(0.1, 3.9), st.floats(0.01, 1.0))
@example(1.166, 2.0, 0.4)  # between the line of the wall and that of the door
def test_nobody_is_talked_to_or_seen_through_the_seam_of_a_closed_door(
    shut_rooms, one, other, away_m
) -> None:
    eye, ada = Pose(4.0 - away_m, one, 0.0), Person("ada", 4.0 + away_m, other, 0.0)
    assert shut_rooms.wall_between(eye.xy, ada.xy) is not None
    assert Sight(Sensor(hidden_by_walls=True), shut_rooms).sees(eye, [ada]) == [False]


def test_a_door_that_opens_lets_the_robot_through_and_one_that_closes_keeps_it_out(two_rooms) -> None:
    ada = Person("ada", 7.0, 2.0, math.pi)
    world = World(two_rooms.with_doors({"kitchen": False}).scene(RobotBody(1.0, 1.0), (ada,)))
    world.robot.dock("ada", DockingPose(0.8, 0.0), speed_m_s=0.5)
    world.run(5.0)
    assert world.robot.motion().is_blocked
    assert world.robot.pose.x_m < 4.0
    world.set_door("kitchen", open=True)
    world.robot.dock("ada", DockingPose(0.8, 0.0), speed_m_s=0.5)
    world.run(25.0)
    assert world.robot.motion().state == "succeeded"
    assert [(turn.door, turn.is_open, turn.t) for turn in world.door_turns] == [("kitchen", True, 5.0)]
    assert not world.robot_touches


def test_a_way_that_becomes_longer_is_no_lack_of_progress(tmp_path: Path) -> None:
    """The near door shuts before the robot; for longer than its patience it is farther from its goal."""
    far_door = TWO_ROOMS.replace("4, 4]", "4, 12]").replace(
        "doors:", "doors:\n  far: {at_m: [4, 11], width_m: 1.0}"
    )
    place = load_map(written(tmp_path, far_door))
    world = World(place.scene(RobotBody(1.0, 1.0), (Person("ada", 7.0, 2.0, math.pi),)))
    world.robot.navigate("ada", DockingPose(0.8, 0.0), speed_m_s=0.5)
    world.run(4.0)
    world.set_door("kitchen", open=False)
    states = set()
    while (motion := world.robot.motion()).state != "succeeded" and world.time_s < 90.0:
        states.add((motion.state, motion.is_blocked))
        world.step()
    assert (states, motion.state) == ({("running", False)}, "succeeded")


def test_bodies_do_not_go_through_a_closed_door(two_rooms) -> None:
    world = World(two_rooms.with_doors({"kitchen": False}).scene(RobotBody(3.4, 2.0)))
    physics = world._physics
    from comity_sim2d.pose import Twist

    physics.command(Twist(0.6, 0.0, 0.0))
    physics.run(300)
    assert physics.pose.x_m < 4.0 - 0.25 + 0.01
    assert [touch.entity for touch in world.robot_touches] == ["door kitchen"]


def test_a_door_does_not_close_on_somebody(two_rooms) -> None:
    world = World(two_rooms.scene(RobotBody(4.0, 2.0)))
    with pytest.raises(ValueError, match="robot stands in it"):
        world.set_door("kitchen", open=False)
    with pytest.raises(ValueError, match="Did you mean 'kitchen'"):
        world.set_door("kitchn", open=False)


def test_a_door_does_not_close_on_a_passer_by(two_rooms) -> None:
    """It shuts once they are through, and is told with who stood in it until then."""
    walkers = PassersBy(1, between=((2.5, 2.0), (5.5, 2.0)))
    world = World(replace(two_rooms.scene(RobotBody(1.0, 1.0)), passers_by=walkers))
    told = set()
    for _ in range(400):
        world.step()
        x, y, _ = world.frames_since(len(world.frames) - 1).poses[-1, 1]
        in_the_gap = math.hypot(x - 4.0, max(0.0, abs(y - 2.0) - 0.5)) < 0.2 + 0.025
        try:
            world.set_door("kitchen", open=False)
        except ValueError as refused:
            told.add(str(refused))
        assert world.doors[0].is_open == in_the_gap
        world.set_door("kitchen", open=True)
    assert told == {"the door 'kitchen' cannot be shut: passer-by 1 stands in it"}


def test_segments_are_all_that_stands_still(two_rooms) -> None:
    scene = two_rooms.with_doors({"kitchen": False}).scene(RobotBody(1.0, 1.0))
    ends, half_m = floor_plan(scene).segments.ends, floor_plan(scene).segments.half_m
    assert ends.shape == (len(half_m), 2, 2)
    assert len(half_m) == 4 + 4 + 2 + 1  # outline, table, two pieces of wall, the closed door
    assert np.allclose(ends[-1], [[4.0, 1.5], [4.0, 2.5]])


@pytest.mark.parametrize("name", shipped_maps())
def test_random_places_are_free_apart_and_the_same_for_a_seed(name: str) -> None:
    place = load_map(name)
    plan = floor_plan_of(place.room, place.walls, place.furniture, place.doors)

    def drawn(seed: int) -> list[tuple[float, float]]:
        rng, bodies = np.random.default_rng(seed), []
        for _ in range(8):
            spot = random_spot(plan, bodies, 0.2, rng, within=place.areas[0])
            if spot is not None:
                bodies.append((spot, 0.2))
        return [xy for xy, _ in bodies]

    spots = drawn(1)
    assert len(spots) >= 4
    assert spots == drawn(1) != drawn(2)
    for xy in spots:
        assert plan.blocker(xy, 0.25) is None
        assert Polygon(place.areas[0].corners).contains(Point(xy))
    assert min(math.dist(one, other) for one, other in combinations(spots, 2)) >= 0.7 - 1e-9


def test_a_full_room_has_no_random_place(two_rooms) -> None:
    plan = floor_plan_of(two_rooms.room, two_rooms.walls, two_rooms.furniture, two_rooms.doors)
    bodies = [((x / 2, y / 2), 0.2) for x in range(9) for y in range(9)]
    assert random_spot(plan, bodies, 0.2, np.random.default_rng(0), within=two_rooms.area("kitchen")) is None


BAD = {
    "a room that crosses itself": (
        ("{box_m: [0, 0, 4, 4]}", "{polygon_m: [[0, 0], [4, 4], [4, 0], [0, 4]]}"),
        4,
        "room kitchen: expected an outline that does not cross itself, got a self-intersection at (2, 2)",
    ),
    "a room without a door": (
        ("doors:\n  kitchen: {at_m: [4, 2], width_m: 1.0}\n", ""),
        4,
        "room kitchen: expected a room that a robot 0.5 m across can get into",
    ),
    "a door without width": (("width_m: 1.0", "width_m: 0"), 7, "expected width_m from 0.01 up, got 0"),
    "a box in the only door": (
        ("furniture:\n", "furniture:\n  - {name: box, box_m: [3.9, 1.9, 0.2, 0.2]}\n"),
        4,
        "got one without a way into it that is wide enough: 'box' stands in the door 'kitchen'. Add",
    ),
    "a wall right behind the only door": (
        ("furniture:\n", "furniture:\n  - {name: screen, box_m: [3.55, 0, 0.05, 4]}\n"),
        4,
        "room kitchen: expected a room that a robot 0.5 m across can get into",
    ),
    "a door like a crack": (("width_m: 1.0", "width_m: 1.0e-9"), 7, "expected width_m from 0.01 up"),
    "a door narrower than its way": (("width_m: 1.0", "width_m: 0.59"), 4, "Add a door of 0.60 m or more"),
    "a door narrower than the robot": (("width_m: 1.0", "width_m: 0.5"), 4, "Add a door of 0.60 m or more"),
    "a location behind a gap that is too narrow": (
        ("furniture:\n", "furniture:\n  - {name: box, box_m: [6, 0.55, 0.3, 3.45]}\n"),
        13,
        "to which no way is wide enough. Clear a way 0.60 m wide of furniture, widen a door, or move",
    ),
    "a door beside the wall": (
        ("at_m: [4, 2]", "at_m: [3, 2]"),
        7,
        "which is 1.00 m from the nearest, the wall between hall and kitchen from (4, 0) to (4, 4). "
        "Move it onto the wall: (4, 2) is.",
    ),
    "a door in the outer wall": (("at_m: [4, 2]", "at_m: [0, 2]"), 7, "which leads out of the map"),
    "a door wider than its wall": (("width_m: 1.0", "width_m: 4.5"), 7, "Make it at most 4 m wide there"),
    "a location outside": (("at_m: [7, 1]", "at_m: [20, 1]"), 12, "which is in none. Move it into a room"),
    "a location in furniture": (("at_m: [1, 1]", "at_m: [1.5, 3.3]"), 11, "inside the table"),
    "a location too near to a wall": (("at_m: [7, 1]", "at_m: [7.9, 1]"), 12, "0.10 m from the room's outer"),
    "a room far away": (
        ("hall: {box_m: [4, 0, 4, 4]}", "hall: {box_m: [5, 0, 4, 4]}"),
        5,
        "room hall: expected rooms that touch",
    ),
    "a coordinate that is no number": (("at_m: [7, 1]", "at_m: [.nan, 1]"), 12, "got nan"),
    "a huge coordinate": (("at_m: [7, 1]", "at_m: [1e300, 1]"), 12, "up to 1000"),
    "a room that ends too far out": (
        ("hall: {box_m: [4, 0, 4, 4]}", "hall: {box_m: [4, 0, 999, 4]}"),
        5,
        "room hall",
    ),
    "no rooms": (
        ("kitchen: {box_m: [0, 0, 4, 4]}\n  hall: {box_m: [4, 0, 4, 4]}", "{}"),
        3,
        "at least 1 item",
    ),
    "a room of no size": (
        ("{box_m: [4, 0, 4, 4]}", "{box_m: [4, 0, 0, 4]}"),
        5,
        "width and a height above 0",
    ),
    "a room without a shape": (("{box_m: [4, 0, 4, 4]}", "{}"), 5, "one of `box_m`, `polygon_m`"),
    "furniture outside": (("box_m: [1, 3, 1, 0.6]", "box_m: [10, 3, 1, 0.6]"), 9, "wholly outside"),
    "furniture of one name": (
        ("furniture:\n", "furniture:\n  - {name: table, box_m: [5, 3, 1, 0.6]}\n"),
        10,
        "table: expected a name of its own for every piece of furniture, got 'table' 2 times",
    ),
    "a wall without length": (
        ("furniture:\n", "walls:\n  - line_m: [[1, 1], [2, 1]]\n  - line_m: [[3, 3], [3, 3]]\nfurniture:\n"),
        10,
        "wall 2: expected a wall between two different points, got (3.0, 3.0) twice",
    ),
    "a wall outside": (
        ("furniture:\n", "walls:\n  - {name: pillar, line_m: [[9, 1], [9, 2]]}\nfurniture:\n"),
        9,
        "pillar: expected walls and furniture that are at least partly inside the room",
    ),
    "an unknown key": (("width_m: 1.0", "width: 1.0"), 7, "Did you mean 'width_m'?"),
}


@pytest.mark.parametrize("case", BAD)
def test_a_bad_map_is_refused_with_its_line_and_a_remedy(case: str, tmp_path: Path) -> None:
    (old, new), line, text = BAD[case]
    assert old in TWO_ROOMS
    path = written(tmp_path, TWO_ROOMS.replace(old, new))
    with pytest.raises(InputError) as caught:
        load_map(path)
    message = str(caught.value)
    assert message.startswith(f"{path}:{line}:"), message
    assert text in message
    assert message.endswith((".", "?"))


@settings(max_examples=20, deadline=None)
@given(st.floats(0.3, 3.7))
@example(2.0)
def test_a_door_as_wide_as_the_refusal_asks_for_lets_the_robot_through(y_m: float) -> None:
    with TemporaryDirectory() as folder:
        changed = TWO_ROOMS.replace("at_m: [4, 2], width_m: 1.0", f"at_m: [4, {y_m!r}], width_m: 0.6")
        place = load_map(written(Path(folder), changed.replace("furniture:\n", "furniture: []\n#")))
    assert RouteMap(place.scene(RobotBody(1.0, 1.0))).route((1.0, 1.0), (7.0, 1.0)) is not None


@pytest.mark.parametrize("name", [None, 3, ["apartment"]])
def test_what_is_no_name_of_a_map_is_refused_as_such(name: object) -> None:
    with pytest.raises(InputError, match="expected a map's name or a path, got"):
        load_map(name)  # type: ignore[arg-type]


ODD = [0.6, 1e-9, 3.9999999, 999.9999, 1000.0, -1000.0, 1e300, math.nan, math.inf, -math.inf]
NUMBERS = st.sampled_from([n / 2 for n in range(-2, 18)] * 10 + ODD)
POINTS = st.tuples(NUMBERS, NUMBERS).map(list)
SHAPES = st.one_of(
    st.fixed_dictionaries({"box_m": st.lists(NUMBERS, min_size=4, max_size=4)}),
    st.fixed_dictionaries({"polygon_m": st.lists(POINTS, min_size=3, max_size=7)}),
)
NAMES = st.sampled_from(["a", "b", "c"])
TURNS = st.just({}) | st.fixed_dictionaries({"angle_deg": NUMBERS})
ANY_MAP = st.fixed_dictionaries(
    {"schema_version": st.just(1), "name": st.just("any"), "rooms": st.dictionaries(NAMES, SHAPES)},
    optional={
        "walls": st.lists(st.fixed_dictionaries({"line_m": st.tuples(POINTS, POINTS).map(list)}), max_size=3),
        "doors": st.dictionaries(NAMES, st.fixed_dictionaries({"at_m": POINTS, "width_m": NUMBERS})),
        "furniture": st.lists(
            st.tuples(NAMES, SHAPES, NUMBERS).map(
                lambda one: {"name": one[0], "angle_deg": one[2], **one[1]}
            ),
            max_size=3,
        ),
        "locations": st.dictionaries(NAMES, st.fixed_dictionaries({"at_m": POINTS})),
    },
)


def test_whoever_writes_the_same_map_has_the_same_one(tmp_path) -> None:
    """And another one where anything in it is otherwise."""
    place = load_map(written(tmp_path, TWO_ROOMS))
    assert load_map(written(tmp_path, f"{TWO_ROOMS}# a remark\n")) is place
    assert load_map(written(tmp_path, TWO_ROOMS.replace("width_m: 1.0", "width_m: 1.1"))) != place


@given(ANY_MAP)
@settings(max_examples=150, deadline=None)
def test_whatever_a_map_says_it_is_a_map_or_an_error_with_a_line_and_a_remedy(content) -> None:
    from comity_fis.validation.yaml_file import dump_yaml, parse_yaml
    from comity_sim2d.maps.building import build_map
    from comity_sim2d.maps.file import MapFile

    file = parse_yaml(dump_yaml(content), Path("any.map.yaml"), "any.map.yaml")
    refused = None
    try:
        build_map(file.check(MapFile), lambda *location: file.where(location))
    except InputError as error:
        refused = error
    assert refused is None or (refused.where.line and refused.remedy)


@given(
    st.lists(st.integers(12, 60), min_size=2, max_size=4),
    st.lists(st.tuples(st.integers(0, 200), st.integers(0, 60), st.integers(2, 20)), max_size=6),
    st.integers(5, 14),
    st.integers(0, 90),
)
@settings(max_examples=60, deadline=None)
def test_in_a_map_that_is_accepted_there_is_a_way_from_everywhere_to_everywhere(
    widths, boxes, door, angle
) -> None:
    """Rooms in a row, with doors of some width and boxes wherever they fall."""
    from comity_sim2d.maps.building import build_map
    from comity_sim2d.maps.file import MapFile

    ends = [sum(widths[:i]) / 10 for i in range(len(widths) + 1)]
    content = {
        "schema_version": 1,
        "name": "row",
        "rooms": {f"r{i}": {"box_m": [ends[i], 0, width / 10, 4]} for i, width in enumerate(widths)},
        "doors": {f"d{i}": {"at_m": [x, 1.5], "width_m": door / 10} for i, x in enumerate(ends[1:-1])},
        "furniture": [
            {"name": f"f{i}", "box_m": [x / 10, y / 10, size / 10, 0.4], "angle_deg": angle}
            for i, (x, y, size) in enumerate(boxes)
        ],
        "locations": {f"r{i}": {"at_m": [ends[i] + width / 20, 1.5]} for i, width in enumerate(widths)},
    }
    try:
        place = build_map(MapFile.model_validate(content), lambda *_: Where("row"))
    except InputError:
        return
    routes = RouteMap(place.scene(RobotBody(*place.locations[0].xy)))
    for one, other in combinations(place.locations, 2):
        assert routes.route(one.xy, other.xy) is not None


def test_what_becomes_too_much_as_walls_between_rooms_is_refused_with_the_map(tmp_path: Path) -> None:
    """200 rooms and their doors are few to write, and with the walls between them too many obstacles."""
    rooms = "".join(f"  r{i}: {{box_m: [{i % 20 * 2}, {i // 20 * 2}, 2, 2]}}\n" for i in range(200))
    doors = [(x * 2 + 2, y * 2 + 1) for x in range(19) for y in range(10)]
    doors += [(x * 2 + 1, y * 2 + 2) for x in range(20) for y in range(9)]
    gaps = "".join(f"  d{i}: {{at_m: [{x}, {y}], width_m: 0.9}}\n" for i, (x, y) in enumerate(doors))
    path = written(tmp_path, f"schema_version: 1\nname: cells\nrooms:\n{rooms}doors:\n{gaps}")
    with pytest.raises(InputError, match=r":3: scene: expected at most 1000 walls, doors and .*, got 1110\."):
        load_map(path)


def test_a_map_of_a_thousand_obstacles_has_room_for_people_up_to_a_limit_of_their_own(tmp_path: Path) -> None:
    posts = "".join(
        f"  - {{name: f{i}, circle_m: [{i % 100 + 0.5}, {i // 100}.5, 0.1]}}\n" for i in range(1000)
    )
    path = written(
        tmp_path,
        f"schema_version: 1\nname: posts\nrooms:\n  a: {{box_m: [0, 0, 100, 12]}}\nfurniture:\n{posts}",
    )
    place, ann = load_map(path), Person("ann", 5.0, 11.0, 0.0)
    assert place.scene(RobotBody(1.0, 11.0), (ann,)).people == (ann,)
    many = tuple(Person(f"p{i}", 5.0, 11.0, 0.0) for i in range(1001))
    with pytest.raises(SceneError, match="at most 1000 people, got 1001"):
        place.scene(RobotBody(1.0, 11.0), many)


@pytest.mark.parametrize("name", ["علی‌رضا", "👩‍🦽", "क्‍ष"])
def test_letters_that_are_joined_make_a_name(name: str, tmp_path: Path) -> None:
    """Persian and Indian names, and emoji, hold characters that are not printed and join those that are."""
    place = load_map(written(tmp_path, TWO_ROOMS.replace("kitchen: {box", f"{name}: {{box")))
    assert name in [area.name for area in place.areas]


@pytest.mark.parametrize("kind", ["furniture", "walls"])
def test_ten_thousand_obstacles_are_refused_at_once(kind: str, tmp_path: Path) -> None:
    each = {
        "furniture": lambda i: f"{{name: f{i}, box_m: [{i % 100}, {i // 100}, 0.3, 0.3]}}",
        "walls": lambda i: f"{{line_m: [[{i % 100}, {i // 100}], [{i % 100}.3, {i // 100}]]}}",
    }[kind]
    lines = "\n".join(f"  - {each(i)}" for i in range(10_000))
    text = f"schema_version: 1\nname: big\nrooms:\n  hall: {{box_m: [0, 0, 101, 101]}}\n{kind}:\n{lines}\n"
    with pytest.raises(InputError, match=f"at most 1000 items in {kind}, got 10000"):
        load_map(written(tmp_path, text))


@pytest.mark.parametrize("shape", ["box_m: [{x}, {y}, 0.1, 0.1]", "circle_m: [{x}, {y}, 0.06]"])
def test_a_route_between_a_thousand_posts_is_hardly_longer_than_it_has_to_be(
    shape: str, tmp_path: Path
) -> None:
    """Between rows of posts there are more ways of nearly the same length than could be looked at."""
    posts = "\n".join(
        f"  - {{name: f{i}, {shape.format(x=1 + i % 45, y=1 + i // 45)}}}" for i in range(45 * 22)
    )
    text = f"schema_version: 1\nname: posts\nrooms:\n  hall: {{box_m: [0, 0, 47, 25]}}\nfurniture:\n{posts}\n"
    start, goal = (0.5, 0.5), (40.6, 20.6)
    routes = RouteMap(load_map(written(tmp_path, text)).scene(RobotBody(*start)))
    length_m, least_m = routes.length(start, goal), routes.least_length(start, goal)
    assert math.dist(start, goal) - 2e-6 <= least_m <= length_m <= 1.1 * least_m


def test_a_way_is_the_same_however_many_lines_are_drawn_at_once(monkeypatch: pytest.MonkeyPatch) -> None:
    posts = [Point(x, y).buffer(0.3, quad_segs=2).exterior.coords for x in range(1, 9) for y in range(1, 9)]
    free = Polygon([(0, 0), (10, 0), (10, 10), (0, 10)], posts)
    ends = [((0.5, 0.4), (9.6, 8.9)), ((0.2, 7.5), (9.1, 1.5))]
    found = []
    for corners in (1, 30, 10**6):  # from one corner at a time, from a few, and from all
        monkeypatch.setattr("comity_sim2d.paths.visibility.DRAWN", corners)
        graph = VisibilityGraph(free)
        found.append([graph.shortest(*each) for each in ends])
    assert found[0] == found[1] == found[2]


def test_the_search_for_a_route_finds_the_shortest(tmp_path: Path) -> None:
    """Against a graph of all lines between all corners that are free."""
    import networkx as nx

    rng = np.random.default_rng(3)
    free = Polygon([(0, 0), (8, 0), (8, 8), (0, 8)])
    for x, y, turn in rng.uniform((0.5, 0.5, 0), (7.5, 7.5, 1.5), (14, 3)):
        angles = [turn + k * math.pi / 2 for k in range(4)]
        free = free.difference(Polygon([(x + 0.5 * math.cos(a), y + 0.5 * math.sin(a)) for a in angles]))
    free = max(getattr(free, "geoms", [free]), key=lambda part: part.area)
    graph, search = nx.Graph(), VisibilityGraph(free)
    points = [point for ring in (free.exterior, *free.interiors) for point in ring.coords[:-1]]
    points += [(0.1, 0.1), (7.9, 7.9)]
    around = free.buffer(1e-6)
    for one, other in combinations(points, 2):
        if around.covers(LineString([one, other])):
            graph.add_edge(one, other, weight=math.dist(one, other))
    for start, goal in combinations([(0.1, 0.1), (7.9, 7.9), points[20], points[40]], 2):
        best = nx.shortest_path_length(graph, start, goal, weight="weight")
        assert LineString(search.shortest(start, goal)).length == pytest.approx(best, abs=1e-5)
