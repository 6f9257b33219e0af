"""The error of a scene: what is wrong, and which person or thing it concerns."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from comity_fis.errors import LONGEST_SHOWN, InputError, Where, WrongValueError, closest

FARTHEST_M = 1000.0
"""No coordinate is farther out: it would be a slip of the pen (our choice)."""
NUMBERS = (float, int, np.floating, np.integer)


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


def is_number(value: object) -> bool:
    """Whether a value is a real number; neither true nor false, nor text that looks like one."""
    return isinstance(value, NUMBERS) and not isinstance(value, bool)


def is_near(value: object) -> bool:
    """Whether a value can be a coordinate or an angle."""
    return (
        isinstance(value, NUMBERS)
        and not isinstance(value, bool)
        and bool(-FARTHEST_M <= value <= FARTHEST_M)
    )


def require_finite(entity: str, **values: float) -> None:
    """Coordinates and angles: numbers, and within `FARTHEST_M`.

    Raises:
        SceneError: With the name of the value that is not.
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
    """A size, a speed or the like: a number in a closed range.

    Raises:
        SceneError: Where it is outside, or no number.
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
    """A count: a whole number in a closed range.

    Raises:
        SceneError: Where it is outside, or no whole number.
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
    """A name: text that is not blank.

    Raises:
        SceneError: about what kind of thing it would name.
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
    """A word out of a few.

    Raises:
        SceneError: With the nearest that is one.
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
    """Places in order: a tuple of pairs of coordinates.

    Raises:
        SceneError: For the first that is none.
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
    """Several of one kind, in a tuple: a list could change behind a frozen value's back.

    Raises:
        SceneError: Where it is no tuple, or holds something else.
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
    """What is said of a name that nobody and nothing bears."""
    remedy = closest(name if isinstance(name, str) else "", known)
    return WrongValueError(expected=expected, got=shown(name), remedy=remedy)


def shown(value: object) -> str:
    """What came, cut where it is long; of what cannot be written, its class."""
    try:
        text = f"{value}" if is_number(value) else repr(value)
    except Exception:  # of somebody else's class, of which anything may come
        return f"an object of the class {type(value).__name__}"
    return text if len(text) <= LONGEST_SHOWN else f"{text[: LONGEST_SHOWN - 1]}…"
