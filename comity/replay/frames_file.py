"""Reading of a run's frames, with errors for invalid files."""

from __future__ import annotations

import csv
from typing import TYPE_CHECKING

from numpy import isfinite

from comity_fis import InputError, Where
from comity_sim2d import read_frames_csv
from comity_sim2d.frames import COLUMNS

if TYPE_CHECKING:
    from collections.abc import Mapping
    from pathlib import Path

    from comity_sim2d import Frames

_NUMBERS = tuple(column for column in COLUMNS if column != "entity")
_REMEDY = "Copy the folder again, or run the scenario again."


def frames_of(path: Path) -> Frames:
    """The frames of a run.

    Raises:
        InputError: if the file is missing or damaged, with the line of the damage.
    """
    if not path.is_file():
        raise _refusal(path, None, f"the {path.name} of a run", "no such file")
    try:
        frames = read_frames_csv(path)
    except (OSError, ValueError, InputError):
        raise _first_fault(path) from None
    if not all(isfinite(frames.of(name)).all() for name in frames.entities):
        raise _first_fault(path)
    return frames


def _first_fault(path: Path) -> InputError:
    """The first error in an invalid file."""
    try:
        with path.open(encoding="utf-8", newline="") as file:
            rows = csv.DictReader(file)
            if tuple(rows.fieldnames or ()) != COLUMNS:
                got = ",".join(rows.fieldnames or ()) or "an empty line"
                return _refusal(path, 1, f"the columns {','.join(COLUMNS)}", got)
            for row in rows:
                if fault := _fault(row):
                    return _refusal(path, rows.line_num, *fault)
            if rows.line_num < 2:
                return _refusal(
                    path, 2, "where everybody was, a row for each at every time", "only the header"
                )
    except (OSError, UnicodeDecodeError, csv.Error):
        return _refusal(path, None, f"the {path.name} of a run", "a file that cannot be read as text")
    return _refusal(path, None, "a row for everybody at every time", "rows that are missing or double")


def _fault(row: Mapping[str, str | None]) -> tuple[str, str] | None:
    """Expected and actual content of an invalid row; None for a valid one."""
    for column in _NUMBERS:
        cell = row[column]
        if not _is_number(cell):
            return f"a number in column {column}", "nothing" if not cell else repr(cell)
    return None


def _is_number(cell: str | None) -> bool:
    try:
        return bool(isfinite(float(cell or "")))
    except ValueError:
        return False


def _refusal(path: Path, line: int | None, expected: str, got: str) -> InputError:
    return InputError(expected=expected, got=got, remedy=_REMEDY, where=Where(str(path), line))
