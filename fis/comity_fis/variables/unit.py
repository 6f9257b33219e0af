"""Units of measured values, and their conversion to a parameter's unit."""

from __future__ import annotations

from collections.abc import Mapping
from math import pi

from comity_fis.errors import InputError

LENGTH = {"m": 1.0, "cm": 0.01, "mm": 0.001, "in": 0.0254, "ft": 0.3048}
ANGLE = {"deg": 1.0, "rad": 180 / pi}
SPEED = {"m/s": 1.0, "cm/s": 0.01, "km/h": 1 / 3.6}
QUANTITIES: tuple[Mapping[str, float], ...] = (LENGTH, ANGLE, SPEED)
"""Per quantity, the size of each unit in terms of the quantity's first unit."""


def factor(unit: str, wanted: str) -> float:
    """The factor that converts a number from `unit` to `wanted`.

    Raises:
        InputError: The two units measure different quantities.
    """
    if unit == wanted:
        return 1.0
    quantity = next((q for q in QUANTITIES if wanted in q), {wanted: 1.0})
    if unit not in quantity:
        raise InputError(
            expected=f"one of the units {', '.join(quantity)}" if len(quantity) > 1 else f"the unit {wanted}",
            got=repr(unit) if unit else "no unit",
            remedy=f"Write it in {wanted}." if unit else "Write the unit of the number beside it.",
        )
    return quantity[unit] / quantity[wanted]
