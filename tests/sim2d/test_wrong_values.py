"""Values that cannot be are refused where they are made, with the field that is wrong."""

from __future__ import annotations

import math
from collections.abc import Callable

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
    measure,
    read_frames_csv,
)

NAN = math.nan
ROOM, ROBOT, ANNA = Room.rectangle(6.0, 4.0), RobotBody(1.0, 1.0), Person("anna", 4.0, 2.0, 0.0)
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
def test_a_value_that_cannot_be_is_refused_with_its_field(case: str) -> None:
    with pytest.raises(SceneError) as refused:
        CASES[case]()
    field = case.split(maxsplit=1)[0]
    assert refused.value.field == field or field in str(refused.value)


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
