"""The visits of a study as columns: visits to individuals, and their measurements."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from comity.study.columns import FILE, PEOPLE
from comity.study.folder import RESULTS
from comity.study.report.resampling import estimate
from comity.study.results import Study
from comity_fis import InputError, Where

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from comity.answers.study_report import EstimateAnswer
    from comity.study.report.resampling import Floats

NO_INDIVIDUAL = ""


@dataclass(frozen=True)
class StudyVisits:
    """The rows of a study that are compared.

    With a population, these are the visits to its individuals; other people of a scenario are the same in
    every episode. Without a population, all visits.
    """

    study: Study
    rows: tuple[Mapping[str, str], ...]
    left_out: int
    """Number of rows of other people."""

    @classmethod
    def of(cls, study: Study) -> StudyVisits:
        """The visits of a study.

        Raises:
            InputError: for a table without rows.
        """
        require_rows(study)
        own = tuple(row for row in study.rows if row["individual"] != NO_INDIVIDUAL)
        rows = own or study.rows
        return cls(study, rows, len(study.rows) - len(rows))

    def words(self, column: str) -> NDArray[Any]:
        """A column as text, shape (visits,); empty for empty cells or a missing column."""
        return np.array([row.get(column, "") for row in self.rows], dtype=str)

    def numbers(self, column: str) -> Floats:
        """A column as numbers, shape (visits,); NaN for empty cells or text."""
        return np.array([_number(row.get(column, "")) for row in self.rows], dtype=float)

    @cached_property
    def individuals(self) -> NDArray[Any]:
        """Individual of each row."""
        return self.words("individual")

    @cached_property
    def rooms(self) -> NDArray[Any]:
        """Scenario of each row."""
        return self.words("scenario")

    @cached_property
    def conditions(self) -> NDArray[Any]:
        """Condition of each row: common to repetitions with other seeds of the same individual and room."""
        return np.char.add(np.char.add(self.words("condition"), "/"), self.words("person"))

    @cached_property
    def seeds(self) -> NDArray[Any]:
        """Seed of each row."""
        return self.words("seed")

    def estimated(self, values: Floats, chosen: NDArray[Any] | None = None) -> EstimateAnswer | None:
        """The mean of an outcome over some visits, with its uncertainty.

        Args:
            values: One value per visit, NaN if missing.
            chosen: Mask of the visits that count; all by default.
        """
        counted = values if chosen is None else np.where(chosen, values, np.nan)
        return estimate(counted, self.individuals, self.rooms, self.conditions, self.seeds)

    @cached_property
    def measured(self) -> tuple[str, ...]:
        """Columns that hold results of episodes."""
        inputs = (FILE, PEOPLE)
        return tuple(name for name, one in self.study.columns.items() if one["source"] not in inputs)


def require_rows(study: Study) -> None:
    """Refuse a table without rows.

    Raises:
        InputError: if the table has only headings.
    """
    if not study.rows:
        raise InputError(
            expected="a study with visits",
            got="a table without rows",
            remedy="Run it: `comity study run FILE --out DIR`.",
            where=Where(str(study.path / RESULTS)),
        )


def _number(cell: str) -> float:
    try:
        return float(cell)
    except ValueError:
        return float("nan")
