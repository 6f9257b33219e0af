"""The journal of a study: a line for each ended episode, on disk before the next is requested.

Only the command writes it. An incomplete last line, after SIGKILL or on a full disk, is removed when the
study continues. An earlier damaged line stays and is skipped. The episodes of both run again. Each line ends
with the CRC-32 of the text before it, so that a changed digit is detected too. Lines of older versions
without a checksum are accepted.
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
"""Keys of a line, besides its checksum."""
CHECKED = re.compile(rb'(.*), "crc32": "([0-9a-f]{8})"}\n', re.DOTALL)
"""Pattern of a line with a checksum: the covered text, and the checksum."""


@dataclass(frozen=True, slots=True)
class JournalContent:
    """The content of a journal."""

    rows: Mapping[str, tuple[StudyRow, ...]]
    """Rows of each ended episode, by key."""
    damaged: tuple[int, ...]
    """Numbers of unreadable or altered lines, not counting an incomplete last line."""


@dataclass(frozen=True, slots=True)
class StudyJournal:
    """The open journal."""

    file: BinaryIO

    def keep(self, ended: Iterable[TaskDone]) -> None:
        """Append episodes; they are on disk when this returns.

        Raises:
            OSError: if the disk is full; earlier lines remain.
        """
        self.file.write(b"".join(map(line_of, ended)))
        self.file.flush()
        os.fsync(self.file.fileno())


@contextmanager
def opened_journal(path: Path) -> Iterator[StudyJournal]:
    """Open the journal for appending; an incomplete last line is removed.

    Raises:
        OSError: if the system refuses.
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
    """Read the rows of all ended episodes; empty if there is no journal."""
    found: dict[str, tuple[StudyRow, ...]] = {}
    damaged = []
    if path.is_file():
        with path.open("rb") as lines:
            for number, line in enumerate(lines, 1):
                if (ended := _read(line)) is not None:
                    found[ended[0]] = ended[1]
                elif line.endswith(LINE_END):  # otherwise an incomplete last line
                    damaged.append(number)
    return JournalContent(found, tuple(damaged))


def _read(line: bytes) -> tuple[str, tuple[StudyRow, ...]] | None:
    """An episode's key and rows; None if the line is incomplete or damaged."""
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
