"""A robot that comes no nearer says so, and what stands right beside it."""

from __future__ import annotations

import pytest

from comity_sim2d import DockingPose, Furniture, Person, RobotBody, Room, Scene, World
from comity_sim2d.robot.progress import BESIDE_M
from comity_sim2d.senses.active_faults import BASE


@pytest.mark.parametrize("gap_m", [0.01, 0.03, BESIDE_M + 0.01])
def test_whoever_comes_no_nearer_names_what_is_right_beside_it(gap_m: float) -> None:
    x, y = 2.0, 2.0
    box = Furniture.box("box", x - 0.25 - gap_m - 0.2, y, width_m=0.4, depth_m=0.4)
    ada = Person("ada", 5.0, 2.0, 3.14)
    world = World(Scene(Room.rectangle(7.0, 4.0), RobotBody(x, y), (ada,), furniture=(box,)))
    world.robot.dock("ada", DockingPose(0.8, 0.0), speed_m_s=0.5)
    world.faults.begin(BASE, "stuck")
    world.run(4.0)
    beside = f", {100 * gap_m:.0f} cm from the box" if gap_m < BESIDE_M else ""
    assert world.robot.motion()[:4] == ("running", f"no progress towards ada for 3 s{beside}", (), True)
