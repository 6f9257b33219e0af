"""Hofstede's individualism scores: 69 countries, 3 regions, 6 part-populations.

`data/individualism.csv` names the source.
"""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from importlib.resources import as_file, files

from comity_fis.errors import InputError
from comity_fis.scores.population_table import PopulationTable, Score
from comity_fis.scores.score_file import read_scores

INDIVIDUALISM = "individualism"
CITATION = "Hofstede, Hofstede & Minkov, Cultures and Organizations, 3rd edition, 2010 (data of 2015-08-16)"


@cache
def individualism() -> PopulationTable[Score]:
    """The table that comes with the package."""
    with as_file(files("comity_fis").joinpath("data/individualism.csv")) as path:
        table = read_scores(path)
    rows = tuple(replace(row, cited=CITATION) for row in table.rows)
    return PopulationTable(INDIVIDUALISM, rows)


def individualism_scores() -> tuple[Score, ...]:
    """All 78 rows, in the table's order."""
    return individualism().rows


def find_score(words: str) -> Score | None:
    """The row of individualism of a country, region or part-population: see `PopulationTable.find`."""
    return individualism().find(words)


def score(key: str) -> float:
    """The individualism of a country, region or part-population.

    Args:
        key: What `find_score` understands.

    Raises:
        InputError: if the table has no such row.
    """
    found = find_score(key)
    if found is None:
        raise InputError(
            expected="a country or region with a score in the table individualism",
            got=f"{key!r}, which has none",
            remedy="Leave the culture out, or let the person name a region: "
            f"{', '.join(individualism().regions)}.",
        )
    return found.value
