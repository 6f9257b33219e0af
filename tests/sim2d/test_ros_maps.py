"""Maps of ROS, both ways: cells to floor and floor to cells, within a stated tolerance, on the safe side."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from tempfile import TemporaryDirectory
from time import process_time

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays
from PIL import Image
from scipy.ndimage import binary_erosion, label
from shapely import Point, Polygon, box, get_parts, union_all

from comity_fis.errors import InputError, Where
from comity_sim2d import Person, PlaceMap, RobotBody, SceneError, load_map, shipped_maps
from comity_sim2d.maps.building import build_map
from comity_sim2d.maps.file import MapFile
from comity_sim2d.maps.occupancy import corners_of_cells, floor_of_cells
from comity_sim2d.maps.ros_export import CELL_M, ros_map_files
from comity_sim2d.scene.obstacles import floor_plan_of

YAML = """\
image: map.pgm
resolution: 0.1
origin: [0.0, 0.0, 0.0]
negate: 0
occupied_thresh: 0.65
free_thresh: 0.196
"""
MILLIMETRE = 0.001
"""Coordinates of maps are rounded to that."""


def shape(place: PlaceMap) -> Polygon:
    return Polygon(place.room.corners, place.room.holes)


def written(folder: Path, text: str = YAML, grey=None, name: str = "map.pgm", **more: str) -> Path:
    """A ROS map on disk; the picture is white for 3 m by 2 m unless given."""
    picture = np.full((20, 30), 254, dtype=np.uint8) if grey is None else np.asarray(grey)
    Image.fromarray(picture).save(folder / name)
    for file, content in more.items():
        (folder / file.replace("_", ".")).write_text(content)
    (folder / "map.yaml").write_text(text)
    return folder / "map.yaml"


@given(
    arrays.arrays(
        bool, st.tuples(st.integers(1, 14), st.integers(1, 14)), elements=st.integers(0, 3).map(bool)
    ),
    st.floats(0.05, 2.5),
)
@settings(max_examples=300, deadline=None)
def test_a_floor_lies_in_free_cells_and_lacks_none_that_is_farther_than_the_tolerance_from_the_others(
    free, tolerance
) -> None:
    floor = floor_of_cells(free, tolerance)
    numbers, _ = label(free)
    biggest = numbers == np.argmax(np.bincount(numbers[free], minlength=1)) if free.any() else free
    cells = union_all([box(x, y, x + 1, y + 1) for y, x in np.argwhere(biggest)])
    whole = [part for part in get_parts(cells.buffer(-tolerance - 1e-6, quad_segs=32)) if not part.is_empty]
    if floor is None:
        assert not any(part.area > 1e-6 for part in whole)
        return
    outline = Polygon(floor.outline, floor.holes)
    assert outline.is_valid
    assert outline.difference(cells).area < 1e-9
    for part in whole:
        missing = part.difference(outline.buffer(1e-6)).area
        assert missing < 1e-6 or not part.intersects(outline), "all of a part, or none that is apart"


@given(
    st.lists(st.integers(15, 60), min_size=1, max_size=3),
    st.lists(st.tuples(st.integers(0, 150), st.integers(0, 40), st.integers(3, 15)), max_size=6),
    st.integers(0, 90),
    st.sampled_from((0.02, 0.05, 0.1)),
)
@settings(max_examples=60, deadline=None)
def test_a_map_that_goes_out_and_comes_back_has_every_free_point_but_within_the_tolerance(
    widths, boxes, angle, cell_m
) -> None:
    ends = [sum(widths[:i]) / 10 for i in range(len(widths) + 1)]
    content = {
        "schema_version": 1,
        "name": "row",
        "rooms": {f"r{i}": {"box_m": [ends[i], 0, width / 10, 4]} for i, width in enumerate(widths)},
        "doors": {
            f"d{i}": {"at_m": [x, 1.5], "width_m": 1.1, "open": False} for i, x in enumerate(ends[1:-1])
        },
        "furniture": [
            {"name": f"f{i}", "box_m": [x / 10, y / 10, size / 10, 0.4], "angle_deg": angle}
            for i, (x, y, size) in enumerate(boxes)
        ],
    }
    try:
        place = build_map(MapFile.model_validate(content), lambda *_: Where("row"))
    except InputError:
        return
    plan = floor_plan_of(place.room, place.walls, place.furniture, doors=())
    with TemporaryDirectory() as folder:
        for name, part in ros_map_files(place, "row", cell_m).items():
            (Path(folder) / name).write_bytes(part)
        try:
            back = shape(load_map(Path(folder) / "row.yaml"))
        except InputError:  # too narrow for a robot, by the cells
            return
    free = plan.clear_space(0.0, at_least=False)
    assert back.difference(free.buffer(MILLIMETRE)).area < 1e-6, "nothing is free that was not"
    lost_m = cell_m * (1 + math.sqrt(2)) + MILLIMETRE  # the tolerance, and a cell that something touches
    for part in get_parts(plan.clear_space(lost_m)):
        missing = part.difference(back).area
        assert missing < 1e-6 or not part.intersects(back.buffer(-lost_m))


@pytest.mark.parametrize("name", shipped_maps())
def test_every_shipped_map_comes_back_with_its_named_places(name: str, tmp_path: Path) -> None:
    place = load_map(name)
    files = ros_map_files(place, name)
    assert files == ros_map_files(place, name), "the same bytes each time"
    for file, content in files.items():
        (tmp_path / file).write_bytes(content)
    back = load_map(tmp_path / f"{name}.yaml")
    assert [(one.name, one.xy) for one in back.locations] == [(one.name, one.xy) for one in place.locations]
    assert [one.heading_rad for one in back.locations] == pytest.approx(
        [one.heading_rad for one in place.locations]
    )
    assert f"cells of {CELL_M:g} m" in back.about


def exported(folder: Path, name: str) -> tuple[Path, PlaceMap]:
    """A shipped map as a ROS map, with itself."""
    place = load_map(name)
    for file, content in ros_map_files(place, name).items():
        (folder / file).write_bytes(content)
    return folder / f"{name}.yaml", place


@pytest.mark.parametrize("name", ["apartment", "office", "ward"])
def test_a_shipped_map_comes_back_with_its_walls_within_the_tolerance(name: str, tmp_path: Path) -> None:
    path, place = exported(tmp_path, name)
    plan = floor_plan_of(place.room, place.walls, place.furniture, doors=())
    back = shape(load_map(path))
    assert back.difference(plan.clear_space(0.0, at_least=False).buffer(MILLIMETRE)).area < 1e-6
    assert plan.clear_space(0.13).difference(back).area < 1e-6, "the guide says 13 cm"


@pytest.mark.parametrize("name", ["apartment", "office", "ward"])
@pytest.mark.parametrize("tolerance_m", [0.05, 0.3])
def test_of_single_cells_those_on_the_floor_are_holes_and_free_ones_in_walls_are_left_out(
    name: str, tolerance_m: float, tmp_path: Path
) -> None:
    path, _ = exported(tmp_path, name)
    grey = np.asarray(Image.open(path.with_suffix(".pgm"))).copy()
    on_floor = np.argwhere(binary_erosion(grey == 254, iterations=10))[::997]
    in_walls = np.argwhere(binary_erosion(grey != 254, np.ones((3, 3))))[::97]
    for i, (row, column) in enumerate(on_floor):
        grey[row, column] = (0, 205)[i % 2]
    grey[tuple(in_walls.T)] = 254
    Image.fromarray(grey).save(path.with_suffix(".pgm"))
    path.with_suffix(".places.yaml").write_text(f"schema_version: 1\ntolerance_m: {tolerance_m}\n")
    place = load_map(path)
    for row, column in (*on_floor, *in_walls):  # the picture begins a cell before the point 0, 0
        x, y = (column - 1) * CELL_M, (len(grey) - row - 2) * CELL_M
        assert shape(place).intersection(box(x, y, x + CELL_M, y + CELL_M)).area < 1e-6
    assert len(place.room.holes) >= len(on_floor)


SHADES: Mapping[str, tuple[str, list[int]]] = {
    "trinary": ("", [254]),
    "a high threshold": ("free_thresh: 0.5\noccupied_thresh: 0.95", [254, 205, 150]),
    "negated": ("negate: 1", [0, 20]),
    "scale": ("mode: scale", [254]),
    "raw, in percent": ("mode: raw", [0]),
    "raw, below a threshold": ("mode: raw\nfree_thresh: 0.25", [0, 20]),
}


@pytest.mark.parametrize(("change", "free"), SHADES.values(), ids=SHADES)
def test_thresholds_and_modes_are_those_of_the_map_server(
    change: str, free: list[int], tmp_path: Path
) -> None:
    """Stripes of 2 m of several shades, one at a time beside a free one."""
    keys = [line.partition(":")[0] for line in change.splitlines()]
    kept = [line for line in YAML.splitlines() if line.partition(":")[0] not in keys]
    text = "\n".join([*kept, change]) + "\n"
    for shade in (0, 20, 50, 100, 150, 205, 254):
        grey = np.full((20, 40), free[0], dtype=np.uint8)
        grey[:, 20:] = shade
        area = shape(load_map(written(tmp_path, text, grey))).area
        assert area == pytest.approx(8.0 if shade in free else 4.0), shade


def test_in_mode_scale_a_cell_that_one_looks_through_is_not_free(tmp_path: Path) -> None:
    grey = np.full((20, 40, 4), 255, dtype=np.uint8)
    grey[:, 20:, 3] = 0
    path = written(tmp_path, YAML.replace("map.pgm", "map.png") + "mode: scale\n", grey, "map.png")
    assert shape(load_map(path)).area == pytest.approx(4.0)


@pytest.mark.parametrize("mode", ["RGBA", "LA"])
def test_in_mode_trinary_opacity_counts_as_a_fourth_channel_of_white(mode: str, tmp_path: Path) -> None:
    """White cells are free where they are opaque, and unknown where they are transparent: (3 + 0) / 4."""
    channels = np.full((20, 40, len(mode)), 255, dtype=np.uint8)
    channels[:, 20:, -1] = 0
    path = written(tmp_path, YAML.replace("map.pgm", "map.png"), channels, "map.png")
    assert shape(load_map(path)).area == pytest.approx(4.0)


def test_origin_and_yaw_put_the_lower_left_corner_where_ros_has_it(tmp_path: Path) -> None:
    text = YAML.replace("[0.0, 0.0, 0.0]", f"[-5, 2, {math.pi / 2}]")
    assert shape(load_map(written(tmp_path, text))).equals_exact(
        Polygon([(-5, 2), (-5, 5), (-7, 5), (-7, 2)]), 1e-3, normalize=True
    )


def test_unknown_cells_and_what_is_apart_are_no_floor_and_that_is_said(tmp_path: Path) -> None:
    grey = np.full((40, 80), 205, dtype=np.uint8)
    grey[2:38, 2:40] = grey[10:20, 60:70] = 254
    place = load_map(written(tmp_path, grey=grey))
    assert shape(place).area == pytest.approx(36 * 38 / 100)
    assert place.about == (
        "80 x 40 cells of 0.1 m, origin (0, 0) m. Walls are exact to 0.1 m. "
        "Unknown cells, 54 %, count as not free. "
        "7 % of the free cells are left out: apart, or too narrow."
    )


def test_unknown_cells_that_the_threshold_makes_free_are_told(tmp_path: Path) -> None:
    """`map_saver` writes 205, which is 0.196 dark; many maps beside it say `free_thresh: 0.25`."""
    grey = np.full((40, 80), 254, dtype=np.uint8)
    grey[:, 50:] = 205
    assert "205" not in load_map(written(tmp_path, grey=grey)).about
    place = load_map(written(tmp_path, YAML.replace("0.196", "0.25"), grey))
    assert shape(place).area == pytest.approx(32.0)
    assert "38 % of the cells are 205, which often means unknown: here free" in place.about


def test_a_turned_origin_is_told(tmp_path: Path) -> None:
    place = load_map(written(tmp_path, YAML.replace("[0.0, 0.0, 0.0]", "[-4.0, 2.5, 0.5235988]")))
    assert "origin (-4, 2.5) m, turned by 30 degrees." in place.about


@pytest.mark.parametrize("key", ["image", "resolution", "origin", "negate", "occupied_thresh", "free_thresh"])
def test_a_missing_key_of_a_ros_map_is_named_as_such(key: str, tmp_path: Path) -> None:
    left_out = "".join(line for line in YAML.splitlines(keepends=True) if not line.startswith(key))
    with pytest.raises(InputError, match=f"expected the key '{key}', got nothing"):
        load_map(written(tmp_path, left_out))


def test_something_that_stands_free_is_a_hole_that_nobody_sees_through(tmp_path: Path) -> None:
    grey = np.full((40, 60), 254, dtype=np.uint8)
    grey[15:25, 30:32] = 0
    place = load_map(written(tmp_path, grey=grey))
    plan = floor_plan_of(place.room, place.walls, place.furniture, ())
    assert len(place.room.holes) == 1
    assert plan.wall_between((1.0, 2.0), (5.0, 2.0)) is not None
    assert plan.wall_between((1.0, 0.5), (5.0, 0.5)) is None


def test_places_are_named_in_a_file_beside_the_map(tmp_path: Path) -> None:
    places = "schema_version: 1\nabout: The lab.\nlocations:\n  door: {at_m: [0.5, 0.5], facing_deg: 90}\n"
    place = load_map(written(tmp_path, map_places_yaml=places))
    assert place.location("door").heading_rad == pytest.approx(math.pi / 2)
    assert place.about.startswith("The lab. 30 x 20 cells")


@pytest.mark.parametrize("yaw", [0.0, math.pi / 2])
def test_a_seated_person_may_be_on_furniture_that_is_named_beside_the_map(yaw: float, tmp_path: Path) -> None:
    """Without its name it is a hole; nothing else of the floor changes, and the wall behind it stays."""
    grey = np.full((40, 60), 254, dtype=np.uint8)
    grey[:3], grey[3:13, 20:40] = 0, 0  # a sofa at a wall: at the top of the picture
    text = YAML.replace("[0.0, 0.0, 0.0]", f"[1.0, 2.0, {yaw}]")
    bare = load_map(written(tmp_path, text, grey))
    box_m = [3.0, 4.7, 2.0, 1.0] if not yaw else [-2.7, 4.0, 1.0, 2.0]
    places = f"schema_version: 1\nfurniture:\n  - {{name: sofa, box_m: {box_m}}}\n"
    place = load_map(written(tmp_path, text, grey, map_places_yaml=places))
    sofa = Polygon(place.furniture[0].corners)
    assert shape(place).symmetric_difference(shape(bare).union(sofa)).area == pytest.approx(0.0, abs=1e-6)
    middle = sofa.centroid
    robot = RobotBody(*(shape(bare).representative_point().coords[0]))
    sits = Person("ada", middle.x, middle.y, 0.0, posture="seated")
    assert place.scene(robot, (sits,)).person("ada").posture == "seated"
    for where, posture in ((bare, "seated"), (place, "standing")):
        with pytest.raises(SceneError):
            where.scene(robot, (replace(sits, posture=posture),))


def test_a_larger_tolerance_leaves_fewer_corners_of_a_rough_wall(tmp_path: Path) -> None:
    grey = np.full((200, 200), 254, dtype=np.uint8)
    grey[np.random.default_rng(0).integers(0, 3, 200) > np.arange(200)[:, None]] = 0
    corners = []
    for tolerance in (0.05, 0.1, 0.3):
        places = f"schema_version: 1\ntolerance_m: {tolerance}\n"
        corners.append(len(load_map(written(tmp_path, grey=grey, map_places_yaml=places)).room.corners))
    assert corners == sorted(corners, reverse=True)
    assert corners[0] > 100
    assert corners[-1] < 8


def test_a_map_of_400_by_400_cells_is_read_at_once(tmp_path: Path) -> None:
    rng, y, x = np.random.default_rng(0), *np.mgrid[:400, :400]
    free = (x > 4) & (y > 4) & (x < 395) & (y < 395) & ~((abs(x - y) < 3) & (x % 100 > 30))
    free &= rng.random((400, 400)) > 0.001
    path = written(tmp_path, grey=np.where(free, 254, 0).astype(np.uint8))
    began = process_time()
    load_map(path)
    assert process_time() - began < 4.0, "about 0.8 s on an idle machine"


REFUSED: Mapping[str, tuple[str, str, str, int]] = {
    "a key that is not there": ("negate: 0\n", "", "negate", 1),
    "a slip in a key": ("negate: 0", "negate: 0\nmod: raw", "a known key, got 'mod'", 5),
    "no number": ("resolution: 0.1", "resolution: fine", "resolution", 2),
    "an origin of two": ("[0.0, 0.0, 0.0]", "[0.0, 0.0]", "origin", 3),
    "thresholds the wrong way round": ("free_thresh: 0.196", "free_thresh: 0.9", "free_thresh at most", 1),
    "an unknown mode": ("negate: 0", "negate: 0\nmode: fuzzy", "'trinary', 'scale' or 'raw'", 5),
    "cells of metres": ("resolution: 0.1", "resolution: 60", "got 1800 m, with cells of 60 m", 2),
    "cells of a tenth of a millimetre": ("resolution: 0.1", "resolution: 0.0001", "cells of 0.0001 m", 2),
    "cells of a centimetre": ("resolution: 0.1", "resolution: 0.01", "with cells of 0.01 m", 2),
    "no picture": ("map.pgm", "other.pgm", "no such file: other.pgm", 1),
    "a picture of another kind": ("map.pgm", "map.gif", "map.gif, which is neither", 1),
    "a broken picture": ("map.pgm", "cut.pgm", "cut.pgm, which is broken", 1),
    "nothing free": ("negate: 0", "negate: 1", "a picture with free cells", 1),
}


@pytest.mark.parametrize(("old", "new", "words", "line"), REFUSED.values(), ids=REFUSED)
def test_what_cannot_be_read_is_refused_with_its_file_and_line(
    old: str, new: str, words: str, line: int, tmp_path: Path
) -> None:
    path = written(tmp_path, YAML.replace(old, new))
    Image.new("L", (30, 20)).save(tmp_path / "map.gif")
    (tmp_path / "cut.pgm").write_bytes((tmp_path / "map.pgm").read_bytes()[:100])
    with pytest.raises(InputError) as refused:
        load_map(path)
    assert words in str(refused.value)
    assert refused.value.where == Where(str(path), line)
    assert refused.value.remedy


@pytest.mark.parametrize(
    ("places", "line"),
    [
        ("schema_version: 1\nlocations:\n  far: {at_m: [50, 50]}\n", 3),
        ("schema_version: 1\nlocations:\n  wall: {at_m: [0.05, 1]}\n", 3),
        ("schema_version: 1\nlocation: {}\n", 2),
        ("schema_version: 1\ntolerance_m: 0\n", 2),
        ("schema_version: 1\nfurniture:\n  - {name: sofa, box_m: [50, 50, 1, 1]}\n", 3),
        ("schema_version: 1\nfurniture:\n  - {name: sofa}\n", 3),
    ],
)
def test_what_is_wrong_with_named_places_is_said_with_their_own_line(
    places: str, line: int, tmp_path: Path
) -> None:
    path = written(tmp_path, map_places_yaml=places)
    with pytest.raises(InputError) as refused:
        load_map(path)
    assert refused.value.where == Where(str(tmp_path / "map.places.yaml"), line)


def test_a_hole_in_a_map_of_ours_is_no_floor_and_is_refused_without_an_area() -> None:
    content = {"schema_version": 1, "name": "yard", "rooms": {"yard": {"box_m": [0, 0, 6, 6]}}}
    hole = [[2, 2], [4, 2], [4, 4], [2, 4]]
    place = build_map(MapFile.model_validate(content | {"holes_m": [hole]}), lambda *_: Where("yard"))
    assert shape(place).area == pytest.approx(32.0)
    assert not shape(place).contains(Point(3, 3))
    flat = MapFile.model_validate(content | {"holes_m": [[[2, 2], [4, 2], [3, 2]]]})
    with pytest.raises(InputError, match="hole 1: expected an outline"):
        build_map(flat, lambda *_: Where("yard"))


def test_a_picture_of_noise_is_refused_before_polygons_are_made_of_it(tmp_path: Path) -> None:
    noise = np.where(np.random.default_rng(1).random((1000, 1000)) < 0.3, 0, 254).astype(np.uint8)
    with pytest.raises(InputError, match="at most 150,000 corners"):
        load_map(written(tmp_path, grey=noise))


@pytest.mark.parametrize("side", [4001, 9600, 14_000])
def test_a_picture_of_too_many_cells_is_refused_by_its_header(side: int, tmp_path: Path, recwarn) -> None:
    path = written(tmp_path)
    (tmp_path / "map.pgm").write_bytes(f"P5 {side} {side} 255\n".encode())
    with pytest.raises(InputError, match="at most 16,000,000 cells"):
        load_map(path)
    assert not recwarn.list


def test_a_floor_of_too_many_holes_is_told_as_noise(tmp_path: Path) -> None:
    specks = np.full((300, 300), 254, dtype=np.uint8)
    specks[1:-1:3, 1:-1:3] = 0
    with pytest.raises(InputError, match="at most 8,333 holes"):
        load_map(written(tmp_path, grey=specks))


@given(arrays.arrays(bool, st.tuples(st.integers(1, 9), st.integers(1, 9))))
@settings(max_examples=200, deadline=None)
def test_the_corners_of_cells_are_those_of_their_outlines(free) -> None:
    """A corner where two cells touch counts for both."""
    cells = [box(x, y, x + 1, y + 1) for y, x in np.argwhere(free)]
    rings = [ring for part in get_parts(union_all(cells)) for ring in (part.exterior, *part.interiors)]
    corners = sum(len(ring.simplify(0.0).coords) - 1 for ring in rings)
    assert corners_of_cells(free) == pytest.approx(corners, abs=len(rings))
