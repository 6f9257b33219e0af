"""A table of scores from any CSV file with a column of countries.

The column is called `country` (or `key`, `code`, `iso3`, `alpha3`), in whatever case, and holds ISO 3166
codes or English names. Another name is that of a part-population, such as Kurdish; a region says so in a
column `kind`, and a column `name` may name a row.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from io import StringIO
from pathlib import Path
from typing import cast, get_args

from comity_fis.errors import unknown_word
from comity_fis.scores.iso3166 import NO_CODE, country, culture_name
from comity_fis.scores.population_table import Population, PopulationKind, PopulationTable, Score
from comity_fis.validation.csv_table import CsvTable, Row, csv_table, opened, short

COUNTRY = ("country", "key", "code", "iso3", "alpha3")
"""Headings of the column of countries; the first that is there counts."""
KIND, NAME = "kind", "name"
EXAMPLE = "country,power_distance"


def read_scores(
    path: Path,
    *,
    column: str | None = None,
    near: Sequence[str] = (),
    called: str | None = None,
    name: str | None = None,
) -> PopulationTable[Score]:
    """The rows of a CSV file that have a score; an empty cell is none.

    Args:
        path: Of the file.
        column: The heading of the scores; None for the only one that there is, or one of `near`.
        near: Names that the column may have, where there are several.
        called: What messages call the file; the path when None.
        name: What a rulebook writes for it; the path when None.

    Raises:
        InputError: if the file, its headings or a row cannot be used, with the line.
    """
    text, table = _read(path, called)
    place = _scores(table, column, near)
    heading = table.heading[place]
    rows = tuple(
        Score(
            population.key,
            population.kind,
            population.name,
            value=table.number(cell, row.line, f"a number as {heading}, or an empty cell"),
            cited=f"{path.name}, column {heading}, line {row.line}",
            line=row.line,
        )
        for row, population in _populations(table)
        if (cell := row.cell(place))
    )
    return PopulationTable(name or str(path), rows, heading, text)


def read_populations(
    path: Path, *, called: str | None = None, name: str | None = None
) -> PopulationTable[Population]:
    """All rows of a CSV file, whether or not they have a score; arguments as for `read_scores`."""
    text, table = _read(path, called)
    rows = tuple(population for _, population in _populations(table))
    return PopulationTable(name or str(path), rows, text=text)


def _read(path: Path, called: str | None) -> tuple[str, CsvTable]:
    file = called or str(path)
    with opened(path, file) as stream:
        text = stream.read()
    return text, csv_table(StringIO(text), COUNTRY, file)


def _populations(table: CsvTable) -> Iterator[tuple[Row, Population]]:
    headings = [heading.casefold() for heading in table.heading]
    place = next((headings.index(heading) for heading in COUNTRY if heading in headings), None)
    if place is None:
        raise table.refusal(
            "a column `country` with ISO 3166 codes or English names",
            f"the columns {', '.join(table.heading)}",
            f"Begin the file with a line such as `{EXAMPLE}`.",
            table.line,
        )
    lines: dict[str, int] = {}
    for row in table.rows:
        others = {word: row.cell(headings.index(word)) for word in (KIND, NAME) if word in headings}
        population = _population(table, row, row.cell(place), **others)
        if (before := lines.setdefault(population.key, row.line)) != row.line:
            raise table.refusal(
                "each country once",
                f"{population.name} here and in line {before}",
                "Remove one of the two.",
                row.line,
            )
        yield row, population


def _population(table: CsvTable, row: Row, words: str, *, kind: str = "", name: str = "") -> Population:
    kinds: tuple[PopulationKind, ...] = get_args(PopulationKind)
    known = country(words)
    kind = kind.casefold() or ("country" if known or not culture_name(words) else "part-population")
    if kind not in kinds:
        raise table.refusal(
            f"{', '.join(kinds)} or nothing as kind", short(kind), "Correct the cell.", row.line
        )
    if kind == "country":
        if known is None:
            raise table.refusal(
                "a country by ISO 3166 code or English name",
                short(words) if words else "an empty cell",
                f"{NO_CODE} A column `kind` says where a row is a region or part-population.",
                row.line,
            )
        return Population(known.alpha3, "country", name or known.name)
    if known is not None or not words:
        raise table.refusal(
            f"the name of a {kind}, which no country has",
            short(words) if words else "an empty cell",
            "Give it another name.",
            row.line,
        )
    return Population(words, cast(PopulationKind, kind), name or words)


def _scores(table: CsvTable, column: str | None, near: Sequence[str]) -> int:
    """The place of the column of scores."""
    if column is not None:
        if column not in table.heading:
            raise unknown_word(f"a column of {table.file}", column, table.heading)
        return table.heading.index(column)
    plain = [_plain(heading) for heading in table.heading]
    left = [place for place, heading in enumerate(plain) if heading not in (*COUNTRY, KIND, NAME)]
    named = [place for place in left if plain[place] in map(_plain, near)]
    if len(found := left if len(left) == 1 else named[:1]) == 1:
        return found[0]
    raise table.refusal(
        f"a column of scores beside the countries{f', called {near[0]}' if near and left else ''}",
        f"the columns {', '.join(table.heading)}",
        f"Name one, as in `column: {table.heading[left[0]]}` beside `table:` in the rulebook."
        if left
        else f"Begin the file with a line such as `{EXAMPLE}`.",
        table.line,
    )


def _plain(heading: str) -> str:
    return heading.casefold().replace("_", " ")
