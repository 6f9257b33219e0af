"""Who cannot be reached is told with what bars the way: a shut door, somebody in it, a narrow gap."""

from __future__ import annotations

import math
import re
import tempfile
from pathlib import Path

import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from comity.answers.plan import Unmet
from comity.live_episode import execute
from comity.planning.barring import barring
from comity.preparation import prepare
from comity.scenario import load_scenario
from comity_sim2d import Scene

ROOMS = """\
schema_version: 1
name: three rooms
place:
  map:
    schema_version: 1
    name: three rooms
    rooms:
      hall: {box_m: [0, 0, 4, 4]}
      kitchen: {box_m: [4, 0, 4, 4]}
      pantry: {box_m: [8, 0, 4, 4]}
    doors:
      kitchen: {at_m: [4, 2], width_m: 0.9}
      pantry: {at_m: [8, 2], width_m: 0.9}
    furniture: [%(furniture)s]
  doors: {%(doors)s}
robot: {at_m: [1, 1]}
people:
  ada: {at_m: [%(ada)s], facing_deg: 180}
%(people)sgoals:
  - greet: ada
"""


def reason(ada: str = "6.5, 2", doors: str = "", furniture: str = "", people: str = "") -> str | None:
    """Why nobody can serve Ada in her place; None where one can."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "rooms.scenario.yaml")
        written = {"ada": ada, "doors": doors, "furniture": furniture, "people": people}
        path.write_text(ROOMS % written, encoding="utf-8")
        return prepare(load_scenario(str(path))).asked.unreachable.get("ada")


def test_with_all_doors_open_nothing_bars_the_way():
    assert reason() is None
    assert reason("10.5, 2") is None


@pytest.mark.parametrize(
    ("ada", "doors", "told"),
    [
        ("6.5, 2", "kitchen: closed", "the door 'kitchen' is shut"),
        ("6.5, 2", "kitchen: closed, pantry: closed", "the door 'kitchen' is shut"),
        ("10.5, 2", "pantry: closed", "the door 'pantry' is shut"),
        ("10.5, 2", "kitchen: closed, pantry: closed", "the doors 'kitchen' and 'pantry' are shut"),
    ],
)
def test_a_shut_door_is_named_where_it_matters(ada, doors, told):
    found = reason(ada, doors)
    assert (
        found == f"no free and reachable place before ada: front, left and right have no way to them; {told}"
    )


def test_somebody_who_stands_in_the_only_door_is_named():
    people = "  bob: {at_m: [4, 2]}\n  eve: {at_m: [2, 3]}\n"
    assert reason(people=people).split("; ")[1:] == [
        "bob is in the way",
        "the widest gap, beside bob, is 0.25 m, and the robot needs 0.86 m",
    ]


def test_a_crowd_in_the_way_is_counted():
    rows = "".join(f"  p{i}_{x}: {{at_m: [3.{x}, {0.3 + 0.5 * i}]}}\n" for i in range(8) for x in (0, 6))
    assert reason(people=rows).split("; ")[1] == "9 people are in the way"


BETWEEN = """\
schema_version: 1
name: between
place: {width_m: 8, height_m: %(wide)s}
robot: {at_m: [1, %(middle)s]}
people:
  ada: {at_m: [7, %(middle)s], facing_deg: 180}
  bob: {at_m: [4, 0.25]}
  eve: {at_m: [4, %(eve)s]}
goals:
  - greet: ada
"""


def the_gap_told(text: str) -> tuple[str, float, float]:
    """Where the widest gap is, how wide, and how wide it would have to be."""
    found = re.search(r"the widest gap, (.*), is (\S+) m, and the robot needs (\S+) m$", text)
    assert found is not None, text
    return found[1], float(found[2]), float(found[3])


def rounded_down(width_m: float) -> float:
    """To a centimetre, as widths are told that are too narrow."""
    return math.floor(100 * width_m + 1e-6) / 100


@settings(max_examples=12, deadline=None)
@given(st.floats(0.1, 1.08))
def test_the_gap_between_people_is_told_with_its_width_and_with_what_the_robot_needs(gap_m):
    """The robot is 0.50 m across, and routes keep 0.305 m from either person."""
    numbers = {"wide": gap_m + 0.9, "middle": gap_m / 2 + 0.45, "eve": gap_m + 0.65}
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "between.scenario.yaml")
        path.write_text(BETWEEN % numbers, encoding="utf-8")
        told = prepare(load_scenario(str(path))).asked.unreachable["ada"]
    assert the_gap_told(told) == ("between bob and eve", rounded_down(gap_m), 1.11)


@settings(max_examples=12, deadline=None)
@given(st.floats(0.25, 0.83))
def test_the_gap_between_a_person_and_a_wall_is_told(gap_m):
    """Beside a wall it is the robot's width, 0.30 m to the person and 0.05 m to the wall, with 2 mm more."""
    assume(abs(gap_m - 0.5) > 0.02)  # what is between Bob and the bar
    people = f"  bob: {{at_m: [2, {gap_m + 0.2}]}}\n  eve: {{at_m: [2, {gap_m + 0.65}]}}\n"
    posts = f"{{name: bar, box_m: [1.7, {gap_m + 0.9}, 0.6, {4 - gap_m - 0.9}]}}"
    told = reason(furniture=posts, people=people)
    assert the_gap_told(told) == ("beside bob", rounded_down(gap_m), 0.86)


@pytest.mark.parametrize(("gap_m", "told_m"), [(1.092, 1.09), (1.1, 1.10), (1.1095, 1.10)])
def test_a_gap_that_lacks_millimetres_is_told_as_less_than_is_needed(gap_m, told_m, tmp_path):
    """Routes keep 5 mm more from each person than the margin."""
    path = tmp_path / "between.scenario.yaml"
    path.write_text(BETWEEN % {"wide": gap_m + 0.9, "middle": gap_m / 2 + 0.45, "eve": gap_m + 0.65})
    told = prepare(load_scenario(str(path))).asked.unreachable["ada"]
    assert the_gap_told(told) == ("between bob and eve", told_m, 1.11)


def beside_ada(wide: float) -> Unmet | None:
    """What `comity plan` says of Ada, at the wall of a corridor: the gap beside her is 0.45 m less wide."""
    Path("gap.scenario.yaml").write_text(CORRIDOR % {"wide": wide, "y": 0.25}, encoding="utf-8")
    return next(iter(prepare(load_scenario("gap.scenario.yaml")).unmet), None)


@pytest.mark.parametrize("gap_m", [0.479, 0.485, 0.60, 0.82, 0.848, 0.85])
def test_a_gap_is_told_with_what_it_lacks_and_so_much_more_suffices(gap_m, here):
    """The numbers told add up."""
    told = beside_ada(0.45 + gap_m)
    wider_cm = int(re.fullmatch(r"the gap beside ada were (\d+) cm wider", told.conditions[0].text)[1])
    assert the_gap_told(told.reason) == ("beside ada", rounded_down(gap_m), 0.86)
    assert rounded_down(gap_m) == pytest.approx(0.86 - wider_cm / 100)
    assert beside_ada(0.45 + gap_m + wider_cm / 100) is None


@pytest.mark.parametrize("bob_m", [0.25, 0.40])
def test_a_gap_that_is_not_all_that_bars_the_way_is_told_with_who_else_does(bob_m, here):
    """Beside Ada 0.75 m are free; Bob stands in the same corridor, between her and the robot."""
    both = (CORRIDOR % {"wide": 1.2, "y": 0.25}).replace("goals:", f"  bob: {{at_m: [9, {bob_m}]}}\ngoals:")
    Path("gap.scenario.yaml").write_text(both, encoding="utf-8")
    (told,) = prepare(load_scenario("gap.scenario.yaml")).unmet
    assert told.together
    assert [one.text for one in told.conditions] == [
        "the gap beside ada were 11 cm wider",
        "bob stood elsewhere",
    ]


@settings(max_examples=15, deadline=None)
@given(st.integers(20, 58))
def test_a_gap_that_is_too_narrow_is_told_with_its_width_and_with_what_the_robot_needs(gap_cm):
    """To a centimetre."""
    y = 1.5 + gap_cm / 100
    posts = f"{{name: low, box_m: [9, 0, 0.3, 1.5]}}, {{name: high, box_m: [9, {y:g}, 0.3, {4 - y:g}]}}"
    found = reason("11.4, 2", furniture=posts)
    told = found.partition("; the robot needs ways 0.60 m wide, and none there is wider than ")[2]
    assert gap_cm <= round(100 * float(told.removesuffix(" m"))) <= gap_cm + 1


def test_of_somebody_who_is_walled_in_no_gap_is_told():
    assert "wide" not in reason("11.4, 2", furniture="{name: bar, box_m: [9, 0, 0.3, 4]}")


CORRIDOR = """\
schema_version: 1
name: corridor
place: {width_m: 13, height_m: %(wide)s}
robot: {at_m: [11, 0.5]}
people:
  ada: {at_m: [7, %(y)s], facing_deg: 180}
goals:
  - greet: ada
"""


@settings(max_examples=12, deadline=None)
@given(st.floats(1.1, 2.4), st.floats(0.0, 1.0))
def test_who_stands_in_a_corridor_with_their_back_to_the_robot_bars_the_way_unless_it_gets_past(wide, share):
    """And the run says at once what the plan says: nobody makes way for who comes to see them."""
    y = 0.25 + share * (wide - 0.5)
    beside = max(y, wide - y) - 0.2
    assume(abs(beside - 0.85) > 0.01)
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "corridor.scenario.yaml")
        path.write_text(CORRIDOR % {"wide": wide, "y": y}, encoding="utf-8")
        prepared = prepare(load_scenario(str(path)))
        told = prepared.asked.unreachable.get("ada")
        if beside > 0.85:
            assert told is None
            return
        assert "; ada bars the way: the widest gap, " in told
        where, width_m, needed_m = the_gap_told(told)
        assert where == "beside ada"
        assert (width_m, needed_m) == (rounded_down(beside), 0.86)
        episode = execute(prepared)
    assert (episode.outcome, episode.visits) == ("failed", ())
    assert episode.frames.time_s[-1] < 2.0


def test_whether_a_door_bars_the_way_is_asked_once(here: Path) -> None:
    """It takes a scene and its ways each time."""
    (here / "rooms.scenario.yaml").write_text(
        ROOMS % {"ada": "6.5, 2", "doors": "kitchen: closed", "furniture": "", "people": ""}
    )
    asked: list[Scene] = []

    def is_reached(scene: Scene) -> bool:
        asked.append(scene)
        return True

    scene = prepare(load_scenario("rooms.scenario.yaml")).scene
    assert barring(scene, "ada", [], is_reached) == "the door 'kitchen' is shut"
    assert [[door.is_open for door in scene.doors] for scene in asked] == [[True, True]]
