"""A finished study: its table and data dictionary, read from its folder."""

from __future__ import annotations

import csv
from collections.abc import Collection, Mapping
from dataclasses import dataclass
from math import isfinite
from pathlib import Path
from typing import TYPE_CHECKING

from comity.study.folder import DICTIONARY, RESULTS
from comity.study.progress import StudyProgress, progress_of
from comity_fis.errors import InputError, Where
from comity_fis.validation.csv_table import short

if TYPE_CHECKING:
    from pandas import DataFrame

DESCRIBED = ("column", "unit", "definition", "source")
"""Columns of the dictionary, for each column of the table."""


@dataclass(frozen=True, slots=True)
class Study:
    """The folder of a study: `Study.load("runs/six-groups").to_frame()`."""

    path: Path
    columns: Mapping[str, Mapping[str, str]]
    """By column of the table: its unit, definition and source, and why a cell may be empty."""
    rows: tuple[Mapping[str, str], ...]
    """One row per visit; cells as in the CSV file, empty if there is no value."""

    @classmethod
    def load(cls, path: str | Path) -> Study:
        """Load the study from a folder written by `comity study run`.

        Raises:
            InputError: if there is no study, its tables are not written yet, or they are damaged.
        """
        folder = Path(path)
        for name in (RESULTS, DICTIONARY):
            if not (folder / name).is_file():
                raise _without_table(folder, name)
        described = _read(folder / DICTIONARY, DESCRIBED)
        columns = {row.pop("column"): row for row in (dict(row) for _, row in described)}
        rows = _read(folder / RESULTS, columns)
        numbers = [name for name, one in columns.items() if one["unit"] and _holds_numbers(name, one)]
        for line, row in rows:
            for name in numbers:
                if row[name] and not _is_number(row[name]):
                    raise _refusal(folder / RESULTS, f"a number in {name}", short(row[name]), line)
        return cls(folder, columns, tuple(row for _, row in rows))

    @property
    def progress(self) -> StudyProgress | None:
        """Progress of the study; None if it is done. If not, the table may lack episodes."""
        return progress_of(self.path)

    def to_frame(self) -> DataFrame:
        """The table as a pandas DataFrame with numeric columns, NaN for missing numbers.

        Raises:
            ImportError: if pandas is not installed.
        """
        from comity.data_frames import imported_pandas

        table: DataFrame = imported_pandas().read_csv(
            self.path / RESULTS, keep_default_na=False, na_values=[""]
        )
        return table

    def __repr__(self) -> str:
        progress = self.progress
        state = "" if progress is None else f"; {progress.state}"
        return f"<Study {self.path.name}: {len(self.rows)} rows, {len(self.columns)} columns{state}>"


def _without_table(folder: Path, name: str) -> InputError:
    if (progress := progress_of(folder)) is not None:
        return InputError(
            expected="the folder of a study that was carried out",
            got=f"one that is {progress.state}",
            remedy=progress.remedy,
            where=Where(str(folder)),
        )
    return InputError(
        expected=f"the folder of a study, with its {name}",
        got="no such file" if folder.is_dir() else "no such folder",
        remedy="`comity study run FILE --out DIR` writes one.",
        where=Where(str(folder)),
    )


def _read(path: Path, columns: Collection[str]) -> list[tuple[int, dict[str, str]]]:
    """The rows of a table with their line numbers.

    Raises:
        InputError: with the line, if cells or columns are missing, or the file is no text.
    """
    found = []
    try:
        with path.open(encoding="utf-8-sig", newline="") as file:
            rows = csv.reader(file)
            heading = next(rows, [])
            if missing := [name for name in columns if name not in heading]:
                raise _refusal(path, f"a column {missing[0]}", "none", 1)
            for cells in rows:
                if len(cells) != len(heading):
                    raise _refusal(path, f"{len(heading)} cells in a row", str(len(cells)), rows.line_num)
                found.append((rows.line_num, dict(zip(heading, cells, strict=True))))
    except (UnicodeDecodeError, csv.Error) as error:
        raise _refusal(path, "a CSV file in UTF-8", str(error), None) from None
    return found


def _refusal(path: Path, expected: str, got: str, line: int | None) -> InputError:
    return InputError(
        expected=expected,
        got=got,
        remedy="The file was cut off or changed: `comity study run FILE --out DIR` writes it again.",
        where=Where(str(path), line),
    )


def _holds_numbers(name: str, column: Mapping[str, str]) -> bool:
    """Whether a column with a unit holds numbers only: factors may hold text, and ages may be bands."""
    return not column["definition"].startswith("Factor: ") and not name.startswith("fact_")


def _is_number(cell: str) -> bool:
    try:
        return isfinite(float(cell))
    except ValueError:
        return False
