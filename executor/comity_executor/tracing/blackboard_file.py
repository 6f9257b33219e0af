"""What the blackboard held, on disk: one row for each entry that got another value."""

from __future__ import annotations

import csv
from collections.abc import Iterator, Sequence
from io import StringIO
from math import isfinite
from pathlib import Path
from types import TracebackType

from comity_executor.memory.write import Write
from comity_fis.errors import InputError, Where

COLUMNS = ("t", "entry", "value", "leaf")


class BlackboardFile:
    """Writes that grow while the tree runs.

    Args:
        path: Where to write; what is there is replaced.
    """

    def __init__(self, path: Path) -> None:
        self._file = path.open("w", encoding="utf-8", newline="\n")
        self._writer = csv.writer(self._file, lineterminator="\n")
        self._writer.writerow(COLUMNS)
        self._written = 0

    def keep(self, writes: Sequence[Write]) -> None:
        """Write down those that are not yet.

        Args:
            writes: All so far, in their order.
        """
        for each in writes[self._written :]:
            self._writer.writerow((round(each.t, 6) + 0.0, each.entry, each.value, each.leaf))
        self._file.flush()
        self._written = len(writes)

    def __enter__(self) -> BlackboardFile:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._file.close()


def read_blackboard(path: Path) -> tuple[Write, ...]:
    """Read the writes of a run; a last row without its end was being written when the run was killed.

    Raises:
        InputError: It is missing or damaged; with file and line.
    """
    try:
        text = path.read_bytes().decode()
    except (OSError, UnicodeDecodeError) as error:
        got = "no such file" if isinstance(error, FileNotFoundError) else str(error)
        raise _damaged(path, None, "the blackboard of a run", got) from None
    rows = csv.reader(StringIO(text[: text.rfind("\n") + 1], newline=""))
    if (header := tuple(next(rows, ()))) != COLUMNS:
        raise _damaged(path, 1, f"the columns {','.join(COLUMNS)}", ",".join(header) or "an empty line")
    return tuple(_writes(rows, path))


def _writes(rows: Iterator[list[str]], path: Path) -> Iterator[Write]:
    for number, row in enumerate(rows, start=2):
        if len(row) != len(COLUMNS):
            raise _damaged(path, number, f"{len(COLUMNS)} columns", f"{len(row)}")
        time, entry, value, leaf = row
        t = _number(time)
        if t is None:
            raise _damaged(path, number, "a time [s] in column t", repr(time))
        yield Write(entry, value, t, leaf)


def _number(cell: str) -> float | None:
    try:
        number = float(cell)
    except ValueError:
        return None
    return number if isfinite(number) else None


def _damaged(path: Path, line: int | None, expected: str, got: str) -> InputError:
    remedy = "Copy the folder again, or run the scenario again."
    return InputError(expected=expected, got=got, remedy=remedy, where=Where(str(path), line))
