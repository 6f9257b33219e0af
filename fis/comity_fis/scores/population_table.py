"""A table of countries, regions and part-populations, and what people may write to name one of its rows.

Scores describe countries and not persons: a score is a prior with a wide spread.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Generic, Literal, TypeVar

from comity_fis.errors import InputError, closest
from comity_fis.scores.iso3166 import countries, country

PopulationKind = Literal["country", "region", "part-population"]


@dataclass(frozen=True, slots=True)
class Population:
    """One row of a table."""

    key: str
    """ISO 3166 alpha-3 code of a country, name of a region or part-population."""
    kind: PopulationKind
    name: str


@dataclass(frozen=True, slots=True)
class Score(Population):
    """One row of a table of scores."""

    value: float
    """Of individualism 0 (collectivist) to 100 (individualist); that table holds 6 to 91."""
    cited: str
    """The publication, or the file, column and line."""
    line: int
    """In the table's file, from 1."""

    @property
    def source(self) -> str:
        """Whose score it is, and where it stands."""
        return f"the score of {self.name} is {self.value:.12g}: {self.cited}"


Row_co = TypeVar("Row_co", bound=Population, covariant=True)


@dataclass(frozen=True, slots=True)
class PopulationTable(Generic[Row_co]):
    """A table by whose rows a culture can be named."""

    name: str
    """As a rulebook writes it: `individualism`, or the path of a CSV file."""
    rows: tuple[Row_co, ...]
    column: str = ""
    """The heading of the scores in a CSV file."""
    text: str = field(default="", repr=False)
    """Of the CSV file, so that a run can keep it; empty for the table that is shipped."""

    @property
    def regions(self) -> tuple[str, ...]:
        """The regions that a person may name whose country has no score."""
        return tuple(row.key for row in self.rows if row.kind == "region")

    def find(self, words: str) -> Row_co | None:
        """The row of a country, region or part-population; None for a country that has none.

        Nothing is guessed for such a country: which region stands for it, if any, is for the person to say.

        Args:
            words: A region's or part-population's name, or a country by ISO 3166 code (`DEU`, `DE`) or
                English name, in whatever case.

        Raises:
            InputError: if the words are neither a country's nor a region's; with the closest ones.
        """
        known = country(words)
        wanted = known.alpha3.casefold() if known else words.strip().casefold()
        found = next((row for row in self.rows if row.key.casefold() == wanted), None)
        if found is None and known is None:
            names = [row.name for row in self.rows]
            raise InputError(
                expected="a country by ISO 3166 code or English name, or a region of the table of scores",
                got=repr(words),
                remedy=f"{nearest(words, names) or self._regions_are()}"
                "Leave the culture out, or add the region that the person feels at home in.",
            )
        return found

    def without_score(self, culture: str) -> str:
        """The note about a culture of which the table says nothing."""
        may = f" The person may name a region: {', '.join(self.regions)}." if self.regions else ""
        return (
            f"{culture} has no score in the table of {self.name}, and none is guessed: the rules are told "
            f"nothing of it.{may}"
        )

    def _regions_are(self) -> str:
        return f"Regions of the table are: {', '.join(self.regions)}. " if self.regions else ""


def nearest(words: str, names: Sequence[str] = ()) -> str:
    """A hint at the country, or other name, that is closest to what was written; empty where none is near.

    Of something as short as a code, whose letters say little, only names that start so are near.
    """
    names = [*names, *(spelling for one in countries() for spelling in one.spellings)]
    start = words.strip().casefold()
    if len(several := _called(start)) > 1:
        return f"Did you mean {' or '.join(map(repr, several))}? "
    if len(start) <= 3:
        names = [name for name in names if start and name.casefold().startswith(start)]
        return f"Did you mean {names[0]!r}? " if names else ""
    remedy = closest(words, names)
    return f"{remedy} " if remedy.startswith("Did") else ""


def _called(word: str) -> list[str]:
    """The countries that have a word in their name: `korea` is in those of two."""
    return sorted(one.name for one in countries() if word in one.name.casefold().split())
