"""Costs in whole centimetres of walking, or its equivalent."""

from __future__ import annotations

import math

HARDLY_WANTED = 0.01
"""Desirability below which the logarithm is continued by its tangent, so that an undesirable option is
expensive but not impossible: at most 5.6 times the weight. A cap would make all such options equally
expensive."""


def travel_cost(length_m: float) -> int:
    """Cost of walking [cm]."""
    return round(100.0 * length_m)


def dislike(desirability: float) -> float:
    """Preference cost of a desirability in [0, 1], without unit: strictly decreasing.

    For additive costs, -ln is the natural scale: two options cost as much as one with the product of their
    desirabilities.
    """
    if desirability >= HARDLY_WANTED:
        return -math.log(desirability)
    return -math.log(HARDLY_WANTED) + (HARDLY_WANTED - desirability) / HARDLY_WANTED


def dislike_cost(desirability: float, weight_m: float) -> int:
    """The detour worth taking to avoid an option of this desirability in [0, 1] [cm]."""
    return round(100.0 * weight_m * dislike(desirability))
