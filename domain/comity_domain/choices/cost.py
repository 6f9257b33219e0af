"""What things cost: whole centimetres of walking, or what is worth as much."""

from __future__ import annotations

import math

HARDLY_WANTED = 0.01
"""Below this desirability the logarithm goes on as its tangent, so that what nobody wants is dear, not
impossible: 5.6 times the weight at most. A cap would make all of it cost the same."""


def travel_cost(length_m: float) -> int:
    """The walking itself, in cm."""
    return round(100.0 * length_m)


def dislike(desirability: float) -> float:
    """How much an option of this desirability in [0, 1] is disliked: strictly less for a higher one.

    Costs that add up make -ln the natural scale: two options cost as much as one of the product of their
    desirabilities.
    """
    if desirability >= HARDLY_WANTED:
        return -math.log(desirability)
    return -math.log(HARDLY_WANTED) + (HARDLY_WANTED - desirability) / HARDLY_WANTED


def dislike_cost(desirability: float, weight_m: float) -> int:
    """The detour, in cm, that is worth taking rather than an option of this desirability in [0, 1]."""
    return round(100.0 * weight_m * dislike(desirability))
