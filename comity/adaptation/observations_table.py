"""Reads observations of many encounters from a CSV file."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from datetime import date
from pathlib import Path
from typing import TYPE_CHECKING

from comity.adaptation.observers_words import signal_in_words, situation_told
from comity.adaptation.observing import ObservedSignal
from comity.people.dated import day_in_words
from comity.people.profile import Profile
from comity.tables.measurements import OPTIONAL, REQUIRED
from comity_fis import Where
from comity_fis.validation.csv_table import CsvTable, Row, read_csv

if TYPE_CHECKING:
    from comity_fis import Rulebook

NEEDED = ("signal", "distance_m")
MOST_ROWS = 10_000
OF_STUDIES = frozenset(
    {*REQUIRED, *OPTIONAL, *Profile.model_fields, "group", "condition", "order", "trial", "medium", "read_by"}
)
"""Columns that `comity study collect` writes for other commands: ignored here."""


def read_sights(
    path: Path, rulebook: Rulebook, *, name: str | None = None, day: date | None = None
) -> tuple[ObservedSignal, ...]:
    """The rows of a CSV file: `signal`, `distance_m`, and optionally `name`, `date` and situation variables.

    Args:
        path: The file.
        rulebook: Its situation variables may be headings.
        name: Name of the person in every row, if the table has no column of names.
        day: Day of rows without a date; None: today.

    Raises:
        InputError: A row is invalid; with its line.
    """
    situations = [key for key, variable in rulebook.variables.items() if variable.kind == "situation"]
    known = [*NEEDED, "name", "date", *situations]
    with read_csv(path, known) as table:
        _check_heading(table, known, name)
        rows = tuple(_sights(table, rulebook, situations, name, day))
    if not rows:
        raise table.refusal("at least one row below the headings", "none", "Add what was seen and heard.")
    return rows


def _check_heading(table: CsvTable, known: Iterable[str], name: str | None) -> None:
    needed = NEEDED if name else ("name", *NEEDED)
    for heading in needed:
        if heading not in table.heading:
            remedy = "Add it" + ("." if heading != "name" else ", or name the person on the command line.")
            raise table.refusal(
                f"the headings {', '.join(needed)}", f"none called {heading!r}", remedy, table.line
            )
    for heading in table.heading:
        if heading in OF_STUDIES and heading not in known:
            continue
        if heading not in known or table.heading.count(heading) > 1:
            got = f"{heading!r} twice" if heading in known else repr(heading)
            raise table.refusal(f"headings of {', '.join(known)}", got, "Rename or remove it.", table.line)


def _sights(
    table: CsvTable, rulebook: Rulebook, situations: Iterable[str], name: str | None, day: date | None
) -> Iterator[ObservedSignal]:
    place = {heading: index for index, heading in enumerate(table.heading)}
    for count, row in enumerate(table.rows):
        if count == MOST_ROWS:
            raise table.refusal(f"at most {MOST_ROWS} rows", "more", "Split the file.", row.line)
        where = Where(table.file, row.line)
        on = row.cell(place["date"]) if "date" in place else ""
        told = {key: row.cell(place[key]) for key in situations if key in place and row.cell(place[key])}
        yield ObservedSignal(
            name=_name(table, row, place, name),
            signal=signal_in_words(row.cell(place["signal"]), where),
            distance_m=table.number(row.cell(place["distance_m"]), row.line, "a distance in metres"),
            day=day_in_words(on, where) if on else day,
            situation=situation_told(told, rulebook, where),
            where=where,
        )


def _name(table: CsvTable, row: Row, place: Mapping[str, int], name: str | None) -> str:
    told = row.cell(place["name"]) if "name" in place else ""
    if told and name and told != name:
        remedy = "Leave the name on the command line out, or split the file."
        raise table.refusal(f"rows about {name}", repr(told), remedy, row.line)
    if not (told or name):
        raise table.refusal("who it was", "an empty cell", "Write the name.", row.line)
    return told or str(name)
