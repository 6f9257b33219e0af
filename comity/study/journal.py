"""The journal of a study: a line for each episode that has ended, on disk before the next one is asked for.

Only the command writes it. A last line that was cut off, by SIGKILL or a full disk, is taken off when the
study goes on. A damaged line before it stays where it is and is skipped. The episodes of both run again.
"""

from __future__ import annotations

import json
import os
from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import BinaryIO

from comity.study.episode_rows import StudyRow
from comity.study.worker import TaskDone
from comity.system.own_files import PRIVATE

LINE_END = b"\n"


@dataclass(frozen=True, slots=True)
class JournalContent:
    """What a journal holds."""

    rows: Mapping[str, tuple[StudyRow, ...]]
    """Of each episode that ended, by key."""
    damaged: int
    """Lines that cannot be read; an incomplete last one does not count."""


@dataclass(frozen=True, slots=True)
class StudyJournal:
    """The journal while it is open."""

    file: BinaryIO

    def keep(self, ended: Iterable[TaskDone]) -> None:
        """Write episodes down; they are on the disk when this returns.

        Raises:
            OSError: there is no room; what was written before stays.
        """
        self.file.write(b"".join(map(line_of, ended)))
        self.file.flush()
        os.fsync(self.file.fileno())


@contextmanager
def opened_journal(path: Path) -> Iterator[StudyJournal]:
    """The journal, to be added to; an incomplete last line is taken off.

    Raises:
        OSError: the system does not let us.
    """
    handle = os.open(path, os.O_RDWR | os.O_CREAT | getattr(os, "O_BINARY", 0), PRIVATE)
    with os.fdopen(handle, "r+b") as file:
        file.truncate(sum(len(line) for line in file if line.endswith(LINE_END)))
        file.seek(0, os.SEEK_END)
        yield StudyJournal(file)


def line_of(done: TaskDone) -> bytes:
    """One episode as a line of the journal."""
    content = {"key": done.key, "took_s": round(done.took_s, 4), "rows": done.rows}
    return json.dumps(content, ensure_ascii=False, allow_nan=False).encode() + LINE_END


def read_journal(path: Path) -> JournalContent:
    """The rows of all episodes that ended; nothing where there is no journal."""
    found: dict[str, tuple[StudyRow, ...]] = {}
    damaged = 0
    if path.is_file():
        with path.open("rb") as lines:
            for line in lines:
                if (ended := _read(line)) is not None:
                    found[ended[0]] = ended[1]
                elif line.endswith(LINE_END):  # else the last one, cut off as it was written
                    damaged += 1
    return JournalContent(found, damaged)


def _read(line: bytes) -> tuple[str, tuple[StudyRow, ...]] | None:
    """An episode's key and rows; None where the line is cut off or damaged."""
    if not line.endswith(LINE_END):
        return None
    try:
        content = json.loads(line)
        key, rows = str(content["key"]), tuple(content["rows"])
        return (key, rows) if all({"person", "outcome"} <= row.keys() for row in rows) else None
    except (ValueError, TypeError, KeyError, AttributeError, RecursionError):
        return None
