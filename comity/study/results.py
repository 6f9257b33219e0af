"""A study that was run: its table and data dictionary, read back from its folder."""

from __future__ import annotations

import csv
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from comity_fis.errors import InputError, Where

if TYPE_CHECKING:
    from pandas import DataFrame

RESULTS, PARQUET, DICTIONARY = "results.csv", "results.parquet", "dictionary.csv"
JOURNAL, ACCOUNT, WRITTEN = "journal.jsonl", "study.json", "study.yaml"


@dataclass(frozen=True, slots=True)
class Study:
    """The folder of a study: `Study.load("runs/six-groups").to_frame()`."""

    path: Path
    columns: Mapping[str, Mapping[str, str]]
    """By column of the table: its unit, definition and source, and why a cell may be empty."""
    rows: tuple[Mapping[str, str], ...]
    """One a visit; cells as the CSV file has them, empty where there is no value."""

    @classmethod
    def load(cls, path: str | Path) -> Study:
        """The study in a folder that `comity study run` wrote.

        Raises:
            InputError: if there is none, or its tables are not written yet.
        """
        folder = Path(path)
        for name in (RESULTS, DICTIONARY):
            if not (folder / name).is_file():
                raise InputError(
                    expected=f"the folder of a study, with its {name}",
                    got="no such file" if folder.is_dir() else "no such folder",
                    remedy="`comity study run FILE --out DIR` writes one.",
                    where=Where(str(folder)),
                )
        columns = {row.pop("column"): row for row in _read(folder / DICTIONARY)}
        return cls(folder, columns, tuple(_read(folder / RESULTS)))

    def to_frame(self) -> DataFrame:
        """The table as a pandas DataFrame, numbers as numbers and NaN where there is no value.

        Raises:
            ImportError: if pandas is not installed.
        """
        from comity.data_frames import imported_pandas

        table: DataFrame = imported_pandas().read_csv(
            self.path / RESULTS, keep_default_na=False, na_values=[""]
        )
        return table

    def __repr__(self) -> str:
        return f"<Study {self.path.name}: {len(self.rows)} rows, {len(self.columns)} columns>"


def _read(path: Path) -> list[dict[str, str]]:
    with path.open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))
