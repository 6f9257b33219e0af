"""The error for an invalid scene: what is wrong, and which person or thing it concerns."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from comity_fis.errors import LONGEST_SHOWN, InputError, Where, WrongValueError, closest

FARTHEST_M = 1000.0
"""Maximum absolute coordinate [m]: a larger one is a typo (our choice)."""
NUMBERS = (float, int, np.floating, np.integer)


class SceneError(InputError):
    """An invalid scene.

    Args:
        entity: The entity concerned: a name in the scene, `wall 2` for the second unnamed wall, `room`, or
            `scene` for the whole.
        field: Name of the wrong attribute; None if the place itself is wrong.
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


def is_number(value: object) -> bool:
    """Whether a value is a real number, not a boolean or a string."""
    return isinstance(value, NUMBERS) and not isinstance(value, bool)


def is_near(value: object) -> bool:
    """Whether a value is a valid coordinate or angle."""
    return (
        isinstance(value, NUMBERS)
        and not isinstance(value, bool)
        and bool(-FARTHEST_M <= value <= FARTHEST_M)
    )


def require_finite(entity: str, **values: float) -> None:
    """Check coordinates and angles: numbers within `FARTHEST_M`.

    Raises:
        SceneError: With the name of the invalid value.
    """
    for field, value in values.items():
        if not is_near(value):
            raise SceneError(
                entity=entity,
                field=field,
                expected=f"{field} as a number within {FARTHEST_M:g} of zero",
                got=shown(value),
                remedy=f"Give {field} in metres or radians.",
            )


def require_between(entity: str, field: str, value: float, low: float, high: float) -> None:
    """Check a size, a speed or the like: a number in a closed range.

    Raises:
        SceneError: If it is outside, or not a number.
    """
    if not is_number(value) or not low <= value <= high:
        raise SceneError(
            entity=entity,
            field=field,
            expected=f"{field} in [{low:g}, {high:g}]",
            got=shown(value),
            remedy=f"Choose a {field} within these bounds.",
        )


def require_whole(entity: str, field: str, value: int, low: int, high: int) -> None:
    """Check a count: an integer in a closed range.

    Raises:
        SceneError: If it is outside, or not an integer.
    """
    require_between(entity, field, value, low, high)
    if not isinstance(value, int | np.integer):
        raise SceneError(
            entity=entity,
            field=field,
            expected=f"{field} as a whole number",
            got=shown(value),
            remedy="Write it without a fraction.",
        )


def require_text(kind: str, field: str, value: str) -> None:
    """Check a name: a non-blank string.

    Raises:
        SceneError: With the kind of thing to be named.
    """
    if not isinstance(value, str) or not value.strip():
        raise SceneError(
            entity=kind,
            field=field,
            expected=f"a {field}",
            got=shown(value),
            remedy="Name it: messages, frames and pictures use the name.",
        )


def require_one_of(entity: str, field: str, value: str, choices: Iterable[str], *, what: str = "") -> None:
    """Check a choice among a few words.

    Raises:
        SceneError: With the nearest valid word.
    """
    known = tuple(choices)
    if not isinstance(value, str) or value not in known:
        raise SceneError(
            entity=entity,
            field=field,
            expected=f"a {what or field} out of {', '.join(known)}",
            got=shown(value),
            remedy=closest(value if isinstance(value, str) else "", known),
        )


def require_points(entity: str, field: str, points: tuple[tuple[float, float], ...]) -> None:
    """Check a tuple of coordinate pairs.

    Raises:
        SceneError: For the first invalid point.
    """
    require_tuple(entity, field, points, tuple, "points, each as `(x, y)`")
    for point in points:
        if len(point) != 2 or not (is_near(point[0]) and is_near(point[1])):
            raise SceneError(
                entity=entity,
                field=field,
                expected=f"{field} as pairs `(x, y)` of numbers within {FARTHEST_M:g} of zero",
                got=shown(point),
                remedy="Give each point two coordinates in metres.",
            )


def require_tuple(entity: str, field: str, values: object, kind: type | tuple[type, ...], what: str) -> None:
    """Check a tuple of values of one type: a list could change inside a frozen object.

    Raises:
        SceneError: If it is no tuple, or holds a value of another type.
    """
    wrong = [each for each in values if not isinstance(each, kind)] if isinstance(values, tuple) else [values]
    if wrong:
        raise SceneError(
            entity=entity,
            field=field,
            expected=f"{field} as a tuple of {what}",
            got=f"{type(wrong[0]).__name__} {shown(wrong[0])}",
            remedy=f"Write `{field}=(..., ...)`.",
        )


def unknown(expected: str, name: object, known: Iterable[str]) -> WrongValueError:
    """The error for an unknown name."""
    remedy = closest(name if isinstance(name, str) else "", known)
    return WrongValueError(expected=expected, got=shown(name), remedy=remedy)


def shown(value: object) -> str:
    """The received value as text, shortened if long; its class if it cannot be shown."""
    try:
        text = f"{value}" if is_number(value) else repr(value)
    except Exception:  # a foreign class may raise anything
        return f"an object of the class {type(value).__name__}"
    return text if len(text) <= LONGEST_SHOWN else f"{text[: LONGEST_SHOWN - 1]}…"
