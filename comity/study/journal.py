"""The journal of a study: a line for each episode that has ended, on disk before the next one is asked for.

Only the command writes it. A line that was cut off, by SIGKILL or a full disk, is taken off when the study
goes on; its episode runs again.
"""

from __future__ import annotations

import json
import os
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any, BinaryIO

from comity.study.episode_rows import StudyRow
from comity.study.worker import TaskDone
from comity.system.own_files import PRIVATE


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
    """The journal, to be added to; what was cut off at its end is gone.

    Raises:
        OSError: the system does not let us.
    """
    handle = os.open(path, os.O_RDWR | os.O_CREAT | getattr(os, "O_BINARY", 0), PRIVATE)
    with os.fdopen(handle, "r+b") as file:
        file.truncate(_whole(path))
        file.seek(0, os.SEEK_END)
        yield StudyJournal(file)


def line_of(done: TaskDone) -> bytes:
    """One episode as a line of the journal."""
    content = {"key": done.key, "took_s": round(done.took_s, 4), "rows": done.rows}
    return json.dumps(content, ensure_ascii=False, allow_nan=False).encode() + b"\n"


def read_journal(path: Path) -> dict[str, tuple[StudyRow, ...]]:
    """The rows of all episodes that ended, by key; nothing where there is no journal."""
    if not path.is_file():
        return {}
    found = {}
    with path.open("rb") as file:
        for line in file:
            if (content := _read(line)) is not None:
                found[str(content["key"])] = tuple(content["rows"])
    return found


def _whole(path: Path) -> int:
    """Bytes up to the end of the last whole line."""
    length = 0
    with path.open("rb") as file:
        for line in file:
            if _read(line) is None:
                break
            length += len(line)
    return length


def _read(line: bytes) -> dict[str, Any] | None:
    """A line's content; None where it is cut off or damaged."""
    if not line.endswith(b"\n"):
        return None
    try:
        content = json.loads(line)
    except ValueError:
        return None
    return content if isinstance(content, dict) and "rows" in content else None
