"""Passers-by: anonymous people placed at random who walk about; no plan includes them."""

from __future__ import annotations

from dataclasses import dataclass

from comity_sim2d.pose import XY
from comity_sim2d.scene.robot_reaction import RobotReaction, require_reaction
from comity_sim2d.scene.walk import SPEED_M_S
from comity_sim2d.scene_error import SceneError, require_between, require_points, require_whole

SLOWEST_M_S, FASTEST_M_S = 0.6, 2.0
"""Limits of the random speeds of passers-by [m/s] (our choice)."""


@dataclass(frozen=True, slots=True)
class PassersBy:
    """A number of people who walk about while the world runs; in frames and metrics, but in no plan."""

    count: int
    between: tuple[XY, ...] = ()
    """Points between which they walk, to within `SPREAD_M` [m]; empty: anywhere. Each must have room to
    stand, and all must be connected."""
    speed_m_s: float = SPEED_M_S
    """Mean speed [m/s]; individuals differ with standard deviation `SPEED_SPREAD_M_S`."""
    reacts: RobotReaction = "regular"
    radius_m: float = 0.20

    def __post_init__(self) -> None:
        require_whole("passers_by", "count", self.count, 0, 1000)
        require_between("passers_by", "speed_m_s", self.speed_m_s, SLOWEST_M_S, FASTEST_M_S)
        require_between("passers_by", "radius_m", self.radius_m, 0.05, 2.0)
        require_reaction("passers_by", self.reacts)
        require_points("passers_by", "between", self.between)
        if len(set(self.between)) == 1:
            raise SceneError(
                entity="passers_by",
                field="between",
                expected="at least two different points, or none",
                got="one",
                remedy="Add where they go to.",
            )

    @property
    def names(self) -> tuple[str, ...]:
        """Their names in frames."""
        return tuple(f"passer-by {number}" for number in range(1, self.count + 1))
