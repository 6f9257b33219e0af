"""ir-sim's social force model: one call is one step of everybody."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any

os.environ["MPLBACKEND"] = "Agg"


class System:
    """A square hall; `batched` is its group behaviour, else each agent has the behaviour of its own."""

    def __init__(self, description: dict[str, Any]) -> None:
        import irsim

        file = Path("world.yaml")  # in the worker's folder, where ir-sim keeps its log
        file.write_text(_world(description), encoding="utf-8")
        self.env = irsim.make(str(file.resolve()), display=False, log_level="ERROR")

    def one(self, _row: dict[str, float]) -> float:
        """A step; the mean of all x."""
        self.env.step()
        robots = self.env.robot_list
        return sum(float(robot.state[0, 0]) for robot in robots) / len(robots)


def _world(scene: dict[str, Any]) -> str:
    side = scene["side_m"]
    behaviour = "group_behavior" if scene["batched"] else "behavior"
    starts, goals = (
        "\n".join(f"      - [{x}, {y}, 0]" for x, y in scene[key]) for key in ("starts", "goals")
    )
    outline = f"[[0, 0], [{side}, 0], [{side}, {side}], [0, {side}], [0, 0]]"
    return f"""
world:
  height: {side}
  width: {side}
  step_time: {scene["step_s"]}
  control_mode: 'auto'
  collision_mode: 'unobstructed'
robot:
  - number: {len(scene["starts"])}
    distribution: {{name: 'manual'}}
    kinematics: {{name: 'omni'}}
    shape: {{name: 'circle', radius: 0.2}}
    state:
{starts}
    goal:
{goals}
    vel_max: [1.5, 1.5]
    vel_min: [-1.5, -1.5]
    {behaviour}: {{name: 'sfm', vmax: 1.3, neighbor_threshold: 5.0}}
obstacle:
  - shape: {{name: 'linestring', vertices: {outline}}}
"""
