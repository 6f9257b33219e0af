"""What things cost: whole centimetres of walking, or what is worth as much."""

from __future__ import annotations

import math

LEAST_DESIRABILITY = 0.01
"""An option that nobody wants is dear, not impossible: -ln(0.01) is 4.6 times the weight."""


def travel_cost(length_m: float) -> int:
    """The walking itself, in cm."""
    return round(100.0 * length_m)


def dislike_cost(desirability: float, weight_m: float) -> int:
    """The detour, in cm, that is worth taking rather than an option of this desirability in [0, 1].

    Costs that add up make -ln the natural scale: two options cost as much as one of the product of their
    desirabilities.
    """
    return round(100.0 * weight_m * -math.log(max(desirability, LEAST_DESIRABILITY)))
