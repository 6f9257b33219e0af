"""Hofstede's individualism scores: 69 countries, 3 regions, 6 part-populations.

They describe countries and not persons: a score is a prior with a wide spread. `data/individualism.csv`
names the source.
"""

from __future__ import annotations

import csv
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from typing import Literal, cast

from comity_fis.culture.iso3166 import countries, country
from comity_fis.errors import InputError, closest

CITATION = "Hofstede, Hofstede & Minkov, Cultures and Organizations, 3rd edition, 2010 (data of 2015-08-16)"
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

    @property
    def source(self) -> str:
        """Whose score it is, and where it stands."""
        return f"the score of {self.name} is {self.value}: {CITATION}"


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
        key: What `find_score` understands.
        table: Which table; `individualism` is the only one.

    Raises:
        InputError: if the table has no such row.
    """
    found = find_score(key, table)
    if found is None:
        raise InputError(
            expected=f"a country or region with a score in the table {table}",
            got=f"{key!r}, which has none",
            remedy=f"Leave the culture out, or let the person name a region: {', '.join(regions(table))}.",
        )
    return float(found.value)


def find_score(words: str, table: str = "individualism") -> Score | None:
    """The row of a country, region or part-population; None for a country that has no score.

    Nothing is guessed for such a country: which region stands for it, if any, is for the person to say.

    Args:
        words: A region's or part-population's name, or a country by ISO 3166 code (`DEU`, `DE`) or English
            name, in whatever case.
        table: Which table.

    Raises:
        InputError: if the words are neither a country's nor a region's; with the closest ones.
    """
    rows = score_table(table)
    known = country(words)
    wanted = known.alpha3.casefold() if known else words.strip().casefold()
    found = next((row for row in rows if row.key.casefold() == wanted), None)
    if found is None and known is None:
        spellings = [name for one in countries() for name in one.spellings]
        raise InputError(
            expected="a country by ISO 3166 code or English name, or a region of the table of scores",
            got=repr(words),
            remedy=f"{_nearest(words, [*(row.name for row in rows), *spellings], table)} "
            "Leave the culture out, or add the region that the person feels at home in.",
        )
    return found


def regions(table: str = "individualism") -> tuple[str, ...]:
    """The regions that somebody may name whose country has no score."""
    return tuple(row.key for row in score_table(table) if row.kind == "region")


def _nearest(words: str, names: Sequence[str], table: str) -> str:
    """The closest name; of something as short as a code, whose letters say little, one that starts so."""
    start = words.strip().casefold()
    if len(start) <= 3:
        names = [name for name in names if start and name.casefold().startswith(start)]
    if len(several := _called(start)) > 1:
        return f"Did you mean {' or '.join(map(repr, several))}?"
    remedy = closest(words, names) if len(start) > 3 else f"Did you mean {names[0]!r}?" if names else ""
    return remedy if remedy.startswith("Did") else f"Regions of the table are: {', '.join(regions(table))}."


def _called(word: str) -> list[str]:
    """The countries that have a word in their name: `korea` is in those of two."""
    return sorted(one.name for one in countries() if word in one.name.casefold().split())


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
