"""A table of countries, regions and part-populations, and what people may write to name one of its rows.

Scores describe countries and not persons: a score is a prior with a wide spread.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Generic, Literal, TypeVar

from comity_fis.errors import InputError
from comity_fis.scores.iso3166 import NO_CODE, culture_name

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
        """The row of a country, region or part-population; None for a culture that has none.

        Nothing is guessed for such a culture: which region stands for it, if any, is for the person to say.

        Args:
            words: A region's or part-population's name, or a country by ISO 3166 code (`DEU`, `DE`) or
                English name, in whatever case.

        Raises:
            InputError: for a code that no country has.
        """
        if (name := culture_name(words)) is None:
            raise InputError(
                expected="a culture: a country, a region, or what people call theirs",
                got=repr(words),
                remedy=f"{NO_CODE} Leave the culture out where it is unknown.",
            )
        return next((row for row in self.rows if row.key.casefold() == name.casefold()), None)

    def without_score(self, culture: str) -> str:
        """The note about a culture of which the table says nothing."""
        may = f" The person may name a region: {', '.join(self.regions)}." if self.regions else ""
        return (
            f"{culture} has no score in the table of {self.name}, and none is guessed: the rules are told "
            f"nothing of it.{may}"
        )
