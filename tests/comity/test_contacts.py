"""What the robot touched is counted for what it is."""

from __future__ import annotations

from comity.monitoring.measuring import contacts
from comity_sim2d import Contacts, Furniture, PassersBy, Person, RobotBody, Room, Scene, Touch, Wall

SCENE = Scene(
    Room.rectangle(8.0, 6.0),
    RobotBody(1.0, 1.0, 0.0),
    people=(Person("ada", 6.0, 3.0, 0.0),),
    walls=(Wall((3.0, 0.0), (3.0, 2.0)),),
    furniture=(Furniture.box("box", 5.0, 5.0, width_m=0.5, depth_m=0.5),),
    passers_by=PassersBy(1),
)


def test_a_bump_into_a_passer_by_is_one_with_a_person():
    """They are people of the frames, and not of the scene."""
    people = ("ada", "passer-by 1")
    touched = ("passer-by 1", "ada", "passer-by 1", "wall 1", "box", "room")
    found = contacts(SCENE, people, [Touch(float(t), entity) for t, entity in enumerate(touched)])
    assert found == Contacts(3, 2, 1)
