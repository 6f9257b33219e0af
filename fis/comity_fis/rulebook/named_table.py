"""The table of scores that a rulebook names: a shipped one, or a CSV file next to the rulebook."""

from __future__ import annotations

from os.path import normpath
from pathlib import Path

from comity_fis.errors import InputError, Location, Where
from comity_fis.scores.population_table import Population, PopulationTable, Score
from comity_fis.scores.score_file import read_populations, read_scores
from comity_fis.scores.shipped import INDIVIDUALISM, individualism
from comity_fis.validation.yaml_file import YamlFile
from comity_fis.variables.variable import NumericVariable


def named_scores(
    name: str, file: YamlFile, place: Location, *, column: str | None, variable: str
) -> PopulationTable[Score]:
    """The table with a score for each of its rows.

    Args:
        name: The name in the rulebook: `individualism`, or a path relative to the rulebook.
        file: The rulebook's file.
        place: Location of the name in the file.
        column: Heading of the scores' column, if the rulebook names it.
        variable: The derived variable; its name is the default heading.

    Raises:
        InputError: There is no such table, or it cannot be used; with file and line.
    """
    if name == INDIVIDUALISM:
        return individualism()
    with file.placing(*place):
        path, called = _found(name, file)
        return read_scores(path, column=column, near=(variable, path.stem), called=called, name=name)


def named_populations(name: str, file: YamlFile, place: Location) -> PopulationTable[Population]:
    """The table with all its rows; arguments and errors as for `named_scores`."""
    if name == INDIVIDUALISM:
        return individualism()
    with file.placing(*place):
        path, called = _found(name, file)
        return read_populations(path, called=called, name=name)


def refuse_outside(variable: NumericVariable, scores: PopulationTable[Score], file: YamlFile) -> None:
    """Reject a score outside the domain of the variable derived from it.

    Raises:
        InputError: With the line in the table's file.
    """
    for row in scores.rows:
        if row.value not in variable.domain:
            raise InputError(
                expected=f"{variable.name} as a number in its range {variable.domain}",
                got=f"{row.value:g}",
                remedy="Correct the cell, or the range in the rulebook.",
                where=Where(_found(scores.name, file)[1], row.line),
            )


def _found(name: str, file: YamlFile) -> tuple[Path, str]:
    """A CSV file, given with or without extension, and its name in messages.

    Raises:
        InputError: There is none.
    """
    for written in (name, f"{name}.csv"):
        path = file.path.parent / written
        if path.is_file():
            return path, normpath(Path(file.name).parent / written)
    raise InputError(
        expected=f"a table of scores: {INDIVIDUALISM}, or a CSV file relative to this file",
        got=f"{name!r}, and there is no such file",
        remedy="Check the path and its spelling; the file needs a column `country` and one of scores.",
    )
