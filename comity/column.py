"""One column of a CSV file as numbers, every complaint with its line."""

from __future__ import annotations

import csv
import re
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from math import isfinite
from pathlib import Path
from typing import TextIO

from comity_fis import InputError, Where, closest
from comity_fis.partitioning import MOST_SCORES

MAX_BYTES = 20_000_000
DELIMITERS, STRANGE = ",;\t", "|: "
"""Understood, and recognized so that a refusal can name them."""
MISSING = {"", "NA"}
"""Cells that are skipped: nobody answered. R writes NA."""
NUMBER = re.compile(r"[-+]?(\d+\.?\d*|\.\d+)([eE][-+]?\d+)?", re.ASCII)


@dataclass(frozen=True, slots=True)
class Column:
    """The numbers of one column."""

    file: str
    """The path as the user gave it."""
    name: str
    values: tuple[float, ...]
    """In the file's order."""
    empty: int
    """Cells that held nothing or NA, and were skipped."""


def read_column(path: Path, name: str) -> Column:
    """The numbers of the column with this heading.

    Fields are separated by commas, semicolons or tabs, whichever the heading shows; with semicolons or tabs
    a decimal comma counts as a point. Blank lines, and lines that start with `#`, are skipped; empty cells
    and `NA` are skipped and counted.

    Raises:
        InputError: if there is no such file or column, more values than can be clustered, or a cell that is
            neither empty nor a finite number.
    """
    with _opened(path) as file:
        lines = _Lines(file)
        first = next(lines, None)
        if first is None:
            raise _refusal(path, "a CSV file with a line of headings", "nothing", "Name a file with a table.")
        delimiter = _delimiter(first, name, path, lines.number)
        heading = [cell.strip() for cell in next(csv.reader([first], delimiter=delimiter))]
        if heading.count(name) != 1:
            got = f"{name!r}" if name not in heading else f"{name!r} {heading.count(name)} times"
            known = closest(name, [cell for cell in heading if cell])
            remedy = known if name not in heading else "Rename one."
            raise _refusal(path, "the heading of one column", got, remedy, lines.number)
        return _read(path, name, lines, delimiter, heading.index(name))


class _Lines(Iterator[str]):
    """Lines that count, one at a time: none that is blank or starts with `#`."""

    def __init__(self, file: TextIO) -> None:
        self._numbered = enumerate(file, 1)
        self.number = 0
        """Of the last one in the file, from 1."""

    def __next__(self) -> str:
        for number, line in self._numbered:
            self.number = number
            if line.strip() and not line.startswith("#"):
                return line
        raise StopIteration


def _read(path: Path, name: str, lines: _Lines, delimiter: str, index: int) -> Column:
    """The column below its heading; stops at the first value too many."""
    values: list[float] = []
    missing = 0
    try:
        for cells in csv.reader(lines, delimiter=delimiter):
            cell = cells[index].strip() if index < len(cells) else ""
            if cell in MISSING:
                missing += 1
                continue
            values.append(_number(cell, delimiter, path, lines.number))
            if len(values) > MOST_SCORES:
                raise _refusal(
                    path, f"at most {MOST_SCORES} numbers", "more",
                    "Take a random sample of the rows: its terms are as good.", lines.number,
                )  # fmt: skip
    except csv.Error as error:
        remedy = "Check the quotes around this line."
        raise _refusal(path, "fields of a CSV file", str(error), remedy, lines.number) from None
    return Column(str(path), name, tuple(values), missing)


@contextmanager
def _opened(path: Path) -> Iterator[TextIO]:
    """The file as text, with every refusal of the system as one of ours."""
    try:
        if not path.is_file():
            got = "a folder" if path.is_dir() else "no regular file" if path.exists() else "no such file"
            raise _refusal(path, "a CSV file", got, "Check the path and its spelling.")
        if path.stat().st_size > MAX_BYTES:
            raise _refusal(path, f"at most {MAX_BYTES} bytes", "more", "Take a sample of its rows.")
        with path.open(encoding="utf-8-sig") as file:
            yield file
    except UnicodeDecodeError:
        raise _refusal(path, "a CSV file", "a byte that is no UTF-8", "Save it as CSV in UTF-8.") from None
    except InputError:
        raise
    except (OSError, ValueError) as error:
        reason = (error.strerror if isinstance(error, OSError) else None) or str(error)
        raise _refusal(path, "a CSV file", reason, "Check the path and its permissions.") from None


def _delimiter(heading: str, name: str, path: Path, line: int) -> str:
    """The separator that shows the column, else the one that shows most columns."""
    fields = {delimiter: _fields(heading, delimiter) for delimiter in DELIMITERS + STRANGE}
    shows = [delimiter for delimiter in fields if name in fields[delimiter]]
    if shows and not set(shows) & set(DELIMITERS):
        raise _refusal(
            path, "columns separated by commas, semicolons or tabs", f"{shows[0]!r} between them",
            "Write the table again with one of these.", line,
        )  # fmt: skip
    return max(DELIMITERS, key=lambda delimiter: (delimiter in shows, len(fields[delimiter])))


def _fields(heading: str, delimiter: str) -> list[str]:
    """What the separator makes of a heading; nothing where it cannot be the separator."""
    try:
        return [cell.strip() for cell in next(csv.reader([heading], delimiter=delimiter))]
    except csv.Error:
        return []


def _number(cell: str, delimiter: str, path: Path, line: int) -> float:
    text = cell.replace(",", ".", 1) if delimiter != "," else cell
    if NUMBER.fullmatch(text) and isfinite(number := float(text)):
        return number
    shown = cell if len(cell) <= 40 else f"{cell[:37]}..."
    raise _refusal(
        path, "a finite number or an empty cell", repr(shown), "Correct the cell, or leave it empty.", line
    )


def _refusal(path: Path, expected: str, got: str, remedy: str, line: int | None = None) -> InputError:
    return InputError(expected=expected, got=got, remedy=remedy, where=Where(str(path), line))
