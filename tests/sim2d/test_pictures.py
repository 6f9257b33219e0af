"""Pictures and animations: written, readable by others, the same every time, no label over another."""

import math
import re
from collections.abc import Callable
from dataclasses import replace
from io import BytesIO
from itertools import combinations
from pathlib import Path

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.patches import FancyBboxPatch, Patch
from matplotlib.text import Text
from numpy.typing import NDArray
from PIL import Image
from shapely import LineString, MultiPoint, Point, Polygon, box

from comity_executor import ActGoal
from comity_sim2d import (
    ActEvent,
    Area,
    DockingPose,
    Door,
    Frames,
    Furniture,
    Group,
    Location,
    Person,
    Pose,
    RobotBody,
    Room,
    Scene,
    Wall,
    World,
)
from comity_sim2d.maps.library import load_map, shipped_maps
from comity_sim2d.maps.place_map import PlaceMap
from comity_sim2d.pictures.animation import _canvas, write_gif
from comity_sim2d.pictures.cards import cards
from comity_sim2d.pictures.drawing import (
    FURNITURE,
    WALL,
    beside_m,
    draw_place,
    o_spaces_at,
    robot_artists,
)
from comity_sim2d.pictures.label_placement import APART_PX, Box, Disc, Page
from comity_sim2d.pictures.legend import Legend
from comity_sim2d.pictures.lettering import lacking, lettering
from comity_sim2d.pictures.map_labels import MOST_LINES, MapLabels
from comity_sim2d.pictures.map_picture import draw_map
from comity_sim2d.pictures.moving_rings import MovingRings, ReachedLines
from comity_sim2d.pictures.person_colours import person_colours
from comity_sim2d.pictures.picture import _facts, draw_picture
from comity_sim2d.pictures.readable_names import legible, readable
from comity_sim2d.pictures.ring import Ring
from comity_sim2d.pictures.sayings import sayings
from comity_sim2d.pictures.speech import Speech
from comity_sim2d.pose import XY
from comity_sim2d.scene.o_space import OSpace
from comity_sim2d.scene.passers_by import PassersBy
from comity_sim2d.scene.surroundings import Surroundings
from comity_sim2d.scene.walk import Walk

SCENE = Scene(
    Room.rectangle(6.0, 4.5),
    RobotBody(0.6, 0.6),
    (Person("johanna", 4.6, 3.0, math.radians(200)), Person("omar", 4.0, 0.8, math.radians(120))),
    furniture=(Furniture.box("table", 3.2, 3.9, width_m=1.0, depth_m=0.7),),
)


@pytest.fixture(scope="module")
def episode() -> World:
    world = World(SCENE)
    world.robot.dock("johanna", DockingPose(0.64, 0.0), speed_m_s=0.7)
    while world.robot.motion().state != "succeeded":
        world.step()
    world.robot.perform(ActGoal("say", "johanna", "Guten Tag, Johanna."))
    world.run(1.5)
    return world


def rings() -> list[Ring]:
    return [Ring("johanna", 0.64, 0.641, 0.0), Ring("omar", 0.9, None, 40.0, label="could not be reached")]


def test_a_picture_is_as_wide_as_asked_and_the_same_every_time(tmp_path, episode: World) -> None:
    for name in ("a.png", "b.png"):
        draw_picture(
            tmp_path / name, SCENE, episode.frames, rings=rings(), events=episode.events, title="A visit"
        )
    assert (tmp_path / "a.png").read_bytes() == (tmp_path / "b.png").read_bytes()
    with Image.open(tmp_path / "a.png") as image:
        assert image.format == "PNG"
        assert image.width == 1200
        assert image.info["Software"] == "Comity"


@pytest.mark.parametrize("name", ["$", "cost $5_^$ \\frac", "$\\badness{$", "a$b$c"])
def test_a_dollar_in_a_name_is_a_dollar_in_every_picture(tmp_path, name: str) -> None:
    """Where it began a formula, the picture would be that of another name, or none at all."""
    person, label = Person(name, 2.6, 2.0, 0.0), f"{name}\n{name}"
    place = Scene(
        Room.rectangle(4.0, 3.0),
        RobotBody(0.6, 0.6),
        (person,),
        furniture=(Furniture.box(f"{name} table", 1.0, 2.4, width_m=0.6, depth_m=0.4),),
        locations=(Location(name, 3.4, 0.8),),
    )
    world = World(place)
    world.robot.perform(ActGoal("say", name, f"Hello, {name}."))
    world.run(0.3)
    ring = Ring(name, 0.6, 0.6, label=label)
    for path, draw in ((tmp_path / "a.png", draw_picture), (tmp_path / "a.gif", write_gif)):
        draw(path, place, world.frames, rings=[ring], events=world.events, title=name)
        assert path.stat().st_size > 1_000
    assert draw_map(place, title=name, subtitle=name)
    with lettering():
        text = Text(0.0, 0.0, name)
    assert not text.get_parse_math()


def test_names_in_any_script_are_drawn_without_a_word_of_complaint(tmp_path, recwarn) -> None:
    name = "É λ 王 \U0001f600"
    place = Scene(Room.rectangle(4.0, 3.0), RobotBody(0.6, 0.6), (Person(name, 2.6, 2.0, 0.0),))
    frames = World(place).frames
    draw_picture(tmp_path / "a.png", place, frames, rings=[Ring(name, 0.6)], title=name)
    write_gif(tmp_path / "a.gif", place, frames, rings=[Ring(name, 0.6)], title=name)
    assert [str(warning.message) for warning in recwarn] == []


@pytest.mark.parametrize(
    ("x_m", "told"),
    [(2.0, "never nearer than 0.55 m to anyone"), (1.4, "touched guest at t=1.00 s")],
)
def test_the_heading_says_how_near_the_robot_came_and_whom_it_touched(x_m: float, told: str) -> None:
    robot = [[0.6, 2.0, 0.0], [1.0, 2.0, 0.0], [0.8, 2.0, 0.0]]
    person = [[x_m, 2.0, 0.0]] * 3
    frames = Frames(("robot", "guest"), (0.25, 0.2), np.arange(3.0), np.array([robot, person]).swapaxes(0, 1))
    assert _facts(frames).endswith(f"travelled, {told}")


def test_the_card_of_somebody_who_walks_says_how_the_robot_stood_when_it_was_there() -> None:
    """The person stands where they started at first, walks, and goes on turning after the visit."""
    guest = Person("guest", 1.0, 2.0, 0.0)
    place = Scene(Room.rectangle(8.0, 4.0), RobotBody(0.6, 0.6), (guest,))
    robot = [[2.0, 2.0, 0.0], [6.2, 2.0, math.pi], [6.2, 2.0, math.pi]]
    person = [[1.0, 2.0, 0.0], [5.0, 2.0, 0.0], [5.0, 3.0, 2.0]]
    frames = Frames(("robot", "guest"), (0.25, 0.2), np.arange(3.0), np.array([robot, person]).swapaxes(0, 1))
    (card,) = cards(place, frames, [Ring("guest", 0.75, 0.75, bearing_deg=0.0, time_s=1.0)], ())
    assert card.notes[-1] == "bearing error 0.0°, facing error 0.0°"
    sensed = Ring("guest", 0.75, 0.75, time_s=1.0, reached_bearing_deg=3.0, facing_error_deg=2.0)
    (card,) = cards(place, frames, [sensed], ())
    assert card.notes[-1] == "bearing error 3.0°, facing error 2.0°"


def test_the_ways_of_those_who_walk_and_the_space_of_a_group_are_drawn(tmp_path) -> None:
    """Each picture is that without it, with something more where it belongs, and in the legend."""
    omar = Person("omar", 1.0, 3.0, 0.0)
    people = (Person("ann", 3.6, 1.0, 0.0), Person("ben", 5.4, 1.0, math.pi), omar)
    place = Scene(Room.rectangle(6.0, 4.5), RobotBody(0.6, 0.6), people)
    still, walks = np.zeros((3, 4, 3)), np.zeros((3, 4, 3))
    still[:, 0, :2] = (0.6, 0.6)
    for i, person in enumerate(people, 1):
        still[:, i] = (person.x_m, person.y_m, person.heading_rad)
    walks[:] = still
    walks[:2, 3, 0] = (4.0, 2.5)
    names, radii, times = ("robot", "ann", "ben", "omar"), (0.25, 0.2, 0.2, 0.2), np.arange(3.0)
    group = replace(place, groups=(Group("talk", ("ann", "ben")),))
    shots = {}
    for name, scene, poses in (("still", place, still), ("walk", place, walks), ("group", group, still)):
        path = tmp_path / f"{name}.png"
        draw_picture(path, scene, Frames(names, radii, times, poses), subtitle="")
        with Image.open(path) as image:
            shots[name] = np.asarray(image.convert("L"), dtype=int)
    for name, at in (("walk", (0.30, 0.38)), ("group", (0.51, 0.72))):
        differs = np.abs(shots[name] - shots["still"]) > 5
        assert differs[:, 850:].sum() > 300, "a row of the legend"
        rows, columns = np.nonzero(differs[:, :850])
        assert len(rows) > 300
        assert columns.mean() / 1200 == pytest.approx(at[0], abs=0.12), name
        assert rows.mean() / len(shots["still"]) == pytest.approx(at[1], abs=0.12), name
    assert draw_map(group) != draw_map(place)


def test_furniture_and_walls_stand_on_the_space_of_a_group(tmp_path) -> None:
    """Where there is some without the group, the same is there with it; the space is on the floor around."""
    people = (Person("ann", 1.2, 1.0, -0.3), Person("ben", 3.6, 1.0, math.pi + 0.3))
    place = Scene(
        Room.rectangle(4.8, 3.0),
        RobotBody(0.5, 2.5),
        people,
        walls=(Wall((2.0, 0.0), (2.0, 0.9)),),
        furniture=(Furniture.box("table", 2.6, 0.8, width_m=0.6, depth_m=0.6),),
    )
    group = replace(place, groups=(Group("talk", ("ann", "ben")),))
    assert group.o_spaces[0].y_m < group.o_spaces[0].radius_m, "it reaches to the outer wall"

    def pixels(scene: Scene, draw: Callable[[Path, Scene, Frames], None]) -> NDArray[np.int64]:
        path = tmp_path / ("a.gif" if draw is write_gif else "a.png")
        draw(path, scene, World(scene).frames)
        with Image.open(path) as image:
            return np.asarray(image.convert("RGB"), dtype=int)

    def draw_start(path: Path, scene: Scene, _: Frames) -> None:
        path.write_bytes(draw_map(scene))

    for draw in (draw_start, draw_picture, write_gif):
        alone, together = pixels(place, draw)[:, :850], pixels(group, draw)[:, :850]
        assert np.abs(together - alone).max(axis=2).sum() > 10_000
        for colour in (FURNITURE, WALL):
            solid = np.abs(alone - tuple(bytes.fromhex(colour[1:]))).max(axis=2) <= 4
            assert solid.sum() > 500
            differs = np.abs(together - alone)[solid].max(axis=1) > 8
            assert differs.mean() < 0.001, "but for a dot that another palette makes of a letter's edge"


def talking() -> Scene:
    """Two who talk, and a third one in their group."""
    people = (
        Person("ann", 3.6, 1.6, 0.0),
        Person("ben", 5.4, 1.6, math.pi),
        Person("cem", 4.5, 2.5, -math.pi / 2),
    )
    return Scene(
        Room.rectangle(6.0, 4.5),
        RobotBody(0.6, 0.6),
        people,
        groups=(Group("talk", ("ann", "ben", "cem")),),
    )


def test_the_space_of_a_group_is_drawn_while_the_group_holds(tmp_path) -> None:
    """All three at first, two of them then, and nobody at the end: the last picture knows no group."""
    scene, alone = talking(), replace(talking(), groups=())
    world, first = World(scene), scene.person("cem")
    world.run(0.5)
    world.move_person("cem", 4.5, 3.8, first.heading_rad)
    world.run(0.5)
    world.move_person("ben", 5.4, 3.8, 0.0)
    world.run(0.5)
    frames = world.frames
    for place in (scene, alone):
        draw_picture(tmp_path / f"{len(place.groups)}.png", place, frames)
        write_gif(tmp_path / f"{len(place.groups)}.gif", place, frames)
    assert (tmp_path / "0.png").read_bytes() == (tmp_path / "1.png").read_bytes()
    with Image.open(tmp_path / "1.gif") as group, Image.open(tmp_path / "0.gif") as nobody:
        differ = [_unlike(_shot(group, i), _shot(nobody, i), 12) for i in (3, 8, group.n_frames - 1)]
    of_three, of_two, of_none = differ
    assert of_three > 2_000
    assert of_two > 2_000
    assert of_none < of_three / 20, "but for the palette"


@given(st.lists(st.tuples(st.integers(0, 2), st.floats(0.5, 5.5), st.floats(0.5, 4.0)), max_size=4))
@settings(max_examples=25, deadline=None)
def test_the_space_that_is_drawn_is_the_one_that_the_robot_goes_round(moves) -> None:
    scene, spaces = talking(), list[tuple[OSpace, ...]]()
    world = World(scene)
    for i, x, y in [(0, 3.6, 1.6), *moves]:
        world.move_person(scene.people[i].name, x, y, 0.0)
        world.step()
        around = Surroundings.of(scene).with_people(world.people)
        spaces.append(tuple(space for space in around.o_spaces if space.radius_m > 0.0))
    frames = world.frames
    assert [o_spaces_at(scene, frames, time_s) for time_s in frames.time_s[1:].tolist()] == spaces
    assert o_spaces_at(scene, frames) == spaces[-1]


def test_an_animation_tells_the_outcome_at_its_end_and_names_those_who_move(tmp_path, episode: World) -> None:
    poses = np.array(episode.frames.poses[:40])
    poses[:, 2, 0] += np.linspace(0.0, -1.0, 40)  # omar walks
    frames = Frames(episode.frames.entities, episode.frames.radius_m, episode.frames.time_s[:40], poses)
    shots = {}
    for ending in ("A visit", "A visit: success"):
        path = tmp_path / f"{len(ending)}.gif"
        write_gif(path, SCENE, frames, title="A visit", ending=ending)
        with Image.open(path) as image:
            shots[ending] = [_shot(image, i) for i in (0, 5, image.n_frames - 1)]
    first, middle, last = (_unlike(*pair) for pair in zip(*shots.values(), strict=True))
    assert first < 20
    assert middle < 20
    assert last > 100
    write_gif(tmp_path / "o.gif", _renamed("o"), _renamed_frames(frames, "o"), title="A visit")
    with Image.open(tmp_path / "o.gif") as image:
        assert _unlike(_shot(image, 5), shots["A visit"][1]) > 30


def _renamed(name: str) -> Scene:
    johanna, omar = SCENE.people
    return replace(SCENE, people=(johanna, replace(omar, name=name)))


def _renamed_frames(frames: Frames, name: str) -> Frames:
    return replace(frames, entities=(*frames.entities[:2], name))


def _shot(image: Image.Image, i: int) -> Image.Image:
    image.seek(i)
    return image.convert("RGB")


def test_a_headline_is_cut_to_the_width_of_its_picture(tmp_path) -> None:
    """What would run over the edge makes no difference."""
    frames = World(SCENE).frames
    for draw, kind in ((draw_picture, "png"), (write_gif, "gif")):
        one, other = tmp_path / f"150.{kind}", tmp_path / f"190.{kind}"
        for path in (one, other):
            draw(path, SCENE, frames, title="n" * int(path.stem))
        assert one.read_bytes() == other.read_bytes()
    assert draw_map(SCENE, title="n" * 150) == draw_map(SCENE, title="n" * 190)


def test_a_picture_needs_no_visits(tmp_path) -> None:
    draw_picture(tmp_path / "a.png", SCENE, World(SCENE).frames)
    assert (tmp_path / "a.png").stat().st_size > 5_000


def test_an_animation_shows_the_robot_on_its_way(tmp_path, episode: World) -> None:
    path = tmp_path / "a.gif"
    write_gif(path, SCENE, episode.frames, rings=rings(), events=episode.events, title="A visit")
    with Image.open(path) as image:
        assert image.n_frames > 50
        total_ms, first = 0, np.asarray(image.convert("L"), dtype=int)
        for i in range(image.n_frames):
            image.seek(i)
            total_ms += image.info["duration"]
        assert np.abs(np.asarray(image.convert("L"), dtype=int) - first).max() > 100
    assert total_ms / 1000 == pytest.approx(episode.time_s + 2.5, abs=0.5)
    assert path.stat().st_size < 1_000_000


def test_an_animation_is_the_same_every_time(tmp_path, episode: World) -> None:
    frames = episode.frames
    short = Frames(frames.entities, frames.radius_m, frames.time_s[:60], frames.poses[:60])
    for name in ("a.gif", "b.gif"):
        write_gif(tmp_path / name, SCENE, short, rings=rings(), events=episode.events)
    assert (tmp_path / "a.gif").read_bytes() == (tmp_path / "b.gif").read_bytes()


def on_a_map(scene: Scene) -> tuple[Axes, Patch, MapLabels]:
    """The floor, to draw on, and the labels."""
    figure = Figure(figsize=(7.2, 5.4), dpi=100)
    ax, canvas = figure.add_axes((0.0, 0.0, 1.0, 1.0)), FigureCanvasAgg(figure)
    return ax, draw_place(ax, scene), MapLabels(ax, canvas)


COLOURS = person_colours([person.name for person in SCENE.people])


def reached_lines(frames: Frames, visits: list[Ring], events) -> ReachedLines:
    return ReachedLines(on_a_map(SCENE)[0], SCENE, frames, visits, events=events, colours=COLOURS)


@settings(max_examples=20, deadline=None)
@given(st.floats(0.5, 5.0), st.floats(0.5, 4.0), st.integers(0, 2))
def test_the_wanted_distance_goes_with_somebody_who_moves(x: float, y: float, i: int) -> None:
    poses = np.zeros((3, 3, 3))
    poses[:, 0, :2], poses[:, 1, :2], poses[:, 2, :2] = (0.6, 0.6), (4.6, 3.0), (4.0, 0.8)
    poses[i, 1, :2] = (x, y)
    frames = Frames(("robot", "johanna", "omar"), (0.25, 0.2, 0.2), np.arange(3.0), poses)
    ax, floor, _ = on_a_map(SCENE)
    shown = MovingRings(ax, floor, frames, [(SCENE.person("johanna"), 0.64, COLOURS["johanna"])])
    (ring,) = shown.at(float(i))
    box = ring.get_extents().transformed(ax.transData.inverted())
    assert ((box.x0 + box.x1) / 2, (box.y0 + box.y1) / 2) == pytest.approx((x, y), abs=1e-6)
    assert box.width / 2 == pytest.approx(0.2 + 0.64, abs=1e-6)


def test_the_reached_distance_is_drawn_while_the_robot_is_with_somebody(episode: World) -> None:
    """From the docking on, between the two bodies as they are; at the end of the last visit it stays."""
    docked_s = episode.events[0].t_start
    visit = Ring("johanna", 0.64, 0.641, time_s=docked_s)
    shown = reached_lines(episode.frames, [visit, *rings()[1:]], episode.events)
    assert shown.at(docked_s - 0.1) == []
    for time_s in (docked_s, episode.time_s):
        (line,) = shown.at(time_s)
        assert math.dist(*line.get_xydata()) == pytest.approx(0.64, abs=0.01)
    earlier = reached_lines(episode.frames, [replace(visit, time_s=1.0), visit], episode.events[:0])
    assert len(earlier.at(episode.time_s)) == 1


def test_what_is_said_and_done_at_once_is_in_one_bubble(episode: World) -> None:
    said = replace(episode.events[0], t_start=1.0, t_end=3.0)
    nods = replace(said, act="nod", text=None, t_start=2.0, t_end=4.0)
    labels = on_a_map(SCENE)[2]
    shown = Speech(labels, SCENE, episode.frames, (said, nods), COLOURS)

    def words(time_s: float) -> list[str]:
        return [part.get_text() for part in shown.at(time_s) if isinstance(part, Text)]

    assert words(0.5) == []
    assert words(1.5) == [said.words]
    assert words(2.5) == [f"{said.words}\n{nods.words}"]
    assert words(3.5) == [nods.words]
    assert words(4.0) == []


def test_what_is_said_and_done_is_told_where_the_robot_was(episode: World) -> None:
    """In a picture: once where it is repeated at once, apart where it was far apart, nothing broken off."""
    said = episode.events[0]
    early = replace(said, t_start=0.0, t_end=0.5)
    nods = replace(said, act="nod", text=None, t_start=said.t_start + 0.2)
    asks = replace(early, act="ask_to_pass", person="omar", text="May I pass?")
    broken = replace(said, text="Goodbye.", t_start=said.t_start + 0.4, stopped=True)
    found = sayings(episode.frames, SCENE.robot.name, (said, said, nods, broken, early, asks))
    assert [(each.person, each.words) for each in found] == [
        ("johanna", (early.words,)),
        ("omar", (asks.words,)),
        ("johanna", (said.words, nods.words)),
    ]
    assert found[0].xy == found[1].xy == pytest.approx(SCENE.robot.pose.xy)
    assert math.dist(found[2].xy, found[0].xy) > 1.0


def test_a_bubble_has_so_many_lines_at_most(episode: World) -> None:
    deeds = [f"“Word {i}.”" for i in range(MOST_LINES + 1)]
    _, _, labels = on_a_map(SCENE)
    for told, last in ((deeds, "…"), (deeds[:-1], deeds[-2])):
        *_, text = labels.bubble((2.0, 2.0), 0.25, told, "#000000")
        assert isinstance(text, Text)
        lines = text.get_text().splitlines()
        assert (len(lines), lines[-1]) == (MOST_LINES, last)


def test_a_picture_has_a_bubble_for_who_was_only_asked_to_make_way(tmp_path, episode: World) -> None:
    asks = replace(episode.events[0], act="ask_to_pass", person="omar", t_start=0.0, t_end=0.5)
    for name, events in (("with.png", (*episode.events, asks)), ("without.png", episode.events)):
        draw_picture(
            tmp_path / name, SCENE, episode.frames, rings=rings()[:1], events=events, title="A visit"
        )
    assert (tmp_path / "with.png").read_bytes() != (tmp_path / "without.png").read_bytes()


def labelled(place: PlaceMap) -> Axes:
    """A map with the names of what is on it."""
    figure = Figure(figsize=(18.0, 9.0), dpi=100)
    ax, canvas = figure.add_axes((0.0, 0.0, 1.0, 1.0)), FigureCanvasAgg(figure)
    draw_place(ax, place)
    MapLabels(ax, canvas).place(place)
    return ax


def test_names_that_do_not_fit_into_their_furniture_are_beside_it_where_they_are_few() -> None:
    """Also on a map with much furniture; where they are many, they would hide the rest."""

    def names(place: PlaceMap) -> set[str]:
        return {label.get_text() for label in labelled(place).texts}

    ward = load_map("ward")
    assert len(ward.furniture) > 30
    assert {"wheelchair", "trolley"} <= names(ward)
    chairs = tuple(
        Furniture.box(f"wheelchair {i}", 1.0 + i / 4, 6.0, width_m=0.2, depth_m=0.2) for i in range(40)
    )
    assert not any("wheelchair" in name for name in names(replace(ward, furniture=chairs)))


@pytest.mark.parametrize("name", shipped_maps())
def test_the_name_of_a_room_stands_in_it_and_on_no_furniture(name: str) -> None:
    place = load_map(name)
    ax = labelled(place)
    boxes = {label.get_text(): label.get_window_extent() for label in ax.texts}
    for area in place.areas if len(place.areas) > 1 else ():
        label = boxes[area.name.upper()]
        corners = ax.transData.inverted().transform(label.corners())
        assert Polygon(area.corners).contains(MultiPoint(corners).convex_hull)
        for piece in place.furniture:
            outline = Polygon(ax.transData.transform(piece.corners))
            assert not outline.intersects(box(*label.extents)), (area.name, piece.name)


def test_a_picture_of_a_scene_shows_passers_by_and_the_ways_of_those_who_walk() -> None:
    still = Scene(Room.rectangle(6, 4), RobotBody(0.5, 0.5), (Person("w", 1.0, 3.0, 0.0),))
    walker = replace(still.people[0], walk=Walk(((5.0, 3.0),)))
    passed = replace(still, passers_by=PassersBy(3))
    pictures = {draw_map(still), draw_map(replace(still, people=(walker,))), draw_map(passed)}
    assert len(pictures | {draw_map(passed, seed=1)}) == 4
    assert draw_map(passed) == draw_map(passed)


@pytest.mark.parametrize("width_m", [2.0, 20.0])
def test_a_description_stands_in_lines_as_long_as_the_page_is_wide(width_m: float) -> None:
    """A narrow map has a narrow page, and more lines; nothing is cut that eight lines hold."""
    place = PlaceMap("hall", Room.rectangle(width_m, 12.0))
    told = " ".join(f"word{i}" for i in range(50))
    drawn = draw_map(place, subtitle=told, format="svg").decode()
    lines = [line for line in re.findall(r">([^<>]+)</text>", drawn) if line.startswith("word")]
    assert " ".join(lines) == told


@pytest.mark.parametrize("height_m", [20.0, 40.0])
def test_the_page_of_a_tall_map_is_hardly_wider_than_the_map(height_m: float) -> None:
    """As wide as a text above it needs, and what is beside the map is for names that are wider."""
    corridor = PlaceMap("c", Room.rectangle(2.0, height_m), locations=(Location("a door " * 5, 1.0, 9.0),))
    drawn = draw_map(corridor, format="svg").decode()
    width, height = map(float, re.search(r'viewBox="0 0 ([\d.]+) ([\d.]+)"', drawn).groups())
    assert width < 4.0 * 72
    assert height > 18.0 * 72
    clip = re.search(r'<clipPath id="\w+">\s*<rect x="([\d.]+)" y="[\d.]+" width="([\d.]+)"', drawn)
    assert float(clip[2]) == pytest.approx(width - 2 * float(clip[1]))


def test_a_description_is_cut_where_it_is_endless() -> None:
    """A page of words is not measured letter by letter."""
    assert draw_map(SCENE, subtitle="n" * 5_000) == draw_map(SCENE, subtitle="n" * 500_000)
    assert draw_map(SCENE, subtitle="two\nlines") == draw_map(SCENE, subtitle="two lines")


@given(st.floats(0.0, 1.0), st.floats(0.0, 1.0), st.sampled_from([(200.0, 900.0), (900.0, 150.0)]))
@example(0.95, 0.5, (200.0, 900.0))
def test_a_label_lies_on_no_wall_of_a_narrow_room(across: float, along: float, room: XY) -> None:
    """There is place for it in the room, above or below what it names, and beside the room."""
    wide, high = room
    inside = Box(200.0, 200.0, 200.0 + wide, 200.0 + high)
    page = Page(Box(0.0, 0.0, wide + 400.0, high + 400.0), [], [], room=inside.grown(-7.0))
    xs, ys = np.arange(200.0, 201.0 + wide, 12.0).tolist(), np.arange(200.0, 201.0 + high, 12.0).tolist()
    edges = [(x, y) for x in (inside.left, inside.right) for y in ys]
    edges += [(x, y) for y in (inside.bottom, inside.top) for x in xs]
    page.lines += [Box.around(at, 6.0, 6.0) for at in edges]
    anchor = (inside.left + 20.0 + across * (wide - 40.0), inside.bottom + 20.0 + along * (high - 40.0))
    label = page.place(anchor, 12.0, (160.0, 36.0), prefer_rad=0.0)
    assert not any(label.overlap(line) for line in page.lines)


@pytest.mark.parametrize(("x", "y"), [(1.2, 1.0), (3.0, 2.0), (5.5, 4.0), (5.8, 0.4)])
def test_labels_have_the_same_places_at_every_resolution(x: float, y: float) -> None:
    """PNG has pixels of any size, and SVG and PDF have points."""
    places = []
    for dpi in (72, 200):
        figure = Figure(figsize=(6.0, 4.5), dpi=dpi)
        canvas, ax = FigureCanvasAgg(figure), figure.add_axes((0, 0, 1, 1))
        labels = MapLabels(ax, canvas)
        draw_place(ax, SCENE)
        labels.avoid_walls(SCENE)
        places.append(labels.near((x, y), 0.2, "name", size=10, colour=WALL, prefer_rad=0.4).get_position())
    assert places[0] == pytest.approx(places[1], abs=4.0), "letters are hinted to whole pixels"


def test_doors_are_shown_as_they_are_at_the_time(tmp_path) -> None:
    """A door that is shut in the middle of an animation is drawn open before, and shut from then on."""

    def place(*, is_open: bool) -> Scene:
        door = Door("way out", (3.0, 1.0), (3.0, 2.0), is_open)
        walls = (Wall((3.0, 0.0), (3.0, 0.95)), Wall((3.0, 2.05), (3.0, 4.0)))
        return Scene(Room.rectangle(6.0, 4.0), RobotBody(0.6, 0.6), walls=walls, doors=(door,))

    def shots(scene: Scene, world: World) -> list[Image.Image]:
        write_gif(tmp_path / "a.gif", scene, world.frames, door_turns=world.door_turns)
        with Image.open(tmp_path / "a.gif") as image:
            doorway = (200, 100, 500, 400)
            return [_shot(image, i).crop(doorway) for i in (0, image.n_frames - 1)]

    worlds = {state: World(place(is_open=state)) for state in (True, False)}
    for state, world in worlds.items():
        world.run(0.5)
        if state:
            world.set_door("way out", open=False)
        world.run(0.5)
    (before, after), (shut, _) = (shots(world.scene, world) for world in worlds.values())
    assert _unlike(before, after) > 500
    assert _unlike(after, shut) < 50  # the palettes differ a little
    draw_picture(
        tmp_path / "turned.png", worlds[True].scene, worlds[True].frames, door_turns=worlds[True].door_turns
    )
    draw_picture(tmp_path / "shut.png", worlds[False].scene, worlds[False].frames)
    assert (tmp_path / "turned.png").read_bytes() == (tmp_path / "shut.png").read_bytes()


def _unlike(one: Image.Image, other: Image.Image, by: int = 40) -> int:
    """How many pixels look different."""
    gap = np.abs(np.asarray(one, dtype=int) - np.asarray(other, dtype=int)).max(axis=2)
    return int((gap > by).sum())


def test_labels_do_not_overlap_even_where_many_share_a_place() -> None:
    page = Page(Box(0.0, 0.0, 800.0, 600.0), [], [])
    boxes = [page.place((400.0, 300.0), 20.0, (120.0, 30.0)) for _ in range(12)]
    assert all(one.overlap(other) == 0.0 for one, other in combinations(boxes, 2))
    assert all(lies_on(page, box) for box in boxes)


def lies_on(page: Page, box: Box) -> bool:
    return box.overlap(page.area) == pytest.approx((box.right - box.left) * (box.top - box.bottom))


def covers(box: Box, body: Disc) -> bool:
    return math.dist(box.nearest(body[0]), body[0]) < body[1]


@given(st.tuples(st.floats(0.0, 1.0), st.floats(0.0, 1.0)), st.integers(0, 60))
def test_a_label_is_whole_on_the_page_whatever_it_covers(at: tuple[float, float], walls: int) -> None:
    page = Page(Box(0.0, 0.0, 330.0, 900.0), [], [])
    page.lines += [Box.around((165.0 + 60.0 * (k % 2), 15.0 * k), 6.0, 6.0) for k in range(walls)]
    assert lies_on(page, page.place((at[0] * 330.0, at[1] * 900.0), 8.0, (220.0, 100.0), math.pi))


@given(st.lists(st.tuples(st.floats(0.0, 800.0), st.floats(0.0, 600.0)), max_size=30))
@example([(400.0, 350.0)])
def test_a_label_hides_no_body_where_it_has_another_place(bodies: list[XY]) -> None:
    page = Page(Box(0.0, 0.0, 800.0, 600.0), [], [], bodies=[(at, 12.0) for at in bodies])
    tries = [box.moved_into(page.area) for box, *_ in page._candidates((400.0, 300.0), 12.0, (200.0, 36.0))]
    label = page.place((400.0, 300.0), 12.0, (200.0, 36.0), prefer_rad=math.pi / 2)
    assert sum(covers(label, body) for body in page.bodies) == min(
        sum(covers(box, body) for body in page.bodies) for box in tries
    )


def test_a_line_leads_to_a_name_that_has_no_place_near_its_person() -> None:
    person = SCENE.people[0]

    def leaders(taken_m: float) -> int:
        ax, _, labels = on_a_map(SCENE)
        x, y = labels._at(person.xy)
        labels._page.labels.append(Box.around((x, y), *[2.0 * labels._px(taken_m)] * 2))
        labels.name(person.name, person.pose, person.radius_m, "#000000")
        return len(ax.lines)

    assert (leaders(0.3), leaders(1.6)) == (0, 1)


@pytest.mark.parametrize("size", [(60.0, 3.0), (3.0, 60.0)])
def test_names_hide_no_passer_by_in_a_long_corridor(size: XY) -> None:
    """Passers-by show as many pixels with twelve long names as with short ones."""
    wide, high = size
    spots = [(8.0 + 4.0 * k, 2.0) if wide > high else (2.0, 8.0 + 4.0 * k) for k in range(12)]

    def seen(called: str) -> int:
        people = tuple(Person(called.format(k), x, y, -math.pi / 2) for k, (x, y) in enumerate(spots))
        scene = Scene(Room.rectangle(wide, high), RobotBody(1.0, 1.0), people, passers_by=PassersBy(15))
        with Image.open(BytesIO(draw_map(scene, title="a corridor"))) as image:
            return int((np.asarray(image.convert("RGB")) == (0xB9, 0xBD, 0xC4)).all(axis=2).sum())

    assert seen("person number {} with a long name") == seen("{}")


@given(st.integers(0, 20), st.integers(0, 60), st.integers(-15, 15))
@example(0, 40, 0)
def test_a_bubble_keeps_off_a_label_where_it_has_room_elsewhere(left: int, marks: int, up: int) -> None:
    """Bodies and lines are everywhere; they are better covered than a word is crowded."""
    label = Box.around((300.0 + left, 300.0 + up), 130.0, 40.0)
    lines = [Box.around((20.0 * k % 800.0, 290.0 + 7.0 * (k % 9)), 30.0, 30.0) for k in range(marks)]
    page = Page(Box(0.0, 0.0, 800.0, 600.0), [label], lines)
    bubble = page.place((400.0, 270.0), 36.0, (175.0, 50.0), math.pi / 2)
    assert bubble.grown(APART_PX).overlap(label) == 0.0


@given(
    st.tuples(st.integers(150, 900), st.integers(120, 900)),
    st.tuples(st.floats(0.0, 1.0), st.floats(0.0, 1.0)),
    st.lists(
        st.tuples(st.tuples(st.floats(0.0, 900.0), st.floats(0.0, 900.0)), st.floats(5.0, 60.0)), max_size=9
    ),
)
@example((150, 900), (0.5, 0.5), [])
def test_a_bubble_lies_on_the_page_and_hides_nobody_where_it_has_room(
    size: tuple[int, int], at: tuple[float, float], bodies: list[tuple[tuple[float, float], float]]
) -> None:
    page, wanted = Page(Box(0.0, 0.0, *size), [], []), (140.0, 90.0)
    anchor = (at[0] * size[0], at[1] * size[1])
    tries = [box.moved_into(page.area) for box, *_ in page._candidates(anchor, 30.0, wanted)]
    bubble = page.place(anchor, 30.0, wanted, math.pi / 2, keep_off=bodies)
    assert lies_on(page, bubble)
    assert sum(covers(bubble, body) for body in bodies) == min(
        sum(covers(box, body) for body in bodies) for box in tries
    )


def test_the_tail_of_a_bubble_crosses_nobody_where_it_has_another_place() -> None:
    """The robot is below a person: the place above both is free, and its tail would lie over the person."""
    page, person = Page(Box(0.0, 0.0, 600.0, 600.0), [], []), ((300.0, 300.0), 20.0)
    page.labels += [Box(0.0, 0.0, 600.0, 190.0), Box(0.0, 200.0, 200.0, 330.0)]
    bubble = page.place(
        (300.0, 220.0), 30.0, (120.0, 40.0), math.pi / 2, keep_off=[((300.0, 220.0), 20.0), person]
    )
    assert not LineString([bubble.centre, (300.0, 220.0)]).intersects(Point(person[0]).buffer(person[1]))


@given(st.floats(0.0, 2.0 * math.pi), st.floats(60.0, 110.0))
@example(math.pi / 2, 70.0)
def test_the_tail_of_a_bubble_crosses_no_label_on_a_large_page(angle: float, away_px: float) -> None:
    """Such as the distance to the addressee, which is written between them."""
    anchor = (300.0, 300.0)
    number = Box.around(
        (anchor[0] + away_px * math.cos(angle), anchor[1] + away_px * math.sin(angle)), 110.0, 28.0
    )
    page = Page(Box(0.0, 0.0, 600.0, 600.0), [number], [])
    bubble = page.place(anchor, 30.0, (120.0, 40.0), math.pi / 2, keep_off=[(anchor, 20.0)])
    tail = LineString([bubble.centre, anchor])
    assert tail.intersection(box(number.left, number.bottom, number.right, number.top)).length < APART_PX


def test_a_large_bubble_moves_off_a_small_body_that_a_label_would_cover_lightly() -> None:
    page = Page(Box(0.0, 0.0, 800.0, 600.0), [], [Box.around((400.0, 370.0), 20.0, 20.0)])
    wanted, body = (200.0, 90.0), ((400.0, 370.0), 10.0)
    assert covers(page.place((400.0, 300.0), 30.0, wanted, math.pi / 2), body)
    page.labels.clear()
    assert not covers(page.place((400.0, 300.0), 30.0, wanted, math.pi / 2, keep_off=[body]), body)


NARROW = Scene(
    Room.rectangle(2.0, 12.0),
    RobotBody(1.0, 4.8, math.pi / 2),
    (Person("johanna", 1.0, 6.0, -math.pi / 2), Person("omar", 0.3, 5.3, 0.0)),
)
ASKS = ActEvent(0.0, 2.0, "say", "johanna", "Excuse me, would you please be so kind as to let me pass?")
"""In bubbles of several lines."""


@pytest.mark.parametrize("room", [(2.0, 12.0), (12.0, 2.0), (3.0, 3.0), (1.2, 9.0)])
def test_what_is_said_in_a_narrow_room_is_on_the_picture_and_hides_nobody(room: tuple[float, float]) -> None:
    """At walls and in corners: the bubble's box is drawn whole, and beside everybody's body."""
    wide, high = room
    robot, guest = (0.3, 0.3), (wide - 0.25, 0.9 if high > wide else high - 0.25)
    people = (Person("johanna", *guest, math.pi), Person("omar", 0.25, high - 0.25, 0.0))
    scene = Scene(Room.rectangle(wide, high), RobotBody(*robot), people)
    canvas, ax = _canvas(scene, 720)
    draw_place(ax, scene, beside_m(scene))
    (span,) = Speech(MapLabels(ax, canvas), scene, World(scene).frames, [ASKS], {"johanna": "#000000"})._spans
    (body,) = (part for part in span[2] if isinstance(part, FancyBboxPatch))
    drawn, page = body.get_window_extent(), ax.get_window_extent()
    assert page.x0 <= drawn.x0
    assert drawn.x1 <= page.x1
    assert page.y0 <= drawn.y0
    assert drawn.y1 <= page.y1
    bubble = Box(drawn.x0, drawn.y0, drawn.x1, drawn.y1)
    for person in people:
        x, y = ax.transData.transform(person.xy).tolist()
        rim = ax.transData.transform((person.x_m + person.radius_m, person.y_m))[0] - x
        assert not covers(bubble, ((x, y), rim))


def test_the_animation_of_a_tall_narrow_room_has_place_for_headline_and_bubble(tmp_path) -> None:
    frames = World(NARROW).frames
    write_gif(tmp_path / "narrow.gif", NARROW, frames, events=[ASKS], title="a headline")
    write_gif(tmp_path / "square.gif", SCENE, World(SCENE).frames)
    with Image.open(tmp_path / "narrow.gif") as narrow, Image.open(tmp_path / "square.gif") as square:
        assert narrow.size[0] >= 320
        assert narrow.size[0] >= 0.45 * narrow.size[1]
        assert square.size[0] == 720


def test_the_animation_of_a_corridor_has_place_for_names_above_and_below_it(tmp_path) -> None:
    corridor = Scene(Room.rectangle(60.0, 3.0), RobotBody(1.0, 1.0), (Person("johanna", 8.0, 2.0, 0.0),))
    write_gif(tmp_path / "flat.gif", corridor, World(corridor).frames)
    with Image.open(tmp_path / "flat.gif") as flat:
        assert flat.size[0] == 720
        assert flat.size[1] >= 0.3 * 700


def test_the_name_of_a_room_is_not_written_over_a_passer_by(tmp_path) -> None:
    """Who stands in the middle of a room shows as many pixels with the room's name as without."""
    halls = (Area("left", ((0, 0), (4, 0), (4, 4), (0, 4))), Area("right", ((4, 0), (8, 0), (8, 4), (4, 4))))
    scene = Scene(Room.rectangle(8.0, 4.0), RobotBody(4.0, 0.5), passers_by=PassersBy(1), areas=halls)
    poses = np.array([[[4.0, 0.5, 0.0], [2.0, 2.0, 0.0]]])
    frames = Frames(("robot", "passer-by 1"), (0.25, 0.2), np.zeros(1), poses)

    def seen(name: str, shown: Scene) -> int:
        draw_picture(tmp_path / name, shown, frames, title="a hall")
        with Image.open(tmp_path / name) as image:
            return int((np.asarray(image.convert("RGB")) == (0xB9, 0xBD, 0xC4)).all(axis=2).sum())

    whole = seen("bare.png", replace(scene, areas=()))
    assert whole > 100
    assert seen("named.png", scene) == whole


def test_names_keep_off_passers_by_where_a_scene_is_drawn_at_its_start() -> None:
    """As above, of the plan of a scene: some start in the middle of a room, by the seed."""
    halls = (Area("left", ((0, 0), (2, 0), (2, 2), (0, 2))), Area("right", ((2, 0), (4, 0), (4, 2), (2, 2))))
    scene = Scene(Room.rectangle(4.0, 2.0), RobotBody(2.0, 0.3), passers_by=PassersBy(2), areas=halls)

    def seen(shown: Scene, seed: int) -> int:
        with Image.open(BytesIO(draw_map(shown, title="a hall", seed=seed))) as image:
            return int((np.asarray(image.convert("RGB")) == (0xB9, 0xBD, 0xC4)).all(axis=2).sum())

    bare = replace(scene, areas=())
    for seed in range(6):
        assert seen(scene, seed) == seen(bare, seed)


@given(st.integers(1, 200))
def test_no_two_people_have_the_same_colour(count: int) -> None:
    names = [f"p{i}" for i in range(count)]
    assert len(set(person_colours(names).values())) == count


UNWRITTEN = "\U00012000"
"""Of cuneiform, which no font that comes with matplotlib has."""


@pytest.mark.skipif(not lacking(UNWRITTEN), reason="a font for cuneiform is installed")
def test_who_has_a_name_that_no_font_has_is_called_by_number_and_that_is_said_once(tmp_path, caplog) -> None:
    people = (Person("person 2", 4.6, 3.0, 0.0), Person(UNWRITTEN * 2, 4.0, 0.8, 0.0))
    scene = Scene(
        Room.rectangle(6.0, 4.5),
        RobotBody(0.6, 0.6),
        people,
        groups=(Group("two", (UNWRITTEN * 2, "person 2")),),
    )
    world = World(scene)
    world.run(0.2)
    visits = [Ring(UNWRITTEN * 2, 0.6)]
    shown = readable(scene, world.frames, visits)
    assert [person.name for person in shown.scene.people] == ["person 2", "person 2'"]
    assert shown.scene.groups[0].members == ("person 2'", "person 2")
    assert shown.frames.entities == ("robot", "person 2", "person 2'")
    assert [ring.person for ring in shown.rings] == ["person 2'"]
    draw_picture(tmp_path / "a.png", scene, world.frames, rings=visits)
    write_gif(tmp_path / "a.gif", scene, world.frames, rings=visits)
    assert draw_map(scene)
    (said,) = {record.getMessage() for record in caplog.records}
    assert "no font here has" in said
    assert "Noto Sans Cuneiform" in said
    assert len(caplog.records) == 1


@pytest.mark.skipif(not lacking(UNWRITTEN), reason="a font for cuneiform is installed")
def test_furniture_and_who_is_spoken_to_are_called_by_number_where_no_font_has_their_names(tmp_path) -> None:
    anna = UNWRITTEN * 2
    table = Furniture.box(UNWRITTEN, 3.2, 3.9, width_m=1.0, depth_m=0.7)
    low = Furniture.box("furniture 1", 1.5, 3.9, width_m=1.0, depth_m=0.7)
    scene = replace(SCENE, people=(Person(anna, 4.6, 3.0, 0.0),), furniture=(table, low))
    world = World(scene)
    world.robot.perform(ActGoal("say", anna, f"Hello, {anna}: tea."))
    world.run(0.2)
    shown = readable(scene, world.frames, events=world.events)
    assert [piece.name for piece in shown.scene.furniture] == ["furniture 1'", "furniture 1"]
    assert [event.text for event in shown.events] == ["Hello, person 1: tea."]
    assert lacking("".join(shown.words)) == ""
    draw_picture(tmp_path / "a.png", scene, world.frames, events=world.events)
    place = PlaceMap("one", SCENE.room, furniture=(table,))
    numbered = PlaceMap("one", SCENE.room, furniture=(replace(table, name="furniture 1"),))
    assert draw_map(place) == draw_map(numbered)


@given(st.text(max_size=20))
@settings(max_examples=50, deadline=None)
def test_what_is_not_lacking_is_in_one_of_the_fonts(text: str) -> None:
    """Names that can be written stay as they are."""
    person = "anna" + "".join(letter for letter in text if letter.isprintable() and not lacking(letter))
    scene = Scene(Room.rectangle(6.0, 4.5), RobotBody(0.6, 0.6), (Person(person, 4.6, 3.0, 0.0),))
    shown = readable(scene, World(scene).frames)
    assert shown.scene is scene


def test_a_picture_writes_a_number_for_whatever_it_has_no_letters_for(monkeypatch) -> None:
    """The robot, rooms, places and things carried as well as people; a headline leaves such letters out."""
    unknown = "\U0001203d\U00012041"
    place = Scene(
        Room.rectangle(6.0, 4.0),
        RobotBody(1.0, 1.0, name=f"{unknown}o"),
        (Person("ada", 3.0, 2.0, 0.0),),
        areas=(Area(f"{unknown}a", ((0, 0), (6, 0), (6, 4), (0, 4))),),
        locations=(Location(f"{unknown}b", 4.0, 3.0),),
    )
    events = (
        ActEvent(1.0, 2.0, "pick_up", f"{unknown}b", thing=f"{unknown}c"),
        ActEvent(2.0, 3.0, "say", "ada", text=f"ada, here is {unknown}c."),
        ActEvent(3.0, 4.0, "say", "ada", text=f"{unknown} {unknown}, ada"),
    )
    frames, rings = World(place).frames, (Ring("ada", 0.6, label=f"{unknown}a"),)
    shown = readable(place, frames, rings, events)
    assert not any(lacking(words) for words in shown.words)
    assert shown.scene.robot.name == shown.frames.entities[0] == "robot"
    assert [area.name for area in shown.scene.areas] == ["room 1"]
    assert [(event.person, event.thing, event.text) for event in shown.events] == [
        ("place 1", "thing 1", None),
        ("ada", None, "ada, here is thing 1."),
        ("ada", None, "…, ada"),
    ]
    assert legible(f"{unknown}: success", shown.names) == "…: success"
    assert draw_map(place, title=unknown) == draw_map(shown.scene, title="…")


def test_a_long_episode_plays_faster_so_that_its_images_fit_into_memory(tmp_path) -> None:
    frames = World(SCENE).frames
    times = np.arange(0.0, 1200.0, 60.0)
    long = Frames(frames.entities, frames.radius_m, times, np.repeat(frames.poses[:1], len(times), axis=0))
    write_gif(tmp_path / "a.gif", SCENE, long, fps=1)
    with Image.open(tmp_path / "a.gif") as image:
        total_ms = 0
        for i in range(image.n_frames):
            image.seek(i)
            total_ms += image.info["duration"]
    assert total_ms / 1000 == pytest.approx(60.0 + 2.5, abs=1.0)


def test_where_they_were_at_the_docking_lies_below_where_they_are_and_is_in_the_legend() -> None:
    now, then = (robot_artists(Pose(0.0, 0.0, 0.0), 0.25, ghost=ghost) for ghost in (False, True))
    assert max(part.get_zorder() for part in then) < min(part.get_zorder() for part in now)
    assert Legend(visits=True, met=True).height_in > Legend(visits=True).height_in
