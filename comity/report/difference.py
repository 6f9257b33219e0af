"""Readable differences of values."""

from __future__ import annotations


def difference(value: float | None, unit: str | None, *, sign: bool = True) -> str:
    """A difference such as `+9.4 cm` or `33.3 deg`, or a dash for None; metres in centimetres."""
    if value is None:
        return "-"
    shown = shown_unit(unit)
    return f"{bare(value, unit, sign=sign)}{f' {shown}' if shown else ''}"


def bare(value: float | None, unit: str | None, *, sign: bool = True) -> str:
    """A difference without its unit."""
    if value is None:
        return "-"
    digits = 1 if unit in ("m", "deg") else 3
    rounded = round(100 * value if unit == "m" else value, digits) + 0.0  # no negative zero
    return f"{rounded:{'+' if sign else ''}.{digits}f}"


def shown_unit(unit: str | None) -> str:
    """Unit of displayed differences; empty for a plain number."""
    return {"m": "cm", "1": "", None: ""}.get(unit, str(unit))


def share(part: float) -> str:
    """A share as a whole percentage; 0 and 100 are shown only for exactly none and all."""
    if 0 < part < 0.01:
        return "under 1 %"
    if 0.99 < part < 1:
        return "over 99 %"
    return f"{100 * part:.0f} %"
