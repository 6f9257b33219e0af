"""One numeric column of a CSV file; every error names its line."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from comity_fis import closest
from comity_fis.validation.csv_table import CsvTable, read_csv
from comity_fis.variables.partitioning import MOST_SCORES

MISSING = {"", "NA"}
"""Skipped cells: missing values. R writes NA."""


@dataclass(frozen=True, slots=True)
class TableColumn:
    """The numbers of one column."""

    file: str
    """Path as given by the user."""
    name: str
    values: tuple[float, ...]
    """Values in the file's order."""
    empty: int
    """Number of skipped cells, empty or NA."""


def read_column(path: Path, name: str) -> TableColumn:
    """The numbers of the column with this heading.

    The separator (comma, semicolon or tab) is detected from the heading; with semicolons or tabs, a decimal
    comma counts as a point. Blank lines, and lines that start with `#`, are skipped; empty cells and `NA` are
    skipped and counted.

    Raises:
        InputError: if there is no such file or column, more values than can be clustered, a row with more
            cells than headings, or a cell that is neither empty nor a finite number.
    """
    with read_csv(path, [name]) as table:
        index = _place(name, table)
        values: list[float] = []
        missing = 0
        for row in table.rows:
            cell = row.cell(index)
            if cell in MISSING:
                missing += 1
                continue
            values.append(table.number(cell, row.line))
            if len(values) > MOST_SCORES:
                remedy = "Take a random sample of the rows: its terms are as good."
                raise table.refusal(f"at most {MOST_SCORES} numbers", "more", remedy, row.line)
        return TableColumn(table.file, name, tuple(values), missing)


def _place(name: str, table: CsvTable) -> int:
    """Index of the column in a row."""
    times = table.heading.count(name)
    if times == 1:
        return table.heading.index(name)
    got = f"{name!r} {times} times" if times else repr(name)
    remedy = "Rename one." if times else closest(name, [cell for cell in table.heading if cell])
    raise table.refusal("the heading of one column", got, remedy, table.line)
