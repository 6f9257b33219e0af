"""A ROS map wherever a map may be named: a visit in it, its picture, and maps of ours written as one."""

from __future__ import annotations

import json
import re
from pathlib import Path

import yaml
from PIL import Image

from comity_sim2d import load_map

SCENARIO = """\
schema_version: 1
name: lab-visit
place: {map: lab/map.yaml}
robot: {at_m: [0.5, 0.5]}
people:
  host: {profile: german_woman, at: desk}
goals: [{greet: host}]
"""
ROS = """\
image: map.png
resolution: 0.05
origin: [-1.0, -1.0, 0.0]
negate: 0
occupied_thresh: 0.65
free_thresh: 0.196
"""


def lab(here: Path) -> None:
    (here / "lab").mkdir()
    (here / "lab" / "map.yaml").write_text(ROS)
    (here / "lab" / "map.places.yaml").write_text(
        "schema_version: 1\nlocations:\n  desk: {at_m: [3.5, 2.5], facing_deg: 180}\n"
    )
    picture = Image.new("L", (120, 100), 205)
    picture.paste(254, (5, 5, 115, 95))
    picture.paste(0, (60, 5, 63, 60))
    picture.save(here / "lab" / "map.png")
    (here / "visit.scenario.yaml").write_text(SCENARIO)


def test_a_visit_in_a_ros_map_runs_and_its_folder_runs_again_without_the_picture(comity, here: Path) -> None:
    lab(here)
    assert (
        json.loads(comity("run", "visit.scenario.yaml", "--out", "one", "--json").out)["outcome"] == "success"
    )
    (here / "lab" / "map.png").unlink()
    again = json.loads(comity("run", "one/scenario.yaml", "--out", "two", "--json").out)
    assert again["outcome"] == "success"
    assert (here / "one" / "frames.csv").read_bytes() == (here / "two" / "frames.csv").read_bytes()


def test_what_is_wrong_with_a_ros_map_is_said_with_its_line_in_the_scenario_run(comity, here: Path) -> None:
    lab(here)
    (here / "lab" / "map.png").unlink()
    said = comity("run", "visit.scenario.yaml")
    assert said.code == 2
    assert "lab/map.yaml:1: expected a PGM or PNG file, got no such file: map.png." in " ".join(
        said.err.split()
    )


def test_a_ros_map_is_drawn_like_a_map_of_ours(comity, here: Path) -> None:
    lab(here)
    drawn = json.loads(comity("draw", "lab/map.yaml", "--out", "lab.svg", "--json").out)
    assert (drawn["kind"], drawn["name"]) == ("map", "map")
    words = " ".join(re.findall(r">([^<>]+)</text>", (here / "lab.svg").read_text()))
    assert "120 x 100 cells of 0.05 m, origin (-1, -1) m. Walls are exact to 0.05 m." in words
    assert "1 room, 1 named place." in words
    assert "0, 0" in words, "where coordinates count from"


def test_a_scenario_on_a_ros_map_tells_how_the_map_was_understood(comity, here: Path) -> None:
    """As the map itself does, and so does the scenario that a run keeps, which holds the map."""
    lab(here)
    comity("run", "visit.scenario.yaml", "--out", "one")
    notes = load_map("lab/map.yaml").about
    assert "120 x 100 cells of 0.05 m" in notes
    for name in ("lab/map.yaml", "visit.scenario.yaml", "one/scenario.yaml"):
        assert comity("draw", name, "--out", "a.svg").code == 0
        words = " ".join(re.findall(r">([^<>]+)</text>", (here / "a.svg").read_text()))
        assert notes in words, name


def test_the_picture_of_a_ros_map_leads_to_its_map(comity, here: Path) -> None:
    lab(here)
    (here / "lab" / "broken.yaml").write_text("[")
    (here / "lab" / "other.yaml").write_text(ROS.replace("map.png", "other.png"))
    said = comity("draw", "lab/map.png")
    assert said.code == 2
    assert "lab/map.yaml" in said.err
    assert "other.yaml" not in said.err
    (here / "visit.scenario.yaml").write_text(SCENARIO.replace("map.yaml", "map.png"))
    assert "lab/map.yaml" in " ".join(comity("run", "visit.scenario.yaml").err.split())
    (here / "lab" / "map.yaml").unlink()
    assert ".yaml" not in comity("draw", "lab/map.png").err.replace("map.yaml", "")


def test_a_ros_map_without_its_picture_is_no_scenario_with_strange_keys(comity, here: Path) -> None:
    lab(here)
    (here / "lab" / "map.yaml").write_text(ROS.replace("image: map.png\n", ""))
    for command in (("draw", "lab/map.yaml"), ("run", "visit.scenario.yaml")):
        said = comity(*command)
        assert said.code == 2
        assert "lab/map.yaml:1: expected the key 'image', got nothing." in " ".join(said.err.split())


def test_a_map_of_ours_goes_out_as_a_ros_map_which_replaces_its_own_files_only(comity, here: Path) -> None:
    for _ in range(2):
        assert comity("draw", "ward", "--ros-map", "out").code == 0
    told = yaml.safe_load((here / "out" / "ward.yaml").read_text())
    assert (told["image"], told["resolution"]) == ("ward.pgm", 0.05)
    assert Image.open(here / "out" / "ward.pgm").size == (482, 246)
    assert comity("draw", "out/ward.yaml").code == 0
    bare = "schema_version: 1\nname: ward\nrooms: {hall: {box_m: [90, 0, 7, 3]}}\n"
    (here / "bare.map.yaml").write_text(bare)
    assert comity("draw", "bare.map.yaml", "--ros-map", "out").code == 0
    assert comity("draw", "out/ward.yaml").code == 0, "none of the named places of before is left"
    (here / "out" / "ward.pgm").write_bytes(b"P5 1 1 255 x")
    assert comity("draw", "ward", "--ros-map", "out").code == 2
    assert comity("draw", "ward", "--ros-map", "out", "--graph").code == 2
