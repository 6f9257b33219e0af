"""Which row of the table of scores stands for a culture: its own, the one the person named, or none.

A country without a score is an honest question. Nothing is guessed for it: the rules are told nothing, and
the person may name a region.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

from comity_fis import InputError, NominalVariable, find_score, individualism_scores, regions
from comity_fis.culture.derivation import without_score

if TYPE_CHECKING:
    from comity.people.culture import Belonging
    from comity_fis import Rulebook, Score, Variable


@dataclass(frozen=True, slots=True)
class Standing:
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


def standing(belonging: Belonging, rulebook: Rulebook) -> Standing:
    """What follows from a culture.

    Raises:
        InputError: if it is neither a country nor a region, nor a category of the rulebook's own.
    """
    facts: dict[str, float | str] = {}
    sources: dict[str, str] = {}
    notes: list[str] = []
    region: str | None = None
    for variable in reads_culture(rulebook) if belonging.disclosed else ():
        if isinstance(variable, NominalVariable) and not _from_scores(variable):
            facts[variable.name] = variable.check(belonging.words)
            continue
        table = (variable.derived_from and variable.derived_from.table) or "individualism"
        row, region = _row(belonging, table)
        if row is None:
            notes.append(without_score(belonging.label(None), table))
        elif isinstance(variable, NominalVariable):
            facts[variable.name] = row.key
        else:
            facts[variable.name], sources[variable.name] = float(row.value), row.source
    return Standing(
        belonging.label(region), belonging.weight, facts, sources, tuple(dict.fromkeys(notes)), region
    )


def reads_culture(rulebook: Rulebook) -> tuple[Variable, ...]:
    """The variables of a rulebook that follow from the culture a person declares."""
    return tuple(
        variable
        for variable in rulebook.variables.values()
        if variable.name == "culture" or (variable.derived_from and variable.derived_from.fact == "culture")
    )


def _from_scores(variable: NominalVariable) -> bool:
    """Whether its categories are the keys of the table of scores, rather than the rulebook's own words."""
    return {row.key for row in individualism_scores()} <= set(variable.categories)


def _row(belonging: Belonging, table: str) -> tuple[Score | None, str | None]:
    """The row, and the region's name where it stands for the culture."""
    if belonging.region is not None:
        return _region(belonging.region, table), belonging.region
    try:
        found = find_score(belonging.words, table)
    except InputError:
        if belonging.otherwise is None:
            raise
        found = None
    if found is None and belonging.otherwise is not None:
        return _region(belonging.otherwise, table), belonging.otherwise
    return found, None


def _region(words: str, table: str) -> Score:
    found = find_score(words, table)
    if found is None:
        raise InputError(
            expected=f"a region with a score in the table of {table}",
            got=f"{words!r}, which has none",
            remedy=f"Name one of {', '.join(regions(table))}, or leave it out.",
        )
    return found
