"""What the kinds of pydantic's errors mean, in the words of a person who writes a file."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from comity_fis.errors import closest
from comity_fis.listing import listed

Context = Mapping[str, Any]
"""The numbers and words that belong to one of pydantic's errors, such as the bound that was passed."""


@dataclass(frozen=True, slots=True)
class Complaint:
    """The parts of an `InputError`, without the place."""

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
"""The errors that say only that a value is of another type, and what would have been right."""

_HOW = {
    "text": "text (in quotes where it looks like a number)",
    _NUMBER: "a number (without quotes)",
    _WHOLE: "a whole number (without quotes)",
    _TRUTH: "`true` or `false` (without quotes)",
    _LIST: "lines that each start with a dash, or a list such as `[1, 2]`",
    _MAPPING: "a mapping such as `key: value`",
}


def _bound(number: float) -> str:
    """As short as it is exact: whole numbers have all their digits."""
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
"""By the end of a key; the first that fits."""


def of_type(called: str, kinds: Sequence[str], value: object) -> Complaint:
    """A value of another type than any of those that may stand there.

    Args:
        called: What messages call the value.
        kinds: What would have been right: values of `TYPES`, or other words such as "a mapping such as ...".
        value: What came.
    """
    right = listed(dict.fromkeys(kinds), "or")
    how = listed(dict.fromkeys(_HOW.get(kind, kind) for kind in kinds), "or")
    return Complaint(f"{called} as {right}", shown(value), f"Write {how}.")


def of_length(called: str, right: str, value: object) -> Complaint:
    """A list or mapping with too few or too many items; `right` says how many it may have."""
    got = shown(len(value)) if isinstance(value, Sequence | Mapping) else shown(value)
    return Complaint(f"{right} in {called}", got, f"Write {right}.")


def of_kind(kind: str, called: str, key: str, value: object, context: Context) -> Complaint | None:
    """What one of pydantic's errors says about one value.

    Args:
        kind: The error's type, as pydantic names it.
        called: What messages call the value.
        key: The key that it stands under; the end of it may name a unit.
        value: What came.
        context: What pydantic adds.

    Returns:
        None for a kind that this table does not know.
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
    """The complaint about a word that is none of those that may stand there instead of a list."""
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
    """A value as YAML writes it, cut where it is long."""
    if value is None:
        return "nothing"
    text = str(value).lower() if isinstance(value, bool) else repr(value)
    return text if len(text) <= limit else f"{text[: limit - 3]}..."
