"""Angles between directions, on the circle."""

from __future__ import annotations


def bearing_error_deg(one_deg: float, other_deg: float) -> float:
    """The angle between two directions, in [0, 180]: 179 and -179 degrees are 2 degrees apart."""
    return abs((one_deg - other_deg + 180.0) % 360.0 - 180.0)
