"""Facts that follow from others: whoever names a culture has its score, through whatever door it is named."""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

from comity_fis.culture.scores import find_score, regions
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
        InputError: if a table translates the fact, and has nothing like it.
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
        row = find_score(fact, derivation.table)
    except InputError:
        own = variables.get(derivation.fact)
        if not isinstance(own, NominalVariable) or fact not in own.categories:
            raise
        row = None
    if row is None:
        return Derived(None, note=without_score(fact, derivation.table))
    if isinstance(variable, NumericVariable):
        return Derived(float(row.value), source=row.source)
    return Derived(row.key)


def without_score(culture: str, table: str) -> str:
    """The note about a culture of which a table of scores says nothing."""
    return (
        f"{culture} has no score in the table of {table}, and none is guessed: the rules are "
        f"told nothing of it. Whoever wants to may name a region: {', '.join(regions(table))}."
    )
