"""The journal of a study: a line for each episode that has ended, on disk before the next one is asked for.

Only the command writes it. A last line that was cut off, by SIGKILL or a full disk, is taken off when the
study goes on. A damaged line before it stays where it is and is skipped. The episodes of both run again.
Each line ends with the CRC-32 of what stands before it, so that a changed digit is found as well. Lines
without one, of older versions, are read as they are.
"""

from __future__ import annotations

import json
import os
import re
from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import BinaryIO
from zlib import crc32

from comity.study.episode_rows import StudyRow
from comity.study.worker import TaskDone
from comity.system.own_files import PRIVATE

LINE_END = b"\n"
KEYS = {"key", "took_s", "rows"}
"""Of a line, besides its checksum."""
CHECKED = re.compile(rb'(.*), "crc32": "([0-9a-f]{8})"}\n', re.DOTALL)
"""A line with a checksum: what it is taken of, and the checksum."""


@dataclass(frozen=True, slots=True)
class JournalContent:
    """What a journal holds."""

    rows: Mapping[str, tuple[StudyRow, ...]]
    """Of each episode that ended, by key."""
    damaged: tuple[int, ...]
    """Numbers of the lines that cannot be read or were changed; an incomplete last one does not count."""


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
    body = json.dumps(content, ensure_ascii=False, allow_nan=False).encode().removesuffix(b"}")
    return body + f', "crc32": "{crc32(body):08x}"}}'.encode() + LINE_END


def read_journal(path: Path) -> JournalContent:
    """The rows of all episodes that ended; nothing where there is no journal."""
    found: dict[str, tuple[StudyRow, ...]] = {}
    damaged = []
    if path.is_file():
        with path.open("rb") as lines:
            for number, line in enumerate(lines, 1):
                if (ended := _read(line)) is not None:
                    found[ended[0]] = ended[1]
                elif line.endswith(LINE_END):  # else the last one, cut off as it was written
                    damaged.append(number)
    return JournalContent(found, tuple(damaged))


def _read(line: bytes) -> tuple[str, tuple[StudyRow, ...]] | None:
    """An episode's key and rows; None where the line is cut off or damaged."""
    if not line.endswith(LINE_END):
        return None
    checked = CHECKED.fullmatch(line)
    if checked is not None:
        if int(checked[2], 16) != crc32(checked[1]):
            return None
        line = checked[1] + b"}"
    try:
        content = json.loads(line)
        key, rows = str(content["key"]), tuple(content["rows"])
        is_whole = content.keys() <= KEYS and all({"person", "outcome"} <= row.keys() for row in rows)
        return (key, rows) if is_whole else None
    except (ValueError, TypeError, KeyError, AttributeError, RecursionError):
        return None
