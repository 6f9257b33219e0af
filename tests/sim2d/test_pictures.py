"""Pictures and animations: written, readable by others, the same every time, no label over another."""

import math
from itertools import combinations

import numpy as np
import pytest
from PIL import Image

from comity_sim2d import DockingPose, Frames, Furniture, Person, RobotBody, Room, Scene, World
from comity_sim2d.animation import write_gif
from comity_sim2d.label_placement import Box, Page
from comity_sim2d.picture import draw_picture
from comity_sim2d.ring import Ring

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
    while world.robot.motion().state != "arrived":
        world.step()
    world.robot.start_act("utter", "johanna", "Guten Tag, Johanna.")
    world.run(1.5)
    return world


def rings() -> list[Ring]:
    return [Ring("johanna", 0.64, 0.641, 0.0), Ring("omar", 0.9, None, 40.0, label="could not be reached")]


def test_a_picture_is_as_wide_as_asked_and_the_same_every_time(tmp_path, episode: World) -> None:
    for name in ("a", "b"):
        draw_picture(
            tmp_path / name, SCENE, episode.frames, rings=rings(), events=episode.events, title="A visit"
        )
    assert (tmp_path / "a").read_bytes() == (tmp_path / "b").read_bytes()
    with Image.open(tmp_path / "a") as image:
        assert image.format == "PNG"
        assert image.width == 1200
        assert "Software" not in image.info


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
    for name in ("a", "b"):
        write_gif(tmp_path / name, SCENE, short, rings=rings(), events=episode.events)
    assert (tmp_path / "a").read_bytes() == (tmp_path / "b").read_bytes()


def test_labels_do_not_overlap_even_where_many_share_a_place() -> None:
    page = Page(Box(0.0, 0.0, 800.0, 600.0), [], [])
    boxes = [page.place((400.0, 300.0), 20.0, (120.0, 30.0)) for _ in range(12)]
    assert all(one.overlap(other) == 0.0 for one, other in combinations(boxes, 2))
    assert all(box.outside(page.area) == pytest.approx(0.0) for box in boxes)
