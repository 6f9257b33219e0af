"""An append-only CSV file: each row is on disk before the next question is asked.

An incomplete last row, after SIGKILL or on a full disk, is removed when the file is opened again. An earlier
damaged row is an error with its line, as it may hold a participant's answer.
"""

from __future__ import annotations

import csv
import os
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import BinaryIO

from comity.output.csv_text import csv_text
from comity.system.own_files import PRIVATE, write_whole, writing
from comity_fis import InputError, Where


@dataclass(frozen=True, slots=True)
class GrowingTable:
    """The open file."""

    file: BinaryIO
    columns: tuple[str, ...]

    def add(self, cells: Mapping[str, object]) -> None:
        """Add a row; it is on disk when this returns.

        Args:
            cells: Cells by column, without line breaks; missing ones are empty.

        Raises:
            OSError: if the disk is full; earlier rows remain.
        """
        self.file.write(csv_text([str(cells.get(name, "")) for name in self.columns]).encode())
        self.file.flush()
        os.fsync(self.file.fileno())


@contextmanager
def opened_table(path: Path, columns: Sequence[str]) -> Iterator[GrowingTable]:
    """Open the table for appending; a new one gets its headings.

    Raises:
        InputError: if the file has other headings, or the system refuses.
    """
    rows_of(path, columns)
    with writing(path):
        handle = os.open(path, os.O_RDWR | os.O_CREAT | getattr(os, "O_BINARY", 0), PRIVATE)
    with os.fdopen(handle, "r+b") as file:
        content = file.read()
        file.truncate(content.rfind(b"\n") + 1)
        file.seek(0, os.SEEK_END)
        table = GrowingTable(file, tuple(columns))
        if not file.tell():
            table.add({name: name for name in columns})
        yield table


def rows_of(path: Path, columns: Sequence[str]) -> list[dict[str, str]]:
    """The complete rows of a table; none if there is no file.

    Raises:
        InputError: if the headings are those of another table, or a row before the last is damaged.
    """
    if not path.exists():
        return []
    heading, *lines = _whole(path).decode("utf-8", "replace").split("\n")[:-1] or [""]
    if heading and _cells(heading) != list(columns):
        raise InputError(
            expected=f"the columns {', '.join(columns)}",
            got=heading,
            remedy="Answers of another collection stand there: name another folder with --out.",
            where=Where(str(path), 1),
        )
    rows = [_cells(line) for line in lines]
    for number, row in enumerate(rows, 2):
        if len(row) != len(columns):
            raise InputError(
                expected=f"{len(columns)} cells in a row",
                got=str(len(row)),
                remedy="The line is damaged: mend it, or delete it, and its question is asked again.",
                where=Where(str(path), number),
            )
    return [dict(zip(columns, row, strict=True)) for row in rows]


def _cells(line: str) -> list[str]:
    """The cells of a line without line breaks; empty if the line is no CSV."""
    try:
        return next(csv.reader([line]), [])
    except csv.Error:
        return []


def without_participant(path: Path, columns: Sequence[str], participant: str) -> int:
    """Remove the rows of a participant who withdrew, and return their number.

    Raises:
        InputError: if the file is another table, or the system refuses.
    """
    rows = rows_of(path, columns)
    kept = [row for row in rows if row["participant"] != participant]
    if len(kept) < len(rows):
        write_whole(path, csv_text(columns, (row.values() for row in kept)).encode(), private=True)
    return len(rows) - len(kept)


def _whole(path: Path) -> bytes:
    """Content up to the end of the last complete row."""
    with writing(path):
        content = path.read_bytes()
    return content[: content.rfind(b"\n") + 1]
