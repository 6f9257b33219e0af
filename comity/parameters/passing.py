"""How a person wants a robot to move near them, whether it visits or passes them."""

from __future__ import annotations

from typing import TYPE_CHECKING

from comity_domain.problem.bound_parameters import DISTANCE, SPEED

if TYPE_CHECKING:
    from comity_fis import Inference


def own_distance_m(values: Inference) -> float:
    """Preferred stopping distance, between surfaces [m]."""
    return values[DISTANCE].number


def asked_speed_m_s(values: Inference) -> float | None:
    """Approach speed that the person requested [m/s]; None if rules decide it.

    An inferred speed applies while the robot visits the person, a requested one whenever it is near.
    """
    speed = values[SPEED]
    return speed.number if speed.asked_for else None
