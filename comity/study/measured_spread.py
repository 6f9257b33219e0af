"""A measured standard deviation between people, from a column of any table."""

from __future__ import annotations

from dataclasses import dataclass
from math import sqrt
from pathlib import Path

from comity_fis import closest
from comity_fis.validation.csv_table import read_csv

CM = {"_m": 100.0, "_cm": 1.0, "_mm": 0.1}
"""Factors to centimetres by the suffix of a column's name."""


@dataclass(frozen=True, slots=True)
class MeasuredSpread:
    """The spread of a column."""

    sd_cm: float
    """Standard deviation within groups [cm], pooled over them."""
    people: int


def measured_spread(path: Path, column: str, by: str | None = None) -> MeasuredSpread:
    """The standard deviation of a column of distances.

    Args:
        path: A CSV file with one row per person, such as a table of `comity study run` reduced to that.
        column: Name of the column, ending with its unit: `_m`, `_cm` or `_mm`.
        by: A column of groups whose means may differ; their spread is taken within them.

    Raises:
        InputError: with the line, if the table cannot be used.
    """
    wanted = [column, *([by] if by else [])]
    values: dict[str, list[float]] = {}
    with read_csv(path, wanted) as table:
        for name in wanted:
            if name not in table.heading:
                raise table.refusal(f"a column {name!r}", "none", closest(name, table.heading), table.line)
        factor = next((cm for end, cm in CM.items() if column.endswith(end)), None)
        if factor is None:
            raise table.refusal(
                "a column whose name ends with _m, _cm or _mm",
                repr(column),
                "Rename it, so that its unit is known.",
                table.line,
            )
        place, group = table.heading.index(column), table.heading.index(by) if by else None
        for row in table.rows:
            if cell := row.cell(place):
                called = "" if group is None else row.cell(group)
                values.setdefault(called, []).append(factor * table.number(cell, row.line))
        people = sum(map(len, values.values()))
        if people - len(values) < 1:
            raise table.refusal(
                "two people or more in a group", str(people), "Add rows, or leave --by out.", table.line
            )
    squares = sum(sum((one - sum(group) / len(group)) ** 2 for one in group) for group in values.values())
    return MeasuredSpread(sqrt(squares / (people - len(values))), people)
