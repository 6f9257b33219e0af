"""Type checks of fields and arguments: any value of another type is rejected."""

from __future__ import annotations

import math
from collections.abc import Collection, Iterable, Mapping, Sequence
from pathlib import Path
from types import NoneType, UnionType
from typing import get_args

import numpy as np

from comity_fis.listing import listed
from comity_sim2d.scene_error import SceneError, is_number, require_tuple, shown

Kind = type | UnionType
"""A class, or a union of accepted classes such as `Walk | None`."""

TRUTH: Kind = bool | np.bool_
PATH: Kind = str | Path
MOST_EXACT = 2**53
"""Larger integers are not represented exactly by floats."""

_WORDS: Mapping[type, tuple[str, str]] = {
    bool: ("True or False", "Write True or False."),
    np.bool_: ("True or False", "Write True or False."),
    str: ("text", "Write it in quotes."),
    NoneType: ("None", "Leave it out."),
    Path: ("a path", "Name a file."),
    np.ndarray: ("an array", "Make one with `numpy.array(...)`."),
    Mapping: ("a mapping", "Write `{name: ..., ...}`."),
    Sequence: ("a list or a tuple", "Write `(..., ...)`."),
    Collection: ("several", "Write `(..., ...)`."),
    Iterable: ("several", "Write `(..., ...)`."),
}
"""Name of a class in messages, and how to obtain an instance; other classes go by their own name."""

_TAKEN: Mapping[str, str] = {
    "FloorPlan": "Take `floor_plan(scene)`.",
    "Frames": "Take `World.frames`, or `read_frames_csv(...)`.",
    "Generator": "Make one: `numpy.random.default_rng(0)`.",
    "Metrics": "Take what `measure(...)` gives.",
    "PoseBeside": "Make a `DockingPose(...)`.",
}
"""Plural names in messages, for classes not called by their name."""


def require_kinds(entity: str, /, **values: tuple[object, Kind]) -> None:
    """Check each value against its type, by name: `walk=(self.walk, Walk | None)`.

    Raises:
        SceneError: For the first value of another type.
    """
    for field, (value, kind) in values.items():
        if not isinstance(value, kind):
            raise _refusal(entity, field, value, kind)


def require_each(entity: str, field: str, values: Sequence[object], kind: Kind) -> None:
    """Check a list or a tuple of values of one type.

    Raises:
        SceneError: If it is neither, or holds a value of another type.
    """
    if isinstance(values, str) or not isinstance(values, Sequence):
        raise wrong(entity, field, f"{field} as a list or a tuple", values, "Write `(..., ...)`.")
    for value in values:
        if not isinstance(value, kind):
            called, remedy = _in_words(kind)
            raise wrong(entity, field, f"{field} that are each {called}", value, remedy)


def require_names(entity: str, field: str, names: Collection[object]) -> None:
    """Check a collection of names; a single string would be taken for its letters.

    Raises:
        SceneError: If it is not, or holds a value of another type.
    """
    several = isinstance(names, Collection) and not isinstance(names, str)
    if not several or not all(isinstance(name, str) for name in names):
        raise wrong(entity, field, f"{field} as a collection of names", names, "Write `(..., ...)`.")


def require_numbers(entity: str, /, **values: float | None) -> None:
    """Check unbounded numbers, such as times; None is allowed.

    Raises:
        SceneError: For the first value that is not a number.
    """
    for field, value in values.items():
        if value is not None and not (is_number(value) and -MOST_EXACT <= value <= MOST_EXACT):
            raise wrong(entity, field, f"{field} as a number", value, "Write a number, without quotes.")


def require_pairs(entity: str, field: str, pairs: object, what: str) -> None:
    """Check a tuple of pairs of unbounded numbers.

    Raises:
        SceneError: If it is not, or holds a value of another type.
    """
    require_tuple(entity, field, pairs, tuple, f"pairs `{what}`")
    for pair in pairs if isinstance(pairs, tuple) else ():
        if len(pair) != 2 or not all(is_number(each) and not math.isnan(each) for each in pair):
            raise wrong(entity, field, f"{field} as pairs `{what}` of numbers", pair, "Write two numbers.")


def _refusal(entity: str, field: str, value: object, kind: Kind) -> SceneError:
    called, remedy = _in_words(kind)
    return wrong(entity, field, f"{field} as {called}", value, remedy)


def wrong(entity: str, field: str, expected: str, value: object, remedy: str) -> SceneError:
    """The error for a value of the wrong type."""
    return SceneError(entity=entity, field=field, expected=expected, got=shown(value), remedy=remedy)


def _in_words(kind: Kind) -> tuple[str, str]:
    """The name of a type in messages, and the remedy for its first class."""
    classes: tuple[type, ...] = get_args(kind) if isinstance(kind, UnionType) else (kind,)
    words = [_WORDS.get(each) or _of_class(each.__name__) for each in classes]
    return listed((dict.fromkeys(word for word, _ in words)), "or"), words[0][1]


def _of_class(name: str) -> tuple[str, str]:
    article = "an" if name[0] in "AEIO" else "a"
    return f"{article} {name}", _TAKEN.get(name, f"Make one: `{name}(...)`.")
