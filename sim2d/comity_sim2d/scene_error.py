"""What is wrong with a scene, and with whom or what in it."""

from __future__ import annotations

import math

from comity_fis.errors import InputError, Where

FARTHEST_M = 1000.0
"""No coordinate is farther out: it would be a slip of the pen (our choice)."""


class SceneError(InputError):
    """A scene that cannot be.

    Args:
        entity: Whom it is about: a name in the scene, `wall 2` for the second of the walls that bear no name,
            `room`, or `scene` for the whole.
        field: The value that is wrong, as the scene's classes call it; None where the place as such is wrong.
        expected: As for `InputError`; `got`, `remedy` and `where` too.
    """

    def __init__(
        self,
        *,
        entity: str,
        expected: str,
        got: str,
        remedy: str,
        field: str | None = None,
        where: Where | None = None,
    ) -> None:
        self.entity = entity
        self.field = field
        super().__init__(expected=expected, got=got, remedy=remedy, where=where)

    def __str__(self) -> str:
        place = f"{self.where}: " if self.where else ""
        return f"{place}{self.entity}: expected {self.expected}, got {self.got}. {self.remedy}"

    def at(self, where: Where) -> SceneError:
        """The same error, placed in a file."""
        return SceneError(
            entity=self.entity,
            field=self.field,
            expected=self.expected,
            got=self.got,
            remedy=self.remedy,
            where=self.where or where,
        )


def require_finite(entity: str, **values: float) -> None:
    """Coordinates and angles: numbers, and within `FARTHEST_M`.

    Raises:
        SceneError: With the name of the value that is not.
    """
    for field, value in values.items():
        if not math.isfinite(value) or abs(value) > FARTHEST_M:
            raise SceneError(
                entity=entity,
                field=field,
                expected=f"{field} as a number within {FARTHEST_M:g} of zero",
                got=f"{value}",
                remedy=f"Give {field} in metres or radians.",
            )


def require_between(entity: str, field: str, value: float, low: float, high: float) -> None:
    """A size, a speed or the like: a number in a closed range.

    Raises:
        SceneError: Where it is outside, or no number.
    """
    if not low <= value <= high:
        raise SceneError(
            entity=entity,
            field=field,
            expected=f"{field} in [{low:g}, {high:g}]",
            got=f"{value}",
            remedy=f"Choose a {field} within these bounds.",
        )
