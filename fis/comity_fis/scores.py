"""Hofstede's individualism scores: 69 countries, 3 regions, 6 part-populations.

They describe countries and not persons: a score is a prior with a wide spread. `data/individualism.csv`
names the source.
"""

from __future__ import annotations

import csv
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from typing import Literal, cast

from comity_fis.errors import InputError, closest

ScoreKind = Literal["country", "region", "part-population"]


@dataclass(frozen=True, slots=True)
class Score:
    """One row of the table."""

    key: str
    """ISO 3166 alpha-3 code of a country, name of a region or part-population."""
    kind: ScoreKind
    name: str
    value: int
    """0 (collectivist) to 100 (individualist); the table holds 6 to 91."""


@cache
def individualism_scores() -> tuple[Score, ...]:
    """All 78 rows, in the table's order."""
    text = files("comity_fis").joinpath("data/individualism.csv").read_text(encoding="utf-8")
    rows = csv.DictReader(line for line in text.splitlines() if not line.startswith("#"))
    return tuple(
        Score(row["key"], cast(ScoreKind, row["kind"]), row["name"], int(row["individualism"]))
        for row in rows
    )


def score(key: str, table: str = "individualism") -> float:
    """The score of a country, region or part-population.

    Args:
        key: ISO 3166 alpha-3 code (`DEU`), or the name of a region or part-population (`Arab countries`).
        table: Which table; `individualism` is the only one.

    Raises:
        InputError: if the table has no such row.
    """
    rows = {row.key: row for row in score_table(table)}
    if key not in rows:
        raise InputError(
            expected=f"a country code or a region's name in the table {table}; not every country has a score",
            got=repr(key),
            remedy=f"{closest(key, rows, {row.name: row.key for row in rows.values()})} "
            "Leave the culture out, or let the person name a region that has a score.",
        )
    return float(rows[key].value)


def score_table(table: str) -> tuple[Score, ...]:
    """The rows of a table.

    Raises:
        InputError: if there is no such table.
    """
    if table != "individualism":
        raise InputError(
            expected="a table of scores", got=repr(table), remedy=closest(table, ["individualism"])
        )
    return individualism_scores()
