"""One column of a CSV file as numbers, every complaint with its line."""

from __future__ import annotations

import csv
import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from math import isfinite
from pathlib import Path

from comity_fis import InputError, Where, closest

MAX_BYTES = 20_000_000
DELIMITERS = ",;\t"
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
    """Cells that held nothing, and were skipped."""


@dataclass(frozen=True, slots=True)
class _Row:
    line: int
    cells: Sequence[str]


def read_column(path: Path, name: str) -> Column:
    """The numbers of the column with this heading.

    Fields are separated by commas, semicolons or tabs, whichever the heading shows; with semicolons or tabs
    a decimal comma counts as a point. Blank lines, and lines that start with `#`, are skipped.

    Raises:
        InputError: if there is no such file or column, or a cell that is neither empty nor a finite number.
    """
    lines = _lines(path)
    if not lines:
        raise _refusal(path, "a CSV file with a line of headings", "nothing", "Name a file with a table.")
    delimiter = _delimiter(lines[0][1], name)
    rows = _rows(path, lines, delimiter)
    heading = [cell.strip() for cell in next(rows).cells]
    if heading.count(name) != 1:
        got = f"{name!r}" if name not in heading else f"{name!r} {heading.count(name)} times"
        remedy = closest(name, [cell for cell in heading if cell]) if name not in heading else "Rename one."
        raise _refusal(path, "the heading of one column", got, remedy, lines[0][0])
    index = heading.index(name)
    cells = [(row.line, row.cells[index].strip() if index < len(row.cells) else "") for row in rows]
    return Column(
        file=str(path),
        name=name,
        values=tuple(_number(cell, delimiter, path, line) for line, cell in cells if cell),
        empty=sum(not cell for _, cell in cells),
    )


def _lines(path: Path) -> list[tuple[int, str]]:
    """Every line that counts, with its number in the file."""
    try:
        if not path.is_file():
            got = "a folder" if path.is_dir() else "no such file"
            raise _refusal(path, "a CSV file", got, "Check the path and its spelling.")
        if path.stat().st_size > MAX_BYTES:
            raise _refusal(path, f"at most {MAX_BYTES} bytes", "more", "Take a sample of its rows.")
        text = path.read_text(encoding="utf-8-sig")
    except UnicodeDecodeError as error:
        got = f"a byte that is no UTF-8 at position {error.start}"
        raise _refusal(path, "a CSV file", got, "Save it as CSV in UTF-8.") from None
    except (OSError, ValueError) as error:
        reason = (error.strerror if isinstance(error, OSError) else None) or str(error)
        raise _refusal(path, "a CSV file", reason, "Check the path and its permissions.") from None
    numbered = enumerate(text.splitlines(), 1)
    return [(number, line) for number, line in numbered if line.strip() and not line.startswith("#")]


def _delimiter(heading: str, name: str) -> str:
    """The separator that shows the column, else the one that shows most columns."""

    def fields(delimiter: str) -> list[str]:
        return [cell.strip() for cell in next(csv.reader([heading], delimiter=delimiter))]

    return max(DELIMITERS, key=lambda delimiter: (name in fields(delimiter), len(fields(delimiter))))


def _rows(path: Path, lines: list[tuple[int, str]], delimiter: str) -> Iterator[_Row]:
    reader = csv.reader((f"{line}\n" for _, line in lines), delimiter=delimiter)
    try:
        for cells in reader:
            yield _Row(lines[reader.line_num - 1][0], cells)
    except csv.Error as error:
        line = lines[min(reader.line_num, len(lines)) - 1][0]
        raise _refusal(
            path, "fields of a CSV file", str(error), "Check the quotes around this line.", line
        ) from None


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
