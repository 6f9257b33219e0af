"""Facts derived from others: a named culture has a score, whichever way it is named."""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

from comity_fis.errors import InputError
from comity_fis.variables.variable import NominalVariable, NumericVariable, Variable


class Derived(NamedTuple):
    """The value of one variable derived from a fact."""

    value: object
    """The value; None if nothing follows."""
    source: str = ""
    """Source of a score."""
    note: str = ""
    """Reason why nothing follows."""


def derived(variable: Variable, fact: object, variables: Mapping[str, Variable]) -> Derived:
    """The value of a variable derived from a fact.

    Args:
        variable: With a derivation.
        fact: The disclosed fact.
        variables: Variables of the rulebook: the fact may be one of its own words, which no score table has.

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
