"""How far somebody would like a robot to pass."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from comity_fis import Inference

DISTANCE = "conversational_distance"


def own_distance_m(values: Inference) -> float:
    """As far as they would like it to stop, between surfaces [m]."""
    return values[DISTANCE].number
