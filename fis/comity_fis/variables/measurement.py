"""Levels of measurement: which arithmetic a variable's values allow.

Stevens, "On the Theory of Scales of Measurement", Science 103 (1946). The paper classifies its cultural
variables by these levels; a membership function over numbers, a cluster centre or a mean requires at least an
interval scale.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import IntEnum

from comity_fis.errors import InputError, closest


class Level(IntEnum):
    """Levels in ascending order of the operations they allow."""

    NOMINAL = 0
    """Values are equal or not: gender, nationality."""
    ORDINAL = 1
    """Values are ordered: an ISCED level."""
    INTERVAL = 2
    """Differences are meaningful: latitude."""
    RATIO = 3
    """Zero means none, so ratios are meaningful: age."""

    def __str__(self) -> str:
        return self.name.lower()


def level_of(given: Level | str) -> Level:
    """A level, possibly given by its name, such as `ratio`.

    Raises:
        InputError: There is no such level.
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
    """A declared treatment of values at a higher level than their own; always shown."""

    to: Level
    reason: str
    """Why the rulebook's author accepts it."""


def effective_level(level: Level, coercion: Coercion | None) -> Level:
    """The level at which values are used."""
    return coercion.to if coercion else level


def level_text(level: Level, coercion: Coercion | None) -> str:
    """A level as shown to readers, such as `ordinal, treated as interval`."""
    return f"{level}, treated as {coercion.to}" if coercion else str(level)
