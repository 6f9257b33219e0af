"""The row of the score table for a culture: its own, that of the region the person named, or none.

A country may have no score. Nothing is guessed for it: the rulebook's inputs stay unknown, and the person may
name a region instead.
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
    """A weighted culture, with the inputs that a rulebook derives from it."""

    label: str
    """Name of the culture."""
    weight: float
    facts: Mapping[str, float | str]
    """Derived values by variable, without unknown ones."""
    sources: Mapping[str, str]
    """Sources of derived scores, by variable."""
    notes: tuple[str, ...]
    region: str | None
    """The region that replaces the culture, as stated by the person."""


def standing(belonging: Belonging, rulebook: Rulebook) -> WeightedCulture:
    """The values derived from a culture.

    Raises:
        InputError: It is an unused country code, or the region that replaces it has no score.
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
    """Variables of a rulebook that are derived from a person's culture."""
    return tuple(
        variable
        for variable in rulebook.variables.values()
        if variable.name == "culture" or (variable.derived_from and variable.derived_from.fact == "culture")
    )


def _table(variable: Variable) -> Table | None:
    """The table of the variable's cultures; None if only the rulebook's categories define them."""
    if isinstance(variable, NominalVariable) and variable.table is not None:
        return variable.table
    return variable.derived_from.table if variable.derived_from else None


def _row(belonging: Belonging, table: Table, tables: Sequence[Table]) -> tuple[Population | None, str | None]:
    """The row for the culture, and the region's name if the region replaces it.

    Args:
        belonging: The culture.
        table: The table to search.
        tables: All tables of the rulebook.
    """
    if belonging.region is not None:
        return _region(belonging.region, table, tables), belonging.region
    found = table.find(belonging.words)
    if found is None and belonging.otherwise is not None:
        return _region(belonging.otherwise, table, tables), belonging.otherwise
    return found, None


def _region(words: str, table: Table, tables: Sequence[Table]) -> Population | None:
    """The row of a region; None if only another table has it."""
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
