"""JuPedSim, its model of collision-free speeds: one call is one step of everybody."""

from __future__ import annotations

from typing import Any

import jupedsim


class System:
    """A square hall in which everybody walks to a place of their own, and stands there."""

    def __init__(self, description: dict[str, Any]) -> None:
        side = description["side_m"]
        self.simulation = jupedsim.Simulation(
            model=jupedsim.CollisionFreeSpeedModel(),
            geometry=[(0, 0), (side, 0), (side, side), (0, side)],
            dt=description["step_s"],
        )
        for start, goal in zip(description["starts"], description["goals"], strict=True):
            stage = self.simulation.add_waypoint_stage(tuple(goal), 0.2)
            journey = self.simulation.add_journey(jupedsim.JourneyDescription([stage]))
            self.simulation.add_agent(
                jupedsim.CollisionFreeSpeedModelAgentParameters(
                    journey_id=journey, stage_id=stage, position=tuple(start), radius=0.2
                )
            )

    def one(self, _row: dict[str, float]) -> float:
        """A step; the mean of all x."""
        self.simulation.iterate()
        places = [agent.position[0] for agent in self.simulation.agents()]
        return float(sum(places) / len(places))
