"""One variable for many people: a checked column, and the membership degrees of its literals."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import nan
from typing import Any

import numpy as np
from numpy.typing import NDArray

from comity_fis.errors import InputError, shown
from comity_fis.inference.scalar import is_number, scalar
from comity_fis.membership.arrays import degrees
from comity_fis.rules.antecedent import Literal, hedged
from comity_fis.variables.variable import NominalVariable, NumericVariable, Variable

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]
Columns = Mapping[str, Any]
"""By variable, one value per person: anything that numpy can convert to an array."""

UNDISCLOSED = -1
"""Index of an undisclosed category."""


@dataclass(frozen=True, slots=True)
class VariableColumn:
    """The values of one variable."""

    variable: Variable
    values: NDArray[Any]
    """Numbers, or indices of categories in declared order."""
    known: Bools | bool
    """Whether each person disclosed it; True: everyone."""
    own: tuple[str, ...] = ()
    """Free words of people; their indices follow those of the categories."""

    def part(self, rows: slice) -> VariableColumn:
        """The column for some of the people."""
        known = self.known if isinstance(self.known, bool) else self.known[rows]
        return VariableColumn(self.variable, self.values[rows], known, self.own)

    def words(self) -> list[str | None]:
        """The word of each person; None if undisclosed."""
        assert isinstance(self.variable, NominalVariable)
        by_number = (*self.variable.categories, *self.own, None)  # UNDISCLOSED counts from the end
        return [by_number[number] for number in self.values.tolist()]

    def degrees(self, literal: Literal) -> Floats:
        """Degrees of a literal on this variable; 1 if undisclosed."""
        term: Any = self.variable.terms[literal.term]
        if not isinstance(self.variable, NumericVariable):
            said = (*self.variable.categories, *self.own)
            words: Floats = np.array([term(word) for word in said], dtype=np.float64)
            by_number = np.append(hedged(words, literal), 1.0)  # UNDISCLOSED counts from the end
            of_rows: Floats = by_number[self.values]
            return of_rows
        found: Floats = hedged(degrees(term, self.values), literal)
        return found if isinstance(self.known, bool) else np.where(self.known, found, 1.0)


def read_columns(variables: Mapping[str, Variable], columns: Columns) -> dict[str, VariableColumn]:
    """Check all columns.

    Raises:
        InputError: If a value is outside its variable's domain, or columns differ in length.
    """
    read: dict[str, VariableColumn] = {}
    for name, values in columns.items():
        variable = variables[name]
        read[name] = (
            _numbers(variable, values) if isinstance(variable, NumericVariable) else _words(variable, values)
        )
    lengths = {name: len(column.values) for name, column in read.items()}
    if len(set(lengths.values())) > 1:
        raise InputError(
            expected="columns of one length",
            got=", ".join(f"{name} with {length}" for name, length in lengths.items()),
            remedy="Give every column one value per person; NaN or None where it is not known.",
        )
    return read


def cells(values: Any, name: str) -> list[Any]:
    """The values of a column as Python objects.

    Raises:
        InputError: if they are not values one after the other.
    """
    given = _given(values)
    if given is None or given.ndim != 1:
        raise _no_column(name, "values in one dimension", values)
    return [scalar(value) for value in given.tolist()]


def _given(values: Any, dtype: type[object] | None = None) -> NDArray[Any] | None:
    """A column as an array, objects where something is missing; None where it cannot be one."""
    try:
        masked = isinstance(values, np.ma.MaskedArray)
        given = np.array(values.tolist(), dtype=object) if masked else np.asarray(values, dtype)
    except Exception:  # an array-like may raise anything; whatever it is, it is no column
        return None
    return given.astype(object) if given.dtype.kind == "T" else given


def _numbers(variable: NumericVariable, values: Any) -> VariableColumn:
    given = _given(values)
    try:
        if given is None or given.ndim != 1 or given.dtype.kind not in "fiuO":
            raise ValueError
        if given.dtype.kind == "O":
            given = np.array([_number(scalar(value)) for value in given.tolist()], dtype=np.float64)
        numbers = given.astype(np.float64, copy=False)
    except (ValueError, OverflowError):
        raise _no_column(variable.name, "numbers in one dimension", values) from None
    if not len(numbers) or variable.domain.low <= numbers.min() <= numbers.max() <= variable.domain.high:
        return VariableColumn(variable, numbers, True)
    known = ~np.isnan(numbers)
    wrong = known & ~((numbers >= variable.domain.low) & (numbers <= variable.domain.high))
    if wrong.any():
        row = int(wrong.argmax())
        raise _in_row(variable, row, float(numbers[row]))
    return VariableColumn(variable, numbers, known)


def _number(value: object) -> float:
    if value is None:
        return nan
    if not is_number(value):
        raise ValueError
    return float(value)


def _words(variable: NominalVariable, values: Any) -> VariableColumn:
    as_told = None if hasattr(values, "dtype") else object  # else NaN becomes the word nan
    given = _given(values, as_told)
    if given is None or given.ndim != 1 or given.dtype.kind not in "iufUO":
        raise _no_column(variable.name, "categories, or their numbers, in one dimension", values)
    if given.dtype.kind in "UO":
        told = [scalar(value) for value in given.tolist()]
        if any(value is not None and not is_number(value) for value in told):
            return _column_of_words(variable, told)
        try:
            given = np.array([_number(value) for value in told], dtype=np.float64)
        except OverflowError:
            raise _no_column(variable.name, "categories, or their numbers", values) from None
    return _column(variable, _checked_numbers(variable, given, values))


def _column(
    variable: NominalVariable, numbers: NDArray[np.intp], own: tuple[str, ...] = ()
) -> VariableColumn:
    known = numbers != UNDISCLOSED
    return VariableColumn(variable, numbers, True if known.all() else known, own)


def _checked_numbers(variable: NominalVariable, given: NDArray[Any], values: Any) -> NDArray[np.intp]:
    """Categories by their numbers: NaN, where a table has one for what is missing, and -1 are undisclosed."""
    told = ~np.isnan(given) & (given != UNDISCLOSED)
    with np.errstate(invalid="ignore"):  # whatever is too large is no number of a category
        numbers = np.where(told, given - variable.first_number, UNDISCLOSED).astype(np.intp)
    if (told & (numbers + variable.first_number != given)).any():
        raise _no_column(variable.name, "categories, or their numbers, in one dimension", values)
    wrong = told & ((numbers < 0) | (numbers >= len(variable.categories)))
    if wrong.any():
        row = int(wrong.argmax())
        raise _in_row(variable, row, int(given[row]))
    return numbers


def _column_of_words(variable: NominalVariable, words: Sequence[object]) -> VariableColumn:
    numbers: dict[object, int] = {word: i for i, word in enumerate(variable.categories)}
    rows: list[int] = []
    for row, word in enumerate(words):
        try:
            said = word if word is None or word in numbers else variable.check(word)
        except (InputError, TypeError):
            raise _in_row(variable, row, word) from None
        rows.append(UNDISCLOSED if said is None else numbers.setdefault(said, len(numbers)))
    own = tuple(map(str, list(numbers)[len(variable.categories) :]))
    return _column(variable, np.array(rows, dtype=np.intp), own)


def _in_row(variable: Variable, row: int, value: object) -> InputError:
    """The refusal of one value, saying which one it is."""
    try:
        variable.check(value)
    except InputError as refusal:
        return InputError(expected=refusal.expected, got=f"{refusal.got} in row {row}", remedy=refusal.remedy)
    return InputError(
        expected=f"{variable.name} as a value of its domain",
        got=f"{value!r} in row {row}",
        remedy="Change it.",
    )


def _no_column(name: str, expected: str, values: object) -> InputError:
    return InputError(
        expected=f"{name} as a column of {expected}",
        got=shown(values),
        remedy="Give one value per person; NaN or None where it is not known.",
    )
