"""A scene that cannot be is refused, with the name of what is wrong."""

import math
from dataclasses import replace

import pytest

from comity_fis.errors import InputError, Where
from comity_sim2d import Furniture, Person, RobotBody, Room, Scene, SceneError, Wall

ROOM = Room.rectangle(5.0, 4.0)
ROBOT = RobotBody(0.6, 0.6)


def scene(*people: Person, robot: RobotBody = ROBOT, room: Room = ROOM, **more) -> Scene:
    return Scene(room, robot, people, **more)


def person(name: str = "ada", x: float = 3.0, y: float = 2.0, **more) -> Person:
    return Person(name, x, y, 0.0, **more)


TABLE = Furniture.box("table", 3.0, 2.0, width_m=1.0, depth_m=1.0)
BOWTIE = ((1.0, 1.0), (2.0, 2.0), (2.0, 1.0), (1.0, 2.0))

BAD = {
    "person in furniture": ("ada", lambda: scene(person(), furniture=(TABLE,))),
    "person in an inner wall": ("ada", lambda: scene(person(), walls=(Wall((3.1, 0.0), (3.1, 4.0)),))),
    "person outside": ("ada", lambda: scene(person(x=7.0))),
    "person half through the outer wall": ("ada", lambda: scene(person(x=0.1))),
    "two people in one place": ("bo", lambda: scene(person(), person("bo"))),
    "people whose discs overlap": ("bo", lambda: scene(person(), person("bo", x=3.39))),
    "robot over a person": ("robot", lambda: scene(person(x=1.0, y=0.6))),
    "robot outside": ("robot", lambda: scene(robot=RobotBody(-1.0, 1.0))),
    "robot in the table": ("robot", lambda: scene(robot=RobotBody(3.0, 2.0), furniture=(TABLE,))),
    "two of one name": ("ada", lambda: scene(person(), person(x=1.5))),
    "a person called as the robot": ("robot", lambda: scene(person("robot"))),
    "crossing room": ("room", lambda: scene(room=Room(BOWTIE))),
    "crossing furniture": ("rug", lambda: scene(furniture=(Furniture("rug", BOWTIE),))),
    "room without area": ("room", lambda: scene(room=Room(((0, 0), (1, 1), (2, 2))))),
    "not a number": ("ada", lambda: person(x=math.nan)),
    "infinite": ("robot", lambda: RobotBody(math.inf, 0.0)),
    "zero radius": ("ada", lambda: person(radius_m=0.0)),
    "zero size": ("room", lambda: Room.rectangle(0.0, 3.0)),
    "wall without length": ("wall", lambda: Wall((1.0, 1.0), (1.0, 1.0))),
    "nameless": ("people", lambda: person(" ")),
    "unknown posture": ("ada", lambda: person(posture="standin")),
    "too many": (
        "scene",
        lambda: scene(walls=tuple(Wall((0.0, 0.001 * k), (1.0, 0.001 * k)) for k in range(1001))),
    ),
}


@pytest.mark.parametrize("case", BAD)
def test_a_bad_scene_is_refused_and_names_the_culprit(case: str) -> None:
    entity, build = BAD[case]
    with pytest.raises(SceneError) as caught:
        build()
    assert caught.value.entity == entity
    assert isinstance(caught.value, InputError)
    assert caught.value.expected
    assert caught.value.got
    assert caught.value.remedy.endswith(("?", "."))


def test_an_error_keeps_its_entity_when_it_is_placed_in_a_file() -> None:
    with pytest.raises(SceneError) as caught:
        person(posture="standin")
    placed = caught.value.at(Where("room.yaml", 7))
    assert placed.entity == "ada"
    assert str(placed).startswith("room.yaml:7: ada: expected")
    assert "'standing'" in str(placed)


def test_people_may_touch_walls_and_each_other() -> None:
    """The limit is overlap, not nearness."""
    scene(person(x=0.2, y=2.0), person("bo", x=0.6001, y=2.0))


def test_a_wall_is_as_thick_as_it_says() -> None:
    scene(person(), walls=(Wall((3.4, 0.0), (3.4, 4.0), thickness_m=0.3),))
    with pytest.raises(SceneError):
        scene(person(), walls=(Wall((3.4, 0.0), (3.4, 4.0), thickness_m=0.5),))


@pytest.mark.parametrize(
    "written",
    [
        {"furniture": (Furniture("star", ((2.0, 2.0), (4.0, 3.0), (2.0, 3.0), (4.0, 2.0))),)},
        {"walls": (Wall((20.0, 20.0), (21.0, 20.0)),)},
    ],
)
def test_a_place_that_was_refused_is_refused_whoever_is_in_it(written) -> None:
    told = set()
    for people in ((), (), (Person("ada", 1.0, 1.0, 0.0),)):
        with pytest.raises(SceneError) as refused:
            Scene(Room.rectangle(8.0, 6.0), RobotBody(6.0, 5.0), people, **written)
        told.add(str(refused.value))
    assert len(told) == 1


def test_another_wall_in_a_place_that_can_be_is_looked_at() -> None:
    scene = Scene(Room.rectangle(8.0, 6.0), RobotBody(6.0, 5.0))
    with pytest.raises(SceneError, match="wholly outside"):
        replace(scene, walls=(Wall((20.0, 20.0), (21.0, 20.0)),))
    with pytest.raises(SceneError, match="wholly outside"):
        replace(scene, room=Room.rectangle(7.0, 6.0), walls=(Wall((7.5, 2.0), (7.5, 3.0)),))
