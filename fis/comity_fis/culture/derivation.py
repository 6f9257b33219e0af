"""Facts that follow from others: a named culture has its score, through whatever door it is named."""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

from comity_fis.errors import InputError
from comity_fis.variables.variable import NominalVariable, NumericVariable, Variable


class Derived(NamedTuple):
    """What follows from a fact for one variable."""

    value: object
    """None where nothing follows."""
    source: str = ""
    """Where a score comes from."""
    note: str = ""
    """Why nothing follows."""


def derived(variable: Variable, fact: object, variables: Mapping[str, Variable]) -> Derived:
    """What a fact says of a variable that is derived from it.

    Args:
        variable: With a derivation.
        fact: As it was told.
        variables: Of the rulebook: the fact may be one of its own words, which no table of scores has.

    Raises:
        InputError: if a table translates the fact, and it is a code that no country has.
    """
    derivation = variable.derived_from
    assert derivation is not None
    if derivation.table is None or fact is None:
        return Derived(fact)
    if not isinstance(fact, str):
        if derivation.fact not in variables:
            raise InputError(
                expected=f"{derivation.fact} in words", got=repr(fact), remedy="Leave it out where unknown."
            )
        return Derived(None)  # the variable of the fact's own name says what it may be
    try:
        row = derivation.table.find(fact)
    except InputError:
        own = variables.get(derivation.fact)
        if not isinstance(own, NominalVariable) or fact not in own.categories:
            raise
        row = None
    if row is None:
        return Derived(None, note=derivation.table.without_score(fact))
    if isinstance(variable, NumericVariable):
        return Derived(row.value, source=row.source)
    return Derived(row.key)
