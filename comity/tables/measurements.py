"""A table of measured (culture, parameter) tuples, from a CSV file."""

from __future__ import annotations

from collections.abc import Collection, Iterator
from dataclasses import dataclass
from difflib import get_close_matches
from pathlib import Path

from comity.tables.measurement import Measurement, RowReader, facts_of
from comity_fis import Rulebook
from comity_fis.validation.csv_table import CsvTable, read_csv, short

REQUIRED = ("parameter", "value", "unit")
OPTIONAL = ("study", "source", "measured", "partner", "n", "sd", "participant", "note")
MOST_ROWS = 5000
LIKE_KNOWN = 0.8
"""Minimum similarity to a known heading at which an unknown one is taken for a typo."""
SHIPPED = "small-studies"
"""The table that ships with Comity."""


@dataclass(frozen=True, slots=True)
class Measurements:
    """The rows of one file."""

    file: str
    rows: tuple[Measurement, ...]
    unused: tuple[str, ...]
    """Headings that the rulebook does not use."""


def read_measurements(name: str, rulebook: Rulebook, *, about: str = "") -> Measurements:
    """The rows of a file, each checked against the rulebook's parameters and variables.

    Args:
        name: Path of a file, or `small-studies` for the rows that ship with Comity.
        rulebook: The rulebook that the rows will be compared with.
        about: Parameter of rows that name none; if empty, the heading `parameter` is required.

    Raises:
        InputError: with the line of anything that cannot be used.
    """
    facts = facts_of(rulebook)
    known = [*REQUIRED, *OPTIONAL, *facts]
    with read_csv(table_path(name), known, called=name if name == SHIPPED else None) as table:
        _check_heading(table, known, [name for name in REQUIRED if not (about and name == "parameter")])
        reader = RowReader(table, rulebook, tuple(name for name in table.heading if name in facts), about)
        rows = tuple(_rows(table, reader))
    if not rows:
        remedy = "Add what a study measured."
        raise table.refusal("at least one row below the headings", "none", remedy, table.line)
    unused = tuple(name for name in table.heading if name and name not in known)
    return Measurements(table.file, rows, unused)


def table_path(name: str) -> Path:
    """Path of the table of that name; it may not exist."""
    return Path(__file__).parents[1] / "measured" / f"{SHIPPED}.csv" if name == SHIPPED else Path(name)


def _rows(table: CsvTable, reader: RowReader) -> Iterator[Measurement]:
    for count, row in enumerate(table.rows):
        if count == MOST_ROWS:
            raise table.refusal(f"at most {MOST_ROWS} rows", "more", "Split the file by study.", row.line)
        yield reader.measurement(row)


def _check_heading(table: CsvTable, known: Collection[str], required: Collection[str]) -> None:
    for name in table.heading:
        if name and table.heading.count(name) > 1:
            raise table.refusal("each heading once", f"{short(name)} twice", "Rename one.", table.line)
        if name not in known and (near := _slip(name, set(known) - set(table.heading))):
            raise table.refusal(
                "headings without slips",
                short(name),
                f"Did you mean {near!r}? Rename it otherwise.",
                table.line,
            )
    for name in required:
        if name not in table.heading:
            raise table.refusal(
                f"the headings {', '.join(required)}",
                f"none called {name!r}",
                "Add it; commas, semicolons or tabs separate headings.",
                table.line,
            )


def _slip(name: str, missing: Collection[str]) -> str | None:
    near = get_close_matches(name.lower(), sorted(missing), n=1, cutoff=LIKE_KNOWN)
    return near[0] if near else None
