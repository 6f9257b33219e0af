"""Explains pydantic's error types in the words of a person who writes a file."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from comity_fis.errors import closest
from comity_fis.listing import listed

Context = Mapping[str, Any]
"""Details of one of pydantic's errors, such as the bound that was exceeded."""


@dataclass(frozen=True, slots=True)
class Complaint:
    """The parts of an `InputError`, without the location."""

    expected: str
    got: str
    remedy: str


_NUMBER, _WHOLE = "a number", "a whole number"
_TRUTH = "true or false"
_LIST, _MAPPING = "a list", "a mapping of keys to values"

TYPES: Mapping[str, str] = {
    "string_type": "text",
    "float_type": _NUMBER,
    "float_parsing": _NUMBER,
    "int_type": _WHOLE,
    "int_parsing": _WHOLE,
    "int_from_float": _WHOLE,
    "bool_type": _TRUTH,
    "bool_parsing": _TRUTH,
    "list_type": _LIST,
    "tuple_type": _LIST,
    "dict_type": _MAPPING,
    "mapping_type": _MAPPING,
    "model_type": _MAPPING,
    "model_attributes_type": _MAPPING,
}
"""Errors that only say that a value has the wrong type, each with the expected one."""

_HOW = {
    "text": "text (in quotes where it looks like a number)",
    _NUMBER: "a number (without quotes)",
    _WHOLE: "a whole number (without quotes)",
    _TRUTH: "`true` or `false` (without quotes)",
    _LIST: "lines that each start with a dash, or a list such as `[1, 2]`",
    _MAPPING: "a mapping such as `key: value`",
}


def _bound(number: float) -> str:
    """As short as possible while exact: integers have all their digits."""
    return str(int(number)) if float(number).is_integer() else f"{number:g}"


_BOUNDS: Mapping[str, Callable[[Context], str]] = {
    "greater_than": lambda context: f"above {_bound(context['gt'])}",
    "greater_than_equal": lambda context: f"from {_bound(context['ge'])} up",
    "less_than": lambda context: f"below {_bound(context['lt'])}",
    "less_than_equal": lambda context: f"up to {_bound(context['le'])}",
}

_SIZES: Mapping[str, Callable[[Context], str]] = {
    "string_too_short": lambda context: f"at least {counted(context['min_length'], 'character')}",
    "string_too_long": lambda context: f"at most {counted(context['max_length'], 'character')}",
    "too_short": lambda context: f"at least {counted(context['min_length'], 'item')}",
    "too_long": lambda context: f"at most {counted(context['max_length'], 'item')}",
}

_UNITS = {
    "_m_s": " of metres per second",
    "_m_s2": " of m/s²",
    "_m_s3": " of m/s³",
    "_m": " of metres",
    "_s": " of seconds",
    "_deg": " of degrees",
}
"""Unit by the suffix of a key; the first match counts."""


def of_type(called: str, kinds: Sequence[str], value: object) -> Complaint:
    """The complaint about a value of an unexpected type.

    Args:
        called: Name of the value in messages.
        kinds: What was expected: values of `TYPES`, or other words such as "a mapping such as ...".
        value: The given value.
    """
    right = listed(dict.fromkeys(kinds), "or")
    how = listed(dict.fromkeys(_HOW.get(kind, kind) for kind in kinds), "or")
    return Complaint(f"{called} as {right}", shown(value), f"Write {how}.")


def of_length(called: str, right: str, value: object) -> Complaint:
    """The complaint about a list or mapping of the wrong length; `right` states the allowed one."""
    got = shown(len(value)) if isinstance(value, Sequence | Mapping) else shown(value)
    return Complaint(f"{right} in {called}", got, f"Write {right}.")


def of_kind(kind: str, called: str, key: str, value: object, context: Context) -> Complaint | None:
    """The complaint for one of pydantic's errors.

    Args:
        kind: The error's type in pydantic.
        called: Name of the value in messages.
        key: Key of the value; its suffix may name a unit.
        value: The given value.
        context: Details of the error.

    Returns:
        None for an unknown kind.
    """
    if kind in TYPES:
        return of_type(called, [TYPES[kind]], value)
    if kind in _BOUNDS:
        bound = _BOUNDS[kind](context)
        return Complaint(f"{called} {bound}", shown(value), f"Give a number{_unit(key)} {bound}.")
    if kind in _SIZES:
        size = _SIZES[kind](context)
        if isinstance(value, str):
            return Complaint(f"{called} with {size}", shown(value), f"Write {size}.")
        return of_length(called, size, value)
    if kind == "finite_number":
        return Complaint(f"{called} as a finite number", shown(value), f"Give a number{_unit(key)}.")
    return _of_choice(called, context["expected"], value) if kind == "literal_error" else None


def _of_choice(called: str, expected: str, value: object) -> Complaint:
    words = re.findall(r"'([^']*)'", expected)
    remedy = closest(value, words) if words and isinstance(value, str) else f"Write {expected}."
    return Complaint(f"{called} to be {expected}", shown(value), remedy)


def or_a_list(said: Complaint, value: object) -> Complaint:
    """The complaint about a word that is neither an allowed word nor a list."""
    example = value if isinstance(value, str) and value.isidentifier() else "a, b"
    return Complaint(
        f"{said.expected}, or a list", said.got, f"{said.remedy} A list has brackets: `[{example}]`."
    )


def _unit(key: str) -> str:
    return next((unit for end, unit in _UNITS.items() if key.endswith(end)), "")


def counted(count: int, one: str, more: str | None = None) -> str:
    """A count with its noun: `1 row`, `2 rows`, `2 studies`."""
    return f"{count} {one if count == 1 else more or one + 's'}"


def shown(value: object, limit: int = 60) -> str:
    """A value as YAML, truncated if it is long."""
    if value is None:
        return "nothing"
    text = str(value).lower() if isinstance(value, bool) else repr(value)
    return text if len(text) <= limit else f"{text[: limit - 3]}..."
