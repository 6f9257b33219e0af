"""Values that cannot be are refused where they are made, with the field that is wrong."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from comity_fis import InputError
from comity_sim2d import (
    DockingPose,
    Door,
    Frames,
    Furniture,
    Group,
    PassersBy,
    Person,
    Ring,
    RobotBody,
    Room,
    Scene,
    SceneError,
    Sensor,
    Walk,
    Wall,
    World,
    draw_picture,
    measure,
    pose_blocker,
    read_frames_csv,
    spot_pose,
    write_gif,
)

NAN = math.nan
ROOM, ROBOT, ANNA = Room.rectangle(6.0, 4.0), RobotBody(1.0, 1.0), Person("anna", 4.0, 2.0, 0.0)
SCENE = Scene(ROOM, ROBOT, (ANNA,))


def _with_hole(hole: tuple[tuple[float, float], ...]) -> Scene:
    return replace(SCENE, room=replace(ROOM, holes=(hole,)))


COURT = _with_hole(((2.5, 1.5), (3.5, 1.5), (3.5, 2.5), (2.5, 2.5)))
CASES: dict[str, Callable[[], object]] = {
    "x_m": lambda: Person("anna", "4", 2.0, 0.0),
    "y_m": lambda: Person("anna", 4.0, None, 0.0),
    "heading_rad": lambda: RobotBody(1.0, 1.0, True),
    "name": lambda: Person(7, 4.0, 2.0, 0.0),
    "posture": lambda: Person("anna", 4.0, 2.0, 0.0, posture=3),
    "reacts": lambda: Person("anna", 4.0, 2.0, 0.0, reacts=3),
    "drive": lambda: RobotBody(1.0, 1.0, drive=3),
    "width_m": lambda: Room.rectangle("3", 4.0),
    "corners": lambda: Room([[0, 0], [6, 0], [6, 4]]),
    "corners of furniture": lambda: Furniture("table", ((0, 0), (1, 0), 3)),
    "start": lambda: Wall(3.0, (1.0, 1.0)),
    "end": lambda: Door("way", (1.0, 1.0), (2.0,)),
    "sigma_m": lambda: Sensor("a"),
    "members": lambda: Group("talk", ["anna", "ben"]),
    "route": lambda: Walk([(1.0, 1.0)]),
    "count": lambda: PassersBy(1.5),
    "people": lambda: Scene(ROOM, ROBOT, [ANNA]),
    "walls": lambda: Scene(ROOM, ROBOT, walls=(ANNA,)),
    "distance_m": lambda: DockingPose(-3.0, 0.0),
    "distance_m no number": lambda: DockingPose(NAN, 0.0),
    "bearing_deg": lambda: DockingPose(0.6, 1e9),
    "wanted_m": lambda: Ring("anna", NAN),
    "seconds": lambda: World(Scene(ROOM, ROBOT)).run(-1.0),
    "seconds no number": lambda: World(Scene(ROOM, ROBOT)).run(NAN),
    "seed": lambda: World(Scene(ROOM, ROBOT), seed=1.5),
    "posture that nobody takes": lambda: Person("anna", 4.0, 2.0, 0.0, posture="lying"),
    "keep_to": lambda: Scene(ROOM, ROBOT, keep_to="up"),
    "holes outside": lambda: _with_hole(((9.0, 9.0), (10.0, 9.0), (10.0, 10.0))),
    "holes partly outside": lambda: _with_hole(((5.0, 2.0), (7.0, 2.0), (7.0, 3.0))),
    "distance_m of a spot": lambda: spot_pose(SCENE, "anna", NAN, 0.0),
    "bearing_deg of a spot": lambda: pose_blocker(SCENE, "anna", 0.6, NAN),
    "control_hz": lambda: World(SCENE, control_hz=0),
    "control_hz in part": lambda: World(SCENE, control_hz=7.5),
    "physics_hz": lambda: World(SCENE, physics_hz=0),
    "heading_rad of who is moved": lambda: World(SCENE).move_person("anna", 4.0, 2.0, NAN),
    "path of a picture": lambda: draw_picture("a.foo", SCENE, World(SCENE).frames),
    "path without an ending": lambda: draw_picture("a", SCENE, World(SCENE).frames),
    "path of an animation": lambda: write_gif("b.png", SCENE, World(SCENE).frames),
    "width_px": lambda: draw_picture("a.png", SCENE, World(SCENE).frames, width_px=0),
    "width_px of an animation": lambda: write_gif("a.gif", SCENE, World(SCENE).frames, width_px=10**6),
    "fps": lambda: write_gif("a.gif", SCENE, World(SCENE).frames, fps=0),
    "speed": lambda: write_gif("a.gif", SCENE, World(SCENE).frames, speed=-1),
    "speed no number": lambda: write_gif("a.gif", SCENE, World(SCENE).frames, speed=NAN),
}
UNKNOWN: dict[str, Callable[[], object]] = {
    "person of the scene, got 'q'": lambda: draw_picture(
        "a.png", SCENE, World(SCENE).frames, rings=(Ring("q", 1.0),)
    ),
    "person of the scene, got 'r'": lambda: write_gif(
        "a.gif", SCENE, World(SCENE).frames, rings=(Ring("r", 1.0),)
    ),
    "multiple of control_hz": lambda: World(SCENE, control_hz=7),
    "place in the room for 'anna', got .99": lambda: World(SCENE).move_person("anna", 99.0, 1.0, 0.0),
    "place in the room for 'anna', got .nan": lambda: World(SCENE).move_person("anna", NAN, 1.0, 0.0),
    "place in the room for 'anna', got .'4'": lambda: World(SCENE).move_person("anna", "4", 1.0, 0.0),
    "place in the room for 'anna', got .3": lambda: World(COURT).move_person("anna", 3.0, 2.0, 0.0),
}
TIMES, POSES = np.arange(3.0), np.zeros((3, 2, 3))
FRAMES: dict[str, Callable[[], object]] = {
    "finite": lambda: Frames(("robot", "anna"), (0.25, 0.2), TIMES, POSES * NAN),
    "times that go up": lambda: Frames(("robot", "anna"), (0.25, 0.2), TIMES[::-1], POSES),
    "poses of the shape": lambda: Frames(("robot",), (0.25,), TIMES, POSES),
    "2 radii": lambda: Frames(("robot", "anna"), (0.25,), TIMES, POSES),
    "-1": lambda: Frames(("robot", "anna"), (0.25, -1.0), TIMES, POSES),
    "at least the robot": lambda: Frames((), (), TIMES, POSES[:, :0]),
    "at least one frame": lambda: measure(Frames(("robot", "anna"), (0.25, 0.2), TIMES[:0], POSES[:0])),
}


@pytest.mark.parametrize("case", CASES)
def test_a_value_that_cannot_be_is_refused_with_its_field(case: str, tmp_path, monkeypatch) -> None:
    monkeypatch.chdir(tmp_path)
    with pytest.raises(SceneError) as refused:
        CASES[case]()
    field = case.split(maxsplit=1)[0]
    assert refused.value.field == field or field in str(refused.value)
    assert not list(tmp_path.iterdir()), "nothing is drawn"


@pytest.mark.parametrize("case", UNKNOWN)
def test_who_is_not_there_and_a_place_that_is_none_are_refused(case: str, tmp_path, monkeypatch) -> None:
    monkeypatch.chdir(tmp_path)
    with pytest.raises(ValueError, match=case):
        UNKNOWN[case]()
    assert not list(tmp_path.iterdir()), "nothing is drawn"


def test_a_person_may_be_put_onto_things_and_onto_the_edge_of_the_room() -> None:
    world = World(SCENE)
    for x_m, y_m in ((ROBOT.x_m, ROBOT.y_m), (0.0, 0.0), (6.0, 2.0)):
        world.move_person("anna", x_m, y_m, 0.0)
        assert world.people[0].xy == (x_m, y_m)


@pytest.mark.parametrize("case", FRAMES)
def test_frames_that_no_world_can_have_made_are_refused(case: str) -> None:
    with pytest.raises(InputError, match=case):
        FRAMES[case]()


@pytest.mark.parametrize("content", [b"", b"\x00\xff", b"a,b\n1,2\n", b"t,entity,x,y,heading_rad,radius_m\n"])
def test_a_file_that_holds_no_frames_is_refused_with_its_name(content: bytes, tmp_path) -> None:
    file = tmp_path / "other.csv"
    file.write_bytes(content)
    with pytest.raises(InputError, match=r"other\.csv"):
        read_frames_csv(file)
