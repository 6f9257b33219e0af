"""A CSV file as rows that know their line, whatever separates its fields."""

from __future__ import annotations

import csv
import re
from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass
from math import isfinite
from pathlib import Path

from comity_fis import InputError, Where

MAX_BYTES = 20_000_000
DELIMITERS = ",;\t"
NUMBER = re.compile(r"[-+]?(\d+\.?\d*|\.\d+)([eE][-+]?\d+)?", re.ASCII)
SHOWN = 40
"""Characters of a user's cell in a message."""


@dataclass(frozen=True, slots=True)
class Row:
    """The cells of one row."""

    line: int
    """In the file, from 1; of a row that a quoted cell spreads over several, the last."""
    cells: Sequence[str]

    def cell(self, index: int) -> str:
        """One cell without blanks around it; empty where the row is too short."""
        return self.cells[index].strip() if index < len(self.cells) else ""


@dataclass(frozen=True, slots=True)
class CsvTable:
    """A file's headings, and its rows as they are read one after the other."""

    file: str
    """What messages call it: the path as the user gave it."""
    line: int
    """Of the headings."""
    heading: tuple[str, ...]
    delimiter: str
    rows: Iterator[Row]

    def number(self, cell: str, line: int, what: str = "a finite number or an empty cell") -> float:
        """A cell's number; with semicolons or tabs as separators a decimal comma counts as a point.

        Raises:
            InputError: with the line, if it holds none.
        """
        text = cell.replace(",", ".", 1) if self.delimiter != "," else cell
        if NUMBER.fullmatch(text) and isfinite(number := float(text)):
            return number
        raise self.refusal(what, short(cell), "Correct the cell, or leave it empty.", line)

    def refusal(self, expected: str, got: str, remedy: str, line: int | None = None) -> InputError:
        """What is wrong with this file, and where."""
        return refusal(self.file, expected, got, remedy, line)


def read_csv(path: Path, wanted: Collection[str], *, called: str | None = None) -> CsvTable:
    """A table with a line of headings.

    Fields are separated by commas, semicolons or tabs, whichever the headings show. Blank lines, and lines
    that start with `#`, are skipped.

    Args:
        path: Of the file.
        wanted: Headings that tell which separator is meant.
        called: What messages call it; the path when None.

    Raises:
        InputError: if there is no such file, or it is no text; for a row that is no CSV, once it is read.
    """
    file = called or str(path)
    lines = _lines(path, file)
    if not lines:
        raise refusal(file, "a CSV file with a line of headings", "nothing", "Name a file with a table.")
    try:
        delimiter = _delimiter(lines[0][1], wanted)
    except csv.Error as error:
        raise _no_fields(file, error, lines[0][0]) from None
    rows = _rows(file, lines, delimiter)
    heading = tuple(cell.strip() for cell in next(rows).cells)
    return CsvTable(file, lines[0][0], heading, delimiter, rows)


def refusal(file: str, expected: str, got: str, remedy: str, line: int | None = None) -> InputError:
    """What is wrong with a file, and where."""
    return InputError(expected=expected, got=got, remedy=remedy, where=Where(file, line))


def short(cell: str) -> str:
    """A user's cell as a message quotes it."""
    return repr(cell if len(cell) <= SHOWN else f"{cell[: SHOWN - 3]}...")


def _lines(path: Path, file: str) -> list[tuple[int, str]]:
    """Every line that counts, with its number in the file."""
    try:
        if not path.is_file():
            got = "a folder" if path.is_dir() else "no such file"
            raise refusal(file, "a CSV file", got, "Check the path and its spelling.")
        if path.stat().st_size > MAX_BYTES:
            raise refusal(file, f"at most {MAX_BYTES} bytes", "more", "Take a sample of its rows.")
        text = path.read_text(encoding="utf-8-sig")
    except UnicodeDecodeError as error:
        got = f"a byte that is no UTF-8 at position {error.start}"
        raise refusal(file, "a CSV file", got, "Save it as CSV in UTF-8.") from None
    except (OSError, ValueError) as error:
        reason = (error.strerror if isinstance(error, OSError) else None) or str(error)
        raise refusal(file, "a CSV file", reason, "Check the path and its permissions.") from None
    numbered = enumerate(text.splitlines(), 1)
    return [(number, line) for number, line in numbered if line.strip() and not line.startswith("#")]


def _delimiter(heading: str, wanted: Collection[str]) -> str:
    """The separator that shows most of the wanted headings, else the one that shows most columns."""

    def fields(delimiter: str) -> list[str]:
        return [cell.strip() for cell in next(csv.reader([heading], delimiter=delimiter))]

    return max(
        DELIMITERS,
        key=lambda delimiter: (len(set(wanted) & set(fields(delimiter))), len(fields(delimiter))),
    )


def _rows(file: str, lines: list[tuple[int, str]], delimiter: str) -> Iterator[Row]:
    reader = csv.reader((f"{line}\n" for _, line in lines), delimiter=delimiter)
    try:
        for cells in reader:
            yield Row(lines[reader.line_num - 1][0], cells)
    except csv.Error as error:
        raise _no_fields(file, error, lines[min(reader.line_num, len(lines)) - 1][0]) from None


def _no_fields(file: str, error: csv.Error, line: int) -> InputError:
    return refusal(file, "fields of a CSV file", str(error), "Check the quotes around this line.", line)
