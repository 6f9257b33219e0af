"""Which row of the table of scores stands for a culture: its own, the one the person named, or none.

A country without a score is an honest question. Nothing is guessed for it: the rules are told nothing, and
the person may name a region.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from comity_fis import InputError, NominalVariable, Score

if TYPE_CHECKING:
    from comity.people.culture import Belonging
    from comity_fis import Population, PopulationTable, Rulebook, Variable

    Table = PopulationTable[Population]


@dataclass(frozen=True, slots=True)
class WeightedCulture:
    """A culture as a rulebook sees it."""

    label: str
    """What it is called."""
    weight: float
    facts: Mapping[str, float | str]
    """What follows from it, by variable; without those that it says nothing of."""
    sources: Mapping[str, str]
    """Where these are from that are scores, by variable."""
    notes: tuple[str, ...]
    region: str | None
    """What stands for it because the person said so."""


def standing(belonging: Belonging, rulebook: Rulebook) -> WeightedCulture:
    """What follows from a culture.

    Raises:
        InputError: if it is a code that no country has, or the region that stands for it has no score.
    """
    facts: dict[str, float | str] = {}
    sources: dict[str, str] = {}
    notes: list[str] = []
    region: str | None = None
    variables = reads_culture(rulebook) if belonging.disclosed else ()
    tables = [table for table in map(_table, variables) if table is not None]
    for variable in variables:
        table = _table(variable)
        if table is None:
            facts[variable.name] = variable.check(belonging.words)
            continue
        row, stands = _row(belonging, table, tables)
        region = region or stands
        if isinstance(variable, NominalVariable):
            facts[variable.name] = row.key if row and stands else variable.check(belonging.words)
        elif isinstance(row, Score):
            facts[variable.name], sources[variable.name] = row.value, row.source
        else:
            notes.append(table.without_score(belonging.label(None)))
    return WeightedCulture(
        belonging.label(region), belonging.weight, facts, sources, tuple(dict.fromkeys(notes)), region
    )


def reads_culture(rulebook: Rulebook) -> tuple[Variable, ...]:
    """The variables of a rulebook that follow from the culture a person declares."""
    return tuple(
        variable
        for variable in rulebook.variables.values()
        if variable.name == "culture" or (variable.derived_from and variable.derived_from.fact == "culture")
    )


def _table(variable: Variable) -> Table | None:
    """The table that knows a culture by its names; None where only the rulebook's own words do."""
    if isinstance(variable, NominalVariable) and variable.table is not None:
        return variable.table
    return variable.derived_from.table if variable.derived_from else None


def _row(belonging: Belonging, table: Table, tables: Sequence[Table]) -> tuple[Population | None, str | None]:
    """The row, and the region's name where it stands for the culture.

    Args:
        belonging: The culture.
        table: The one to look into.
        tables: All that the rulebook looks into.
    """
    if belonging.region is not None:
        return _region(belonging.region, table, tables), belonging.region
    found = table.find(belonging.words)
    if found is None and belonging.otherwise is not None:
        return _region(belonging.otherwise, table, tables), belonging.otherwise
    return found, None


def _region(words: str, table: Table, tables: Sequence[Table]) -> Population | None:
    """The row of a region; None where only another table has it."""
    for one in (table, *tables):
        if (found := one.find(words)) is not None:
            return found if one == table else None
    raise InputError(
        expected=f"a region with a score in the table of {table.name}",
        got=f"{words!r}, which has none",
        remedy=f"Name one of {', '.join(table.regions)}, or leave it out."
        if table.regions
        else "Leave it out: the table has no regions.",
    )
