"""The tidy table of a study: rows in the plan's order, with a reason for every empty cell."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from comity.output.csv_text import csv_text
from comity.study.columns import ColumnDefinition, column_of, columns_of
from comity.study.episode_rows import ERROR, NO_PLAN
from comity.study.statement import STATEMENT

if TYPE_CHECKING:
    from comity.study.episode_rows import StudyRow
    from comity.study.study_plan import StudyCell
    from comity.study.worker import Installation

CODE_DIGITS = 12
DICTIONARY = ("column", "unit", "definition", "source", "empty_because")


@dataclass(frozen=True, slots=True)
class StudyTable:
    """Rows, and definitions of their columns."""

    columns: Mapping[str, ColumnDefinition]
    rows: Sequence[StudyRow]

    def csv(self) -> str:
        """The rows as CSV, with empty cells for missing values; deterministic."""
        return csv_text(self.columns, ([_cell(row.get(name)) for name in self.columns] for row in self.rows))

    def dictionary(self) -> str:
        """The data dictionary, as CSV."""
        return csv_text(
            DICTIONARY,
            ([name, one.unit, one.means, one.source, one.missing] for name, one in self.columns.items()),
        )


def study_table(
    factors: Sequence[str],
    found: Iterable[tuple[StudyCell, str, Sequence[StudyRow]]],
    installed: Installation,
    version: str,
) -> StudyTable:
    """Build the table of the ended episodes.

    Args:
        factors: The paths of the study's factors.
        found: The episodes in the order of the plan, each with its key and its rows.
        installed: Code and libraries that ran them.
        version: Version of Comity.
    """
    rows: list[StudyRow] = []
    for cell, key, measured in found:
        for one in measured:
            rows.append(
                {
                    "row": len(rows) + 1,
                    **_design(cell, one["person"]),
                    **one,
                    "key": key,
                    "version": version,
                    "code": installed.code[:CODE_DIGITS],
                    "fingerprint": installed.fingerprint,
                    "note": STATEMENT,
                }
            )
    columns = columns_of(factors, {name for row in rows for name in row})
    for row in rows:
        if why := why_missing(row, columns):
            row["why_missing"] = why
    return StudyTable(columns, rows)


def _design(cell: StudyCell, person: str) -> StudyRow:
    """Columns that identify the episode of a row."""
    one = cell.individual if person == cell.person else None
    return {
        "scenario": cell.scenario,
        "condition": cell.condition.number,
        **{column_of(path): plain_value(value) for path, value in cell.condition.values.items()},
        "rulebook_used": cell.base.rulebook_name,
        "individual": one.name if one else None,
        "group": one.group or None if one else None,
        "seed": cell.seed,
    }


def plain_value(value: Any) -> Any:
    """A factor's value as a cell; a structured value as text."""
    return value if isinstance(value, bool | int | float | str) or value is None else str(value)


def why_missing(row: StudyRow, columns: Mapping[str, ColumnDefinition]) -> str:
    """Reasons for empty cells: `never docked: distance_actual_m, docked_s; not greeted: greeting`."""
    failed = {ERROR: "error", NO_PLAN: "no plan"}.get(row["outcome"])
    reasons: dict[str, list[str]] = {}
    for name, one in columns.items():
        if one.missing and row.get(name) is None:
            reason = failed if failed and one.is_measured else one.missing
            reasons.setdefault(reason, []).append(name)
    return "; ".join(f"{reason}: {', '.join(names)}" for reason, names in reasons.items())


def _cell(value: Any) -> str:
    if value is None:
        return ""
    return str(value).lower() if isinstance(value, bool) else str(value)
