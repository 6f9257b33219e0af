"""Facts that change over a life: a single value, or several with the first day of each."""

from __future__ import annotations

from datetime import date
from itertools import pairwise
from typing import Annotated, Any, Generic, TypeVar

from pydantic import (
    BaseModel,
    BeforeValidator,
    ConfigDict,
    Field,
    WithJsonSchema,
    field_validator,
    model_serializer,
)

from comity_fis import InputError, Interval, Where
from comity_fis.errors import WrongValueError
from comity_fis.validation.day import read_day

T = TypeVar("T")

OLDEST = 122
"""The highest known age of any person [years] (Jeanne Calment, 1875 to 1997)."""

UNKNOWN = "unknown"
"""Accepted in place of any fact."""


def read_day_or_year(words: object) -> date:
    """A day as in dated facts: 2004-07-01, or 2004 for its first day.

    Raises:
        WrongValueError: It is neither.
    """
    try:
        if isinstance(words, int) and not isinstance(words, bool):
            return date(words, 1, 1)
        if isinstance(words, str) and len(words) == 4:
            return date(int(words), 1, 1)
        return read_day(words)
    except (ValueError, OverflowError):  # includes `WrongValueError`, whose message does not mention years
        raise WrongValueError(
            expected="a day as YYYY-MM-DD, or a year",
            got=repr(words),
            remedy="Write for example 2010-06-01, or 2010 for its first day.",
        ) from None


def day_in_words(words: str, where: Where) -> date:
    """A day from an option, an argument or a table cell.

    Raises:
        InputError: It is not a day.
    """
    try:
        return read_day_or_year(words)
    except WrongValueError as error:
        raise error.at(where) from None


def require_some_time(from_: date | None, until: date | None) -> None:
    """Reject a period that ends before it begins.

    Raises:
        WrongValueError: `until` is not after `from`.
    """
    if from_ and until and until <= from_:
        raise WrongValueError(
            expected="`until` after `from`",
            got=f"from {from_} until {until}",
            remedy="Change one of the two.",
        )


def day_given(at: object) -> date | None:
    """A day given by a program: a date, a datetime, or text; None stays None.

    Raises:
        InputError: It is anything else.
    """
    if at is None or type(at) is date:
        return at
    if isinstance(at, date):
        return date(at.year, at.month, at.day)
    if isinstance(at, str):
        return day_in_words(at, Where("at"))
    raise InputError(
        expected="a date, or a day in words: YYYY-MM-DD",
        got=repr(at),
        remedy="Write for example '2026-11-27'.",
        where=Where("at"),
    )


Day = Annotated[
    date,
    BeforeValidator(read_day_or_year),
    WithJsonSchema({"type": ["string", "integer"], "description": "YYYY-MM-DD, or a year: its first day."}),
]


class Since(BaseModel, Generic[T]):
    """A value and the first day on which it holds, until the next value does."""

    model_config = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False)

    day: Day = Field(alias="from")
    value: T | None = Field(description="Null, or the word unknown: taken back.")

    @field_validator("value", mode="before")
    @classmethod
    def _told(cls, value: object) -> object:
        return None if value == UNKNOWN else value

    @model_serializer
    def _as_written(self) -> dict[str, Any]:
        value = UNKNOWN if self.value is None else self.value
        return {"from": self.day.isoformat(), "value": list(value) if isinstance(value, tuple) else value}


def in_order(value: Any) -> Any:
    """The fact, after checking that its dated values are in chronological order.

    Raises:
        WrongValueError: They are not, or there are none.
    """
    if value == ():
        raise WrongValueError(
            expected="at least one dated value",
            got="none",
            remedy="Leave the key out where nothing is known.",
        )
    if not is_dated(value):
        return value
    for earlier, later in pairwise(value):
        if later.day <= earlier.day:
            raise WrongValueError(
                expected="dated values from the oldest to the newest, one a day",
                got=f"{later.day} after {earlier.day}",
                remedy="Put them in the order of their days.",
            )
    return value


def held(dated: Any, day: date | None) -> tuple[Any, int | None]:
    """The value on a day, and its index in the list; None before the first day.

    Args:
        dated: A value, or dated values.
        day: The day; required for dated values.
    """
    if not is_dated(dated):
        return dated, None
    assert day is not None
    begun = [i for i, since in enumerate(dated) if since.day <= day]
    return (dated[begun[-1]].value, begun[-1]) if begun else (None, None)


def is_dated(value: object) -> bool:
    """Whether a fact is a list of dated values."""
    return isinstance(value, tuple) and any(isinstance(one, Since) for one in value)


def age_on(day: date, born: date | int) -> float | Interval:
    """Age on a day [years]; for a year of birth alone, the interval of the two possible ages.

    Raises:
        WrongValueError: The day is before the birth.
    """
    if day < (first := read_day_or_year(born)):
        raise WrongValueError(
            expected=f"a birth before the day in question, {day}",
            got=f"{born}, in the future of that day",
            remedy="Check the birth, or take a later day with --at.",
        )
    years = day.year - first.year
    if years > OLDEST + 1:
        raise WrongValueError(
            expected=f"a birth at most {OLDEST} years before the day in question, {day}",
            got=str(born),
            remedy="Check the birth, or take an earlier day with --at.",
        )
    if isinstance(born, date):
        return float(years - ((day.month, day.day) < (born.month, born.day)))
    return Interval(years - 1.0, float(years)) if years else 0.0


def undated(name: str) -> InputError:
    """The error for dated facts without a given day."""
    return InputError(
        expected=f"the day on which to take the facts of {name}",
        got="none",
        remedy="Give it with --at YYYY-MM-DD.",
    )
