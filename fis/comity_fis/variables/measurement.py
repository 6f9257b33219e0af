"""Levels of measurement: which arithmetic a variable's values allow.

Stevens, "On the Theory of Scales of Measurement", Science 103 (1946). The paper sorts its cultural variables
by these levels; a membership function over numbers, a cluster centre or a mean needs at least an interval
scale.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import IntEnum

from comity_fis.errors import InputError, closest


class Level(IntEnum):
    """Ordered from the level that allows least to the one that allows most."""

    NOMINAL = 0
    """Equal or not: gender, nationality."""
    ORDINAL = 1
    """Before or after: an ISCED level."""
    INTERVAL = 2
    """Differences mean something: latitude."""
    RATIO = 3
    """Zero means none: age."""

    def __str__(self) -> str:
        return self.name.lower()


def level_of(given: Level | str) -> Level:
    """A level, also by its name: `ratio`.

    Raises:
        InputError: if it is none.
    """
    if isinstance(given, Level):
        return given
    names = {str(level): level for level in Level}
    if not isinstance(given, str) or given not in names:
        raise InputError(
            expected="a level of measurement", got=repr(given), remedy=closest(str(given), names)
        )
    return names[given]


@dataclass(frozen=True, slots=True)
class Coercion:
    """A declared step over the level that the values have: shown, never silent."""

    to: Level
    reason: str
    """Why the rulebook's author accepts it."""


def effective_level(level: Level, coercion: Coercion | None) -> Level:
    """The level at which values are used."""
    return coercion.to if coercion else level


def level_text(level: Level, coercion: Coercion | None) -> str:
    """`ordinal, treated as interval`: a level as readers see it, wherever the variable is shown."""
    return f"{level}, treated as {coercion.to}" if coercion else str(level)
