"""The columns of a table that a rulebook can use: its variables, and facts they are derived from."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from comity_fis.culture.derivation import Derived, derived
from comity_fis.errors import InputError, closest, shown
from comity_fis.inference.column import Columns, cells, read_columns
from comity_fis.inference.scalar import by_name
from comity_fis.variables.variable import NominalVariable, NumericVariable, Variable, told_names


def told_columns(
    rulebook: str, variables: Mapping[str, Variable], columns: Columns
) -> tuple[Columns, tuple[str, ...]]:
    """The columns by variable, and notes.

    Args:
        rulebook: Name of the rulebook, for messages.
        variables: Variables of the rulebook.
        columns: Columns of the table.

    Raises:
        InputError: The rulebook knows no column of the table.
    """
    facts = told_names(variables)
    names = list(by_name(columns, "columns by the name of a variable"))
    extra = [name for name in names if name not in facts]
    if len(extra) == len(names) > 0:
        raise InputError(
            expected=f"a column that is named after a variable of the rulebook {rulebook}",
            got=", ".join(map(shown, extra[:5])),
            remedy=closest(str(extra[0]), sorted(facts)),
        )
    notes = [_ignored(name, facts) for name in extra]
    told: dict[str, Any] = {name: columns[name] for name in variables if name in names}
    for name, variable in variables.items():
        fact = variable.derived_from and variable.derived_from.fact
        if fact and name not in told and fact in names:
            told[name], missing = _derived_column(variables, name, fact, columns)
            notes += missing
    return told, tuple(dict.fromkeys(notes))


def _ignored(name: object, facts: Iterable[str]) -> str:
    near = closest(str(name), sorted(facts))
    near = f" {near}" if near.startswith("Did you mean") else ""
    return f"the column {shown(name)} is ignored: no variable is called so.{near}"


def _derived_column(
    variables: Mapping[str, Variable], name: str, fact: str, columns: Columns
) -> tuple[NDArray[Any], list[str]]:
    """Values derived from a column of facts, and reasons where nothing can be derived."""
    variable, told = variables[name], variables.get(fact)
    words: Sequence[object] = (
        read_columns(variables, {fact: columns[fact]})[fact].words()
        if isinstance(told, NominalVariable)
        else cells(columns[fact], fact)
    )
    follows = _by_word(words, lambda word: derived(variable, word, variables))
    values = np.array([follows[word].value for word in words], dtype=object)
    if isinstance(variable, NumericVariable) and variable.derived_from and variable.derived_from.table:
        values = values.astype(np.float64)
    return values, [one.note for one in follows.values() if one.note]


def _by_word(words: Sequence[Any], follow: Callable[[Any], Derived]) -> dict[Any, Derived]:
    """The value derived from each distinct word, computed once; an error names the word's row."""
    follows: dict[Any, Derived] = {}
    for row, word in enumerate(words):
        if word not in follows:
            try:
                follows[word] = follow(word)
            except InputError as refusal:
                got = f"{refusal.got} in row {row}"
                raise InputError(expected=refusal.expected, got=got, remedy=refusal.remedy) from None
    return follows
