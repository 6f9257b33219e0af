"""Reads a CSV file row by row, with line numbers and any common delimiter."""

from __future__ import annotations

import csv
import re
from collections.abc import Collection, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from itertools import chain
from math import isfinite
from pathlib import Path
from typing import TextIO

from comity_fis.errors import InputError, Where
from comity_fis.validation.no_file import no_file
from comity_fis.validation.undecodable import undecodable

MAX_BYTES = 20_000_000
DELIMITERS, STRANGE = ",;\t", "|: "
"""Supported delimiters, and others that are recognised so that an error can name them."""
NUMBER = re.compile(r"[-+]?(\d+\.?\d*|\.\d+)([eE][-+]?\d+)?", re.ASCII)
SHOWN = 40
"""Maximum length of a user's cell in a message [characters]."""


@dataclass(frozen=True, slots=True)
class Row:
    """The cells of one row."""

    line: int
    """Line in the file, from 1; the last one of a row that spans several lines."""
    cells: Sequence[str]

    def cell(self, index: int) -> str:
        """A cell without surrounding blanks; empty if the row is too short."""
        return self.cells[index].strip() if index < len(self.cells) else ""


@dataclass(frozen=True, slots=True)
class CsvTable:
    """The headings of a file, and an iterator over its rows."""

    file: str
    """Name in messages: the path as the user gave it."""
    line: int
    """Line of the headings."""
    heading: tuple[str, ...]
    delimiter: str
    rows: Iterator[Row]

    def number(self, cell: str, line: int, what: str = "a finite number or an empty cell") -> float:
        """A cell as a number; with semicolons or tabs as delimiters, a decimal comma is accepted.

        Raises:
            InputError: The cell is not a number; with the line.
        """
        text = cell.replace(",", ".", 1) if self.delimiter != "," else cell
        if NUMBER.fullmatch(text) and isfinite(number := float(text)):
            return number
        raise self.refusal(what, short(cell), "Correct the cell, or leave it empty.", line)

    def refusal(self, expected: str, got: str, remedy: str, line: int | None = None) -> InputError:
        """An error about this file, with its line."""
        return refusal(self.file, expected, got, remedy, line)


@contextmanager
def read_csv(path: Path, wanted: Collection[str], *, called: str | None = None) -> Iterator[CsvTable]:
    """Open a table with a line of headings; its rows are read lazily.

    The delimiter is a comma, semicolon or tab, as found in the headings. Blank lines and lines that start
    with `#` are skipped.

    Args:
        path: Path of the file.
        wanted: Headings that identify the delimiter.
        called: Name in messages; None: the path.

    Raises:
        InputError: The file does not exist or is not text; while reading, a row is not CSV or has more cells
            than there are headings.
    """
    file = called or str(path)
    with opened(path, file) as text:
        yield csv_table(text, wanted, file)


def csv_table(text: TextIO, wanted: Collection[str], file: str) -> CsvTable:
    """The table in a text, see `read_csv`; its rows are read lazily.

    Raises:
        InputError: The text has no table.
    """
    lines = _Lines(text)
    first = next(lines, None)
    if first is None:
        raise refusal(file, "a CSV file with a line of headings", "nothing", "Name a file with a table.", 1)
    line, delimiter = lines.number, _delimiter(first, wanted, file, lines.number)
    rows = _rows(file, csv.reader(chain([first], lines), delimiter=delimiter), lines)
    heading = tuple(cell.strip() for cell in next(rows).cells)
    return CsvTable(file, line, heading, delimiter, _fitting(rows, heading, file))


def refusal(file: str, expected: str, got: str, remedy: str, line: int | None = None) -> InputError:
    """An error about a file, with its line."""
    return InputError(expected=expected, got=got, remedy=remedy, where=Where(file, line))


def short(cell: str) -> str:
    """A user's cell, shortened for a message."""
    return repr(cell if len(cell) <= SHOWN else f"{cell[: SHOWN - 3]}...")


class _Lines(Iterator[str]):
    """Iterates over lines that are neither blank nor start with `#`."""

    def __init__(self, file: TextIO) -> None:
        self._numbered = enumerate(file, 1)
        self.number = 0
        """Number of the last line in the file, from 1."""

    def __next__(self) -> str:
        for number, line in self._numbered:
            self.number = number
            if line.strip() and not line.startswith("#"):
                return line
        raise StopIteration


@contextmanager
def opened(path: Path, file: str) -> Iterator[TextIO]:
    """Open a CSV file as text; system errors become `InputError`s."""
    try:
        if not path.is_file():
            raise refusal(file, "a CSV file", no_file(path), "Check the path and its spelling.")
        if path.stat().st_size > MAX_BYTES:
            raise refusal(file, f"at most {MAX_BYTES} bytes", "more", "Take a sample of its rows.")
        with path.open(encoding="utf-8-sig") as text:
            yield text
    except UnicodeDecodeError:
        raise _no_text(path, file) from None
    except InputError:
        raise
    except (OSError, ValueError) as error:
        reason = (error.strerror if isinstance(error, OSError) else None) or str(error)
        raise refusal(file, "a CSV file", reason, "Check the path and its permissions.") from None


def _no_text(path: Path, file: str) -> InputError:
    """The error for a byte that is not UTF-8; the text decoded before may have begun in mid-file."""
    remedy = "Save it as CSV in UTF-8."
    try:
        path.read_bytes().decode("utf-8-sig")
    except UnicodeDecodeError as error:
        where, got = undecodable(error, file)
        return InputError(expected="a CSV file", got=got, remedy=remedy, where=where)
    return refusal(file, "a CSV file", "a byte that was no UTF-8", remedy)


def _delimiter(heading: str, wanted: Collection[str], file: str, line: int) -> str:
    """The delimiter that yields most of the wanted headings, or else most columns."""
    fields = {delimiter: _fields(heading, delimiter) for delimiter in DELIMITERS + STRANGE}
    shows = {delimiter: len(set(wanted) & set(fields[delimiter])) for delimiter in fields}
    strange = max(STRANGE, key=lambda delimiter: shows[delimiter])
    if shows[strange] and not any(shows[delimiter] for delimiter in DELIMITERS):
        raise refusal(
            file,
            "columns separated by commas, semicolons or tabs",
            f"{strange!r} between them",
            "Write the table again with one of these.",
            line,
        )
    return max(DELIMITERS, key=lambda delimiter: (shows[delimiter], len(fields[delimiter])))


def _fields(heading: str, delimiter: str) -> list[str]:
    """The headings by a delimiter; empty if it cannot be the delimiter."""
    try:
        return [cell.strip() for cell in next(csv.reader([heading], delimiter=delimiter))]
    except csv.Error:
        return []


def _rows(file: str, reader: Iterator[list[str]], lines: _Lines) -> Iterator[Row]:
    try:
        for cells in reader:
            yield Row(lines.number, cells)
    except csv.Error as error:
        raise _no_fields(file, error, lines.number) from None


def _fitting(rows: Iterator[Row], heading: Sequence[str], file: str) -> Iterator[Row]:
    """The rows, rejecting any with more non-empty cells than headings."""
    for row in rows:
        if any(cell.strip() for cell in row.cells[len(heading) :]):
            raise refusal(
                file,
                f"at most {len(heading)} cells in a row, one below each heading",
                str(len(row.cells)),
                "Put a cell that holds a separator in quotes, or add the missing heading.",
                row.line,
            )
        yield row


def _no_fields(file: str, error: csv.Error, line: int) -> InputError:
    return refusal(file, "fields of a CSV file", str(error), "Check the quotes around this line.", line)
