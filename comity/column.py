"""One column of a CSV file as numbers, every complaint with its line."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from comity.csv_table import read_csv
from comity_fis import closest


@dataclass(frozen=True, slots=True)
class Column:
    """The numbers of one column."""

    file: str
    """The path as the user gave it."""
    name: str
    values: tuple[float, ...]
    """In the file's order."""
    empty: int
    """Cells that held nothing, and were skipped."""


def read_column(path: Path, name: str) -> Column:
    """The numbers of the column with this heading.

    Raises:
        InputError: if there is no such file or column, or a cell that is neither empty nor a finite number.
    """
    table = read_csv(path, [name])
    heading = table.heading
    if heading.count(name) != 1:
        got = f"{name!r}" if name not in heading else f"{name!r} {heading.count(name)} times"
        remedy = closest(name, [cell for cell in heading if cell]) if name not in heading else "Rename one."
        raise table.refusal("the heading of one column", got, remedy, table.line)
    index = heading.index(name)
    cells = [(row.line, row.cell(index)) for row in table.rows]
    return Column(
        file=table.file,
        name=name,
        values=tuple(table.number(cell, line) for line, cell in cells if cell),
        empty=sum(not cell for _, cell in cells),
    )
