"""Whatever is put for one argument of the package's front door: it works, or the error names the argument."""

from __future__ import annotations

import inspect
import math
from collections.abc import Callable, Iterator, Mapping
from typing import Any

import numpy as np
import pytest
from hypothesis import HealthCheck, assume, given, settings
from hypothesis import strategies as st

import comity_sim2d
from comity_executor import ActGoal, MotionGoal
from comity_fis import ComityError
from comity_fis.defuzzification.curve import Curve
from comity_sim2d import (
    ActEvent,
    DockingPose,
    Door,
    Furniture,
    Person,
    Pose,
    RobotBody,
    Room,
    RouteMap,
    Scene,
    Span,
    TargetStop,
    Wish,
    World,
    measure,
    write_frames_csv,
)
from comity_sim2d.scene.obstacles import floor_plan


class Line:
    """A desirability that is the same everywhere."""

    domain = (0.3, 3.0)
    outline = ((0.3, 1.0), (3.0, 1.0))

    def __call__(self, x: float) -> float:
        return 1.0

    def height(self, low: float, high: float) -> float:
        return 1.0

    def centroid(self, low: float, high: float) -> float | None:
        return (low + high) / 2

    def sample(self, n: int = 101) -> tuple[tuple[float, float], ...]:
        return self.outline


CURVE: Curve = Line()
ROOM, ROBOT = Room.rectangle(6.0, 4.0), RobotBody(1.0, 1.0)
ANNA, BEN = Person("anna", 4.0, 2.0, math.pi), Person("ben", 4.0, 3.2, -math.pi / 2)
TABLE, DOOR = Furniture.box("table", 2.0, 3.4, width_m=0.6, depth_m=0.4), Door("way", (5.0, 0.0), (5.0, 1.0))
SCENE = Scene(ROOM, ROBOT, (ANNA, BEN), furniture=(TABLE,), doors=(DOOR,))
WORLD = World(SCENE)
WORLD.run(0.2)
FRAMES = WORLD.frames
SPAN = Span(0.0, 0.2)
WANTED = TargetStop("anna", SPAN, SPAN, 0.6, 0.0)
WISH = Wish("anna", 0.6, 0.0, CURVE, CURVE)
EVENT = ActEvent(0.0, 0.1, "say", "anna", "Hello.")
ROBOT_PARTS = {
    "spec": ROBOT,
    "physics": WORLD._physics,
    "senses": WORLD._senses,
    "clock": WORLD._clock,
    "controller": WORLD.robot._controller,
}

CALLS: Mapping[str, Mapping[str, Any]] = {
    "ActEvent": {"t_start": 0.0, "t_end": 1.0, "act": "say", "person": "anna", "text": "Hello."},
    "Area": {"name": "hall", "corners": ROOM.corners},
    "Comfort": {"near_m": 0.5, "far_m": 1.5},
    "Contacts": {},
    "DockingPose": {"distance_m": 0.6, "bearing_deg": 0.0},
    "Door": {"name": "way", "start": (0.0, 0.0), "end": (1.0, 0.0)},
    "DoorTurn": {"t": 0.0, "door": "way", "is_open": True},
    "Frames": {
        "entities": FRAMES.entities,
        "radius_m": FRAMES.radius_m,
        "time_s": FRAMES.time_s,
        "poses": FRAMES.poses,
    },
    "FramesFile": {"path": "grown.csv"},
    "Furniture": {"name": "table", "corners": TABLE.corners},
    "Furniture.box": {"name": "table", "x_m": 1.0, "y_m": 1.0, "width_m": 1.0, "depth_m": 1.0},
    "Furniture.circle": {"name": "table", "x_m": 1.0, "y_m": 1.0, "radius_m": 1.0},
    "Group": {"name": "talk", "members": ("anna", "ben")},
    "Known": {"visits": (WANTED,)},
    "Location": {"name": "shelf", "x_m": 1.0, "y_m": 1.0},
    "PassersBy": {"count": 2},
    "PastPeople": {"scene": SCENE},
    "Person": {"name": "anna", "x_m": 4.0, "y_m": 2.0, "heading_rad": 0.0},
    "PlaceMap": {"name": "ward", "room": ROOM},
    "Ring": {"person": "anna", "wanted_m": 0.6},
    "RobotBody": {"x_m": 1.0, "y_m": 1.0},
    "Room": {"corners": ROOM.corners},
    "Room.rectangle": {"width_m": 6.0, "height_m": 4.0},
    "RouteMap": {"scene": SCENE},
    "Scene": {"room": ROOM, "robot": ROBOT, "people": (ANNA, BEN)},
    "Sensor": {},
    "SimRobot": ROBOT_PARTS,
    "Span": {"start_s": 0.0, "end_s": 1.0},
    "Walk": {"route": ((1.0, 1.0), (2.0, 1.0))},
    "Wall": {"start": (0.0, 0.0), "end": (1.0, 0.0)},
    "TargetStop": {"person": "anna", "span": SPAN, "way": SPAN, "distance_m": 0.6, "bearing_deg": 0.0},
    "Wish": {
        "person": "anna",
        "distance_m": 0.6,
        "bearing_deg": 0.0,
        "distance_desirability": CURVE,
        "direction_desirability": CURVE,
    },
    "World": {"scene": SCENE},
    "carried_at": {"events": (EVENT,), "t": 0.0},
    "carryings": {"events": (EVENT,)},
    "choose_pose": {"route_map": RouteMap(SCENE), "start": (1.0, 1.0), "wish": WISH},
    "clearances_m": {"frames": FRAMES},
    "docked": {"robot": ROBOT.pose, "robot_radius_m": 0.25, "person": ANNA},
    "draw_picture": {"path": "drawn.png", "scene": SCENE, "frames": FRAMES, "width_px": 100},
    "free_bearing": {
        "scene": SCENE,
        "person": "anna",
        "distance_m": 0.6,
        "nominal_deg": 0.0,
        "low_deg": -90.0,
        "high_deg": 90.0,
    },
    "load_map": {"name": "apartment"},
    "measure": {"frames": FRAMES},
    "o_space": {"members": (ANNA, BEN)},
    "of_episode": {"metrics": measure(FRAMES)},
    "of_person": {"metrics": measure(FRAMES), "person": "anna"},
    "path_length_m": {"frames": FRAMES},
    "places": {"scene": SCENE},
    "pose_blocker": {"scene": SCENE, "person": "anna", "distance_m": 0.6, "bearing_deg": 0.0},
    "random_spot": {
        "plan": floor_plan(SCENE),
        "bodies": [((1.0, 1.0), 0.25)],
        "radius_m": 0.2,
        "rng": np.random.default_rng(0),
    },
    "read_frames_csv": {"path": "kept.csv"},
    "shipped_maps": {},
    "side_name": {"bearing_deg": 0.0},
    "speeds_m_s": {"frames": FRAMES},
    "spot_pose": {"scene": SCENE, "person": "anna", "distance_m": 0.6, "bearing_deg": 0.0},
    "standing_place": {"scene": SCENE, "route_map": RouteMap(SCENE), "name": "table"},
    "stopping": {"frames": FRAMES, "wanted": WANTED},
    "wrap_angle": {"angle_rad": 1.0},
    "write_frames_csv": {"path": "written.csv", "frames": FRAMES},
    "write_gif": {"path": "played.gif", "scene": SCENE, "frames": FRAMES, "width_px": 100},
}
"""What works of everything that is called from outside, by the names of its arguments."""

TOLD: Mapping[str, Mapping[str, Any]] = {
    "choose_pose": {
        "person": "anna",
        "distance_m": 0.6,
        "bearing_deg": 0.0,
        "distance_desirability": CURVE,
        "direction_desirability": CURVE,
    },
    "dock": {"person": "anna", "pose": DockingPose(0.6, 0.0), "speed_m_s": 0.5},
    "face": {"person": "anna"},
    "go": {"goal": MotionGoal("face", "anna")},
    "go_to": {"place": "table", "speed_m_s": 0.5},
    "heard": {"person": "anna"},
    "navigate": {"person": "anna", "pose": DockingPose(0.6, 0.0), "speed_m_s": 0.5},
    "perform": {"act": ActGoal("wave", "anna")},
    "read": {"person": "anna"},
    "stop": {"goal": None},
}
"""Commands to the robot of a world."""

DONE: Mapping[str, Mapping[str, Any]] = {
    "move_person": {"name": "anna", "x_m": 4.0, "y_m": 2.0, "heading_rad": 0.0},
    "run": {"seconds": 0.1},
    "set_door": {"name": "way", "open": False},
}
"""What is done to a world."""

RECORDS = {
    "Docked",
    "Metric",
    "Metrics",
    "MotionProgress",
    "OSpace",
    "PlannedRoute",
    "Pose",
    "PersonEstimate",
    "Route",
    "Said",
    "SceneError",
    "Stopping",
    "Touch",
}
"""What the package makes itself, at every tick or as an answer: nothing is looked into when it is made."""


NOUNS = {
    ("Frames", "radius_m"): "radii",
    ("Frames", "time_s"): "times",
    ("load_map", "name"): "file",
    ("move_person", "name"): "person",
    ("set_door", "name"): "door",
}
"""What a message may call an argument besides."""


class Alien:
    """Nothing that any argument could be."""


ODD: Mapping[str, Callable[[], object]] = {
    "None": lambda: None,
    "an alien": Alien,
    "the class of one": lambda: Alien,
    "text": lambda: "x",
    "no text": str,
    "bytes": lambda: b"x",
    "true": lambda: True,
    "zero": lambda: 0,
    "a negative number": lambda: -1,
    "no number": lambda: math.nan,
    "infinity": lambda: math.inf,
    "a number that no float holds": lambda: 10**400,
    "a number that has too many digits for text": lambda: 10**5000,
    "a complex number": lambda: 1j,
    "an array": lambda: np.zeros((2, 2)),
    "an empty tuple": tuple,
    "an empty list": list,
    "a tuple of what is none": lambda: (None,),
    "a list of what is none": lambda: [Alien()],
    "a pair": lambda: (1.0, 2.0),
    "pairs": lambda: ((1.0, "y"), (None, 2.0)),
    "three numbers": lambda: ((1.0, 2.0, 3.0),),
    "an empty mapping": dict,
    "a mapping": lambda: {"anna": "x", 3: None},
    "a set": lambda: {"anna"},
    "a function": lambda: len,
    "a person": lambda: ANNA,
    "a scene": lambda: SCENE,
}


def _called(name: str, known: Mapping[str, Any]) -> Callable[..., object]:
    """What a name of these tables stands for; of a world, a new one each time."""
    if known is TOLD:
        return getattr(World(SCENE, places={"table": Pose(1.0, 2.0, 0.0)}).robot, name)
    if known is DONE:
        return getattr(World(SCENE), name)
    found: Any = comity_sim2d
    for part in name.split("."):
        found = getattr(found, part)
    return found


def _cases() -> Iterator[tuple[str, Mapping[str, Any], str]]:
    for known in (CALLS, TOLD, DONE):
        for name in known:
            for argument in inspect.signature(_called(name, known)).parameters:
                yield name, known, argument


CASES = list(_cases())


def _try(name: str, known: Mapping[str, Any], argument: str, value: object) -> bool:
    """Whether it works with that value; where not, the error is held against what it has to say."""
    call = _called(name, known)
    try:
        result = call(**{**known[name], argument: value})
        if inspect.isgenerator(result):
            list(result)
        close = getattr(result, "_file", None)
        if close is not None:
            close.close()
    except ComityError as refusal:
        field, text = getattr(refusal, "field", None), str(refusal)
        nouns = (argument, NOUNS.get((name, argument), argument))
        assert field in nouns or any(noun in text for noun in nouns), f"{argument} is not named: {text}"
        assert "expected " in text, text
        assert ", got " in text, text
        assert len(text) < 700, text
        return False
    except OSError:
        assert argument == "path"
        return False
    return True


@pytest.fixture
def _in_a_folder(tmp_path, monkeypatch) -> None:
    monkeypatch.chdir(tmp_path)
    write_frames_csv("kept.csv", FRAMES)


def test_everything_that_can_be_called_is_in_the_tables() -> None:
    public = {name for name in comity_sim2d.__all__ if callable(getattr(comity_sim2d, name))}
    assert {name.split(".")[0] for name in CALLS} | RECORDS == public - {"RobotReaction"}


@pytest.mark.parametrize("table", [CALLS, TOLD, DONE], ids=["made", "told", "done"])
@pytest.mark.usefixtures("_in_a_folder")
def test_the_calls_work_as_they_are_written(table: Mapping[str, Mapping[str, Any]]) -> None:
    for name, arguments in table.items():
        _called(name, table)(**arguments)


@pytest.mark.parametrize(("name", "known", "argument"), CASES, ids=[f"{n}-{a}" for n, _, a in CASES])
@pytest.mark.usefixtures("_in_a_folder")
def test_whatever_is_put_for_one_argument_works_or_is_refused_by_its_name(
    name: str, known: Mapping[str, Any], argument: str
) -> None:
    for make in ODD.values():
        _try(name, known, argument, make())


@pytest.mark.parametrize(("name", "known", "argument"), CASES, ids=[f"{n}-{a}" for n, _, a in CASES])
@pytest.mark.usefixtures("_in_a_folder")
def test_what_can_be_no_argument_is_never_taken(name: str, known: Mapping[str, Any], argument: str) -> None:
    assert not _try(name, known, argument, Alien())
    assert not _try(name, known, argument, (Alien(),))


CLOSED = {
    "comfort",
    "hidden_by_walls",
    "is_open",
    "loop",
    "open",
    "passers_by",
    "pose_free",
    "sensor",
    "stopped",
    "stops",
    "success",
    "walk",
}
"""Arguments that are true or false, or one of the package's own values."""
FLAGS = [case for case in CASES if case[2] in CLOSED]


@pytest.mark.parametrize(("name", "known", "argument"), FLAGS, ids=[f"{n}-{a}" for n, _, a in FLAGS])
@pytest.mark.parametrize("word", ["x", "yes", "False", 1.5])
@pytest.mark.usefixtures("_in_a_folder")
def test_a_word_is_neither_true_nor_false_nor_one_of_the_packages_own_values(
    name: str, known: Mapping[str, Any], argument: str, word: object
) -> None:
    assert not _try(name, known, argument, word)


PLAIN = (
    st.none() | st.booleans() | st.integers(-3, 3) | st.floats() | st.text(max_size=3) | st.binary(max_size=2)
)
ANYTHING = st.recursive(
    PLAIN,
    lambda inner: (
        st.lists(inner, max_size=3)
        | st.lists(inner, max_size=3).map(tuple)
        | st.dictionaries(st.text(max_size=2), inner, max_size=2)
    ),
    max_leaves=6,
)


@settings(suppress_health_check=[HealthCheck.function_scoped_fixture], deadline=None, max_examples=300)
@given(case=st.sampled_from(CASES), value=ANYTHING)
@pytest.mark.usefixtures("_in_a_folder")
def test_so_is_anything_that_is_made_of_numbers_text_and_collections(
    case: tuple[str, Mapping[str, Any], str], value: object
) -> None:
    name, known, argument = case
    assume(not (isinstance(value, str) and argument in ("path", "name")))  # whatever is there, is
    _try(name, known, argument, value)
