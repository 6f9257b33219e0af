"""One variable of many people: a checked column, and the degrees of its literals."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from comity_fis.errors import InputError
from comity_fis.membership.arrays import degrees
from comity_fis.rules.antecedent import Literal
from comity_fis.variables.variable import NominalVariable, NumericVariable, Variable

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]
Columns = Mapping[str, ArrayLike]
"""By variable, one value per person."""

UNDISCLOSED = -1
"""The number of no category."""


@dataclass(frozen=True, slots=True)
class Column:
    """The values of one variable."""

    variable: Variable
    values: NDArray[Any]
    """Numbers, or the numbers of categories in declared order."""
    known: Bools | bool
    """Who disclosed it; True: everybody."""

    def part(self, rows: slice) -> Column:
        """Some of the people."""
        known = self.known if isinstance(self.known, bool) else self.known[rows]
        return Column(self.variable, self.values[rows], known)

    def degrees(self, literal: Literal) -> Floats:
        """The degrees of a literal about the variable, 1 where it was not disclosed."""
        term: Any = self.variable.terms[literal.term]
        if not isinstance(self.variable, NumericVariable):
            words = [_as_said(np.float64(term(word)), literal) for word in self.variable.categories]
            by_number: Floats = np.array([*words, 1.0])  # UNDISCLOSED counts from the end
            of_rows: Floats = by_number[self.values]
            return of_rows
        found: Floats = _as_said(degrees(term, self.values), literal)
        return found if isinstance(self.known, bool) else np.where(self.known, found, 1.0)


def read_columns(variables: Mapping[str, Variable], columns: Columns) -> dict[str, Column]:
    """Every column, checked.

    Raises:
        InputError: if a value is outside its variable's domain, or columns differ in length.
    """
    read: dict[str, Column] = {}
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


def _numbers(variable: NumericVariable, values: ArrayLike) -> Column:
    try:
        given = np.asarray(values)
        if given.dtype.kind not in "fiuO" or given.ndim != 1:
            raise ValueError
        numbers = given.astype(np.float64, copy=False)
    except (TypeError, ValueError, OverflowError):
        raise _no_column(variable, "numbers in one dimension") from None
    if not len(numbers) or variable.domain.low <= numbers.min() <= numbers.max() <= variable.domain.high:
        return Column(variable, numbers, True)
    known = ~np.isnan(numbers)
    wrong = known & ~((numbers >= variable.domain.low) & (numbers <= variable.domain.high))
    if wrong.any():
        row = int(wrong.argmax())
        raise _in_row(variable, row, float(numbers[row]))
    return Column(variable, numbers, known)


def _words(variable: NominalVariable, values: ArrayLike) -> Column:
    given = np.asarray(values)
    if given.ndim != 1 or given.dtype.kind not in "iuUO":
        raise _no_column(variable, "categories, or their numbers, in one dimension")
    if given.dtype.kind in "iu":
        numbers = given.astype(np.intp, copy=False)
        wrong = (numbers < UNDISCLOSED) | (numbers >= len(variable.categories))
        if wrong.any():
            row = int(wrong.argmax())
            raise _in_row(variable, row, int(numbers[row]))
    else:
        numbers = _numbered(variable, given.tolist())
    known = numbers != UNDISCLOSED
    return Column(variable, numbers, True if known.all() else known)


def _numbered(variable: NominalVariable, words: Sequence[object]) -> NDArray[np.intp]:
    numbers: dict[object, int] = {word: i for i, word in enumerate(variable.categories)}
    numbers[None] = UNDISCLOSED
    try:
        return np.fromiter((numbers[word] for word in words), dtype=np.intp, count=len(words))
    except (KeyError, TypeError):
        row, word = next((i, w) for i, w in enumerate(words) if not isinstance(w, str) or w not in numbers)
        raise _in_row(variable, row, word) from None


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


def _no_column(variable: Variable, expected: str) -> InputError:
    return InputError(
        expected=f"{variable.name} as a column of {expected}",
        got="something else",
        remedy="Give one value per person; NaN or None where it is not known.",
    )


def _as_said(degrees: Any, literal: Literal) -> Any:
    """Degrees of a term as the literal wants them: hedged, and negated."""
    if literal.exponent != 1.0:
        degrees = degrees**literal.exponent
    return 1.0 - degrees if literal.negated else degrees
