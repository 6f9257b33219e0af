"""How a person would like a robot to move near them, whether it visits or passes them."""

from __future__ import annotations

from typing import TYPE_CHECKING

from comity_domain.problem.bound_parameters import DISTANCE, SPEED

if TYPE_CHECKING:
    from comity_fis import Inference


def own_distance_m(values: Inference) -> float:
    """As far as they would like it to stop, between surfaces [m]."""
    return values[DISTANCE].number


def asked_speed_m_s(values: Inference) -> float | None:
    """The approach speed that the person asked for [m/s]; None where the rules decide it.

    What the rules give holds while the robot visits the person, what they asked for whenever it is near.
    """
    speed = values[SPEED]
    return speed.number if speed.asked_for else None
