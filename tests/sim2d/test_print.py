"""Pictures for print: legible colours, words as words in SVG and PDF, full pages, tracks that fade."""

from __future__ import annotations

import math
import re
from dataclasses import replace
from itertools import combinations, pairwise
from pathlib import Path

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st
from matplotlib.collections import LineCollection
from matplotlib.colors import to_rgb
from matplotlib.figure import Figure

import comity.replay
from comity.report.values.explanation_drawing import RULES
from comity_sim2d import DockingPose, Person, RobotBody, Room, Scene, World, load_map
from comity_sim2d.pictures import colours, drawing, episode_layout
from comity_sim2d.pictures.legend import Legend
from comity_sim2d.pictures.map_picture import draw_map
from comity_sim2d.pictures.panel import Card
from comity_sim2d.pictures.person_colours import DARK_GROUND, LIGHT_GROUND, person_colour
from comity_sim2d.pictures.picture import draw_picture
from comity_sim2d.pictures.ring import Ring
from comity_sim2d.pictures.sayings import TOGETHER_M, sayings
from comity_sim2d.robot.acts import ActEvent

SCENE = Scene(
    Room.rectangle(6.0, 4.5), RobotBody(0.6, 0.6), (Person("johanna", 4.6, 3.0, math.radians(200)),)
)
PAGE = Path(comity.replay.__file__).parent / "web" / "colours.css"


@pytest.fixture(scope="module")
def episode() -> World:
    world = World(SCENE)
    world.robot.dock("johanna", DockingPose(0.64, 0.0), speed_m_s=0.7)
    while world.robot.motion().state != "succeeded":
        world.step()
    return world


@pytest.mark.parametrize("ground", ["#FFFFFF", drawing.FLOOR, drawing.FURNITURE])
def test_words_have_a_contrast_of_four_and_a_half_with_what_they_stand_on(ground: str) -> None:
    """On furniture their halo is around them; alone they are legible there, too, but for small print."""
    people = (person_colour(place).on_light for place in range(200))
    words = (*colours.PALETTE, *RULES, colours.INK, colours.GREY, *people)
    assert all(colours.contrast(word, "#FFFFFF") >= colours.LEAST_CONTRAST for word in words)
    assert colours.contrast(colours.GREY, ground) >= colours.LEAST_CONTRAST


def test_black_on_white_has_the_contrast_that_its_definition_gives() -> None:
    assert colours.contrast("#000000", "#FFFFFF") == pytest.approx(21.0)
    assert colours.contrast("#777777", "#FFFFFF") == pytest.approx(4.48, abs=0.005)


@given(st.integers(0, 10_000))
def test_a_person_has_one_colour_on_light_and_one_on_dark_ground_both_legible(place: int) -> None:
    colour = person_colour(place)
    assert colours.contrast(colour.on_light, LIGHT_GROUND) >= colours.LEAST_CONTRAST
    assert colours.contrast(colour.on_dark, DARK_GROUND) >= colours.LEAST_CONTRAST


@pytest.mark.parametrize("ground", ["on_light", "on_dark"])
def test_twelve_people_have_colours_far_from_each_other(ground: str) -> None:
    """Distance in OKLab (Ottosson 2020): 0.02 is what an eye just notices."""
    shades = [oklab(getattr(person_colour(place), ground)) for place in range(12)]
    assert min(math.dist(one, other) for one, other in combinations(shades, 2)) > 0.07


PROTANOPIA = [
    [0.152286, 1.052583, -0.204868],
    [0.114503, 0.786281, 0.099216],
    [-0.003882, -0.048116, 1.051998],
]
DEUTERANOPIA = [
    [0.367322, 0.860646, -0.227968],
    [0.280085, 0.672501, 0.047413],
    [-0.011820, 0.042940, 0.968881],
]
"""Of linear RGB, at severity 1.0 (Machado, Oliveira and Fernandes 2009)."""


@pytest.mark.parametrize("sight", [PROTANOPIA, DEUTERANOPIA], ids=["protanopia", "deuteranopia"])
@pytest.mark.parametrize("ground", ["on_light", "on_dark"])
def test_six_people_have_colours_apart_for_red_green_blind_eyes(ground: str, sight) -> None:
    shades = [oklab(getattr(person_colour(place), ground), sight) for place in range(6)]
    assert min(math.dist(one, other) for one, other in combinations(shades, 2)) > 0.04


def oklab(colour: str, sight=((1, 0, 0), (0, 1, 0), (0, 0, 1))) -> list[float]:
    rgb = np.array(to_rgb(colour))
    linear = np.where(rgb <= 0.04045, rgb / 12.92, ((rgb + 0.055) / 1.055) ** 2.4)
    linear = np.clip(np.array(sight) @ linear, 0.0, 1.0)
    cones = [[0.4122, 0.5363, 0.0514], [0.2119, 0.6807, 0.1074], [0.0883, 0.2817, 0.6300]]
    mixed = [[0.2105, 0.7936, -0.0041], [1.9780, -2.4286, 0.4506], [0.0259, 0.7828, -0.8087]]
    return (np.array(mixed) @ np.cbrt(np.array(cones) @ linear)).tolist()


def test_rules_on_the_page_have_the_colours_of_pictures() -> None:
    light = PAGE.read_text(encoding="utf-8").partition("@media")[0]
    assert tuple(colour.upper() for colour in re.findall(r"--c\d: (#\w+)", light)) == colours.PALETTE


@pytest.mark.parametrize("form", ["svg", "pdf"])
def test_a_picture_in_vectors_is_the_same_every_time_and_its_words_are_words(
    form: str, episode: World, tmp_path: Path
) -> None:
    paths = [tmp_path / f"{name}.{form}" for name in "ab"]
    for path in paths:
        rings = [Ring("johanna", 0.64, 0.641, 0.0)]
        draw_picture(path, SCENE, episode.frames, rings=rings, title="A visit")
    content = paths[0].read_bytes()
    assert content == paths[1].read_bytes()
    assert b"2026-" not in content, "no date"
    if form == "svg":
        words = re.findall(r"<text[^>]*>([^<]+)</text>", content.decode())
        assert {"A visit", "johanna", "start", "1 m"} <= set(words)
    else:
        assert b"/FontFile2" in content, "letters as TrueType, which can be searched and copied"


def test_the_map_of_a_picture_in_vectors_is_where_it_is_in_pixels(tmp_path: Path, episode: World) -> None:
    """Words are placed in pixels of the page: in SVG these are points."""
    path = tmp_path / "a.svg"
    draw_picture(path, SCENE, episode.frames, title="A visit")
    text = path.read_text()
    width, height = (float(size) for size in re.search(r'viewBox="0 0 ([\d.]+) ([\d.]+)"', text).groups())
    name = re.search(r'<text [^>]*transform="translate\(([\d.]+) ([\d.]+)\)[^>]*>johanna<', text)
    name = name or re.search(r'<text [^>]*x="([\d.]+)" y="([\d.]+)"[^>]*>johanna<', text)
    x, y = (float(place) for place in name.groups())
    assert 0.0 < x < width
    assert 0.0 < y < height


@pytest.mark.parametrize("form", ["svg", "pdf"])
def test_a_map_is_drawn_in_vectors_the_same_every_time(form: str) -> None:
    ward = load_map("ward")
    drawn = draw_map(ward, title="ward", format=form)
    assert drawn == draw_map(ward, title="ward", format=form)
    if form == "svg":
        assert {"nurses' station", "bed 1a", "CORRIDOR"} <= set(
            re.findall(r">([^<>]+)</text>", drawn.decode())
        )


def card(name: str) -> Card:
    return Card(name, "#000000", "front, 0°", 0.8, 0.8, ("german woman", "bearing error 0.0°"))


@pytest.mark.parametrize("name", ["Alexandra Konstantinopoulos-Wojciechowska", "n" * 100])
def test_a_long_name_is_whole_on_the_map_and_on_its_card(tmp_path: Path, name: str) -> None:
    scene = replace(SCENE, people=(replace(SCENE.people[0], name=name),))
    path = tmp_path / "a.svg"
    draw_picture(path, scene, World(scene).frames, rings=[Ring(name, 0.6)])
    written = "".join(re.findall(r">([^<>]+)</t", path.read_text())).replace(" ", "")
    assert written.count(name.replace(" ", "")) == 2, "on the map and on the card"
    assert card(name).height_in > card("a").height_in


@given(st.floats(2.0, 60.0), st.floats(2.0, 60.0), st.integers(1, 12))
@settings(deadline=None)
def test_no_page_is_half_empty_and_everything_is_on_it(width_m: float, height_m: float, count: int) -> None:
    people = (Person("a", 1.0, 1.0, 0.0),)
    scene = Scene(Room.rectangle(width_m, height_m), RobotBody(width_m - 0.5, height_m - 0.5), people)
    cards = [card(f"p{i}") for i in range(count)]
    page = episode_layout.layout(scene, cards, Legend(visits=True))
    assert page.filled > 0.5
    places = [page.map, *(place for place, _ in page.columns)]
    for left, bottom, width, height in places:
        assert left >= 0.0 - 1e-9
        assert bottom >= -1e-9
        assert left + width <= page.width + 1e-9
        assert bottom + height <= page.height + 1e-9
    shown = [one for _, column in page.columns for one in column.cards]
    assert shown == cards, "in their order"
    assert [column.legend is not None for _, column in page.columns].count(True) == 1
    for (_, _, _, height), column in page.columns:
        assert column.height_in <= height + 1e-9


@given(st.floats(3.0, 20.0), st.floats(0.35, 1.5), st.integers(3, 12))
@example(9.0, 0.56, 12)
@settings(deadline=None)
def test_a_page_about_many_people_is_two_thirds_full(width_m: float, flat: float, count: int) -> None:
    people = (Person("a", 1.0, 0.5, 0.0),)
    scene = Scene(Room.rectangle(width_m, max(3.0, width_m * flat)), RobotBody(2.0, 2.0), people)
    page = episode_layout.layout(scene, [card(f"p{i}") for i in range(count)], Legend(visits=True))
    assert page.filled > 0.66


@given(st.floats(1.0, 3.0), st.floats(15.0, 60.0), st.integers(3, 5))
@settings(deadline=None)
def test_nothing_is_left_empty_beside_a_tall_corridor(width_m: float, height_m: float, count: int) -> None:
    """The panel, which stands next to it, is as high as the map."""
    scene = Scene(Room.rectangle(width_m, height_m), RobotBody(0.5, 0.5))
    page = episode_layout.layout(scene, [card(f"p{i}") for i in range(count)], Legend(visits=True))
    ((place, column),) = page.columns
    assert place[0] >= page.map[0] + page.map[2] - 1e-9
    assert page.height - episode_layout.HEADER_IN - column.height_in < 1.0


@pytest.mark.parametrize(("width_m", "height_m", "count"), [(16.0, 4.0, 6), (30.0, 3.0, 3), (12.0, 5.0, 12)])
def test_a_map_with_many_visits_has_room_for_their_words(width_m: float, height_m: float, count: int) -> None:
    scene = Scene(Room.rectangle(width_m, height_m), RobotBody(0.6, 0.6))
    page = episode_layout.layout(scene, [card(f"p{i}") for i in range(count)], Legend(visits=True))
    assert page.map[2] > 0.9 * page.width


@given(st.floats(4.0, 60.0), st.floats(0.05, 0.12), st.integers(1, 6))
@settings(deadline=None)
def test_a_corridor_has_room_for_words_above_and_below(width_m, flat, count) -> None:
    scene = Scene(Room.rectangle(width_m, max(0.6, width_m * flat)), RobotBody(0.3, 0.3))
    page = episode_layout.layout(scene, [card(f"p{i}") for i in range(count)], Legend(visits=True))
    assert page.map[3] >= 2.2  # inches: twice the height of a bubble of three lines, and the floor
    assert page.above_m * page.in_per_m * 2.0 + drawing.extent_m(scene)[1] * page.in_per_m == pytest.approx(
        page.map[3]
    )


@pytest.mark.parametrize("visits", [2, 4])
def test_a_corridor_has_twice_the_area_that_many_names_and_bubbles_take(visits: int) -> None:
    people = tuple(Person(f"p{i}", 2.0 + 4.0 * i, 1.0, 0.0) for i in range(12))
    scene = Scene(Room.rectangle(60.0, 3.0), RobotBody(0.3, 0.3), people)
    page = episode_layout.layout(scene, [card(f"p{i}") for i in range(visits)], Legend(visits=True))
    free_in2 = 2.0 * page.above_m * page.in_per_m * page.map[2]
    assert free_in2 >= 2.0 * (len(people) * 2.1 * 0.45 + visits * (2.2 * 0.7 + 1.1 * 0.3)) - 1e-9


def test_what_is_said_again_and_again_is_in_one_bubble_with_how_often() -> None:
    world = World(SCENE)
    world.robot.dock("johanna", DockingPose(0.64, 0.0), speed_m_s=0.7)
    world.run(6.0)
    asks = [
        ActEvent(t_start=t, t_end=t + 0.2, act="ask_to_pass", person="johanna", text="May I pass?")
        for t in (0.0, 2.0, 4.0)
    ]
    places = [drawing.pose_at(world.frames, "robot", one.t_start).xy for one in asks]
    assert math.dist(places[0], places[1]) > TOGETHER_M
    (found,) = sayings(world.frames, "robot", asks)
    assert (found.times, found.lines[-1]) == (3, "(3 times)")
    other = ActEvent(t_start=3.0, t_end=3.2, act="say", person="johanna", text="Thank you.")
    assert [one.times for one in sayings(world.frames, "robot", [*asks, other])] == [2, 1, 1]


@given(st.lists(st.tuples(st.floats(-20, 20), st.floats(-20, 20)), min_size=2, max_size=60))
@settings(deadline=None)
def test_a_track_is_drawn_whole_and_darkest_at_its_end(corners) -> None:
    ax = Figure().add_subplot()
    points = np.array(corners)
    drawing.draw_track(ax, points, colours.PALETTE[0])
    (lines,) = (one for one in ax.collections if isinstance(one, LineCollection))
    lightness = lines.get_colors()[:, :3].sum(axis=1)
    assert (np.diff(lightness) <= 1e-9).all()
    assert lines.get_colors()[-1, :3] == pytest.approx(
        drawing.tint(colours.PALETTE[0], 1.0 - drawing.TRACK_DARK)
    )
    legs = {tuple(map(tuple, leg)) for piece in lines.get_segments() for leg in pairwise(piece)}
    assert all((tuple(a), tuple(b)) in legs for a, b in pairwise(points))
