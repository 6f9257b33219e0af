"""Common spellings of units, and the known units that they mean."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from comity.testing.grammar.vocabulary import UNITS

_NAMES: Mapping[str, str] = {
    "m": "metre metres meter meters mtr mtrs",
    "cm": "centimetre centimetres centimeter centimeters cms",
    "mm": "millimetre millimetres millimeter millimeters mms",
    "in": "inch inches",
    "ft": "foot feet",
    "deg": "degree degrees degs °",
    "rad": "radian radians rads",
    "s": "second seconds sec secs",
    "m/s": "mps",
    "km/h": "kmh kph km/hr",
    "m/s^2": "m/s2 m/s²",
    "m/s^3": "m/s3 m/s³",
}
"""Other spellings by unit; minutes and miles are not among them."""
_PER: Mapping[str, str] = {"m/s": "m/s", "cm/s": "cm/s", "km/hour": "km/h", "km/h": "km/h"}
"""Unit by quotient of units."""
_KNOWN: Mapping[str, str] = {word: unit for unit, words in _NAMES.items() for word in words.split()} | {
    unit.lower(): unit for unit in UNITS
}
_PARTS: Mapping[str, str] = {
    **_KNOWN,
    "kilometre": "km",
    "kilometres": "km",
    "kilometer": "km",
    "kilometers": "km",
}


def unit_meant(words: Sequence[str]) -> str | None:
    """The unit meant by the next words, case-insensitive; None if unknown."""
    plain = [word.lower().rstrip(",;:.") for word in words[:3]]
    if plain[1:2] == ["per"]:
        above, below = (_PARTS.get(word, word) for word in (plain[0], plain[-1]))
        return _PER.get(f"{above}/{below}")
    return _KNOWN.get(plain[0]) if plain else None


def units_told() -> str:
    """Remedy that lists all units."""
    *others, last = sorted(UNITS)
    return f"Units are {', '.join(others)} and {last}."
