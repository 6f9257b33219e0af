"""Differences as people read them."""

from __future__ import annotations


def difference(value: float | None, unit: str | None, *, sign: bool = True) -> str:
    """`+9.4 cm`, `33.3 deg`, or a dash for nothing; metres in centimetres."""
    if value is None:
        return "-"
    scaled, unit = (100 * value, "cm") if unit == "m" else (value, unit)
    digits = 1 if unit in ("cm", "deg") else 3
    rounded = round(scaled, digits) + 0.0  # no negative zero
    return f"{rounded:{'+' if sign else ''}.{digits}f}{f' {unit}' if unit and unit != '1' else ''}"


def share(part: float) -> str:
    """A share as a whole percentage that says 0 and 100 only of none and all."""
    if 0 < part < 0.01:
        return "under 1 %"
    if 0.99 < part < 1:
        return "over 99 %"
    return f"{100 * part:.0f} %"


def counted(count: int, one: str, more: str | None = None) -> str:
    """`1 row`, `2 rows`, `2 studies`."""
    return f"{count} {one if count == 1 else more or one + 's'}"
