"""Individuals from a table: one per row, with facts, comfort distances and wish."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

from comity.people.profile import Profile, declared_by
from comity.scenario import ComfortSpec
from comity.sharing.person import pseudonyms
from comity.study.individual import Individual, plain_fact
from comity_domain.problem.bound_parameters import DISTANCE
from comity_fis import InputError, closest
from comity_fis.validation.csv_table import CsvTable, Row, read_csv

if TYPE_CHECKING:
    from comity.study.population_file import PopulationFile
    from comity_fis.validation.yaml_file import YamlFile

INDIVIDUAL, GROUP = "individual", "group"
NEAR_M, FAR_M, WISH_M = "comfort_near_m", "comfort_far_m", "wish_m"
OWN = (INDIVIDUAL, GROUP, NEAR_M, FAR_M, WISH_M)
NUMBERS = frozenset({"age", "birth_year", "education", "latitude"})
"""Facts that are numbers in a profile; all others are text."""
FACTS = tuple(
    sorted(
        Profile.model_fields.keys() - {"schema_version", "name", "about", "other", "settings", "languages"}
    )
)


def individuals_of_table(file: YamlFile, written: PopulationFile) -> Iterator[Individual]:
    """The individuals of a population's table, in the order of its rows, under pseudonyms.

    Raises:
        InputError: with the table's line, for a heading or a cell that cannot be used.
    """
    assert written.table is not None
    path = file.path.parent / written.table
    with read_csv(path, OWN, called=str(path)) as table:
        _require_headings(table, written)
        rows = [(row, _cells(table, row)) for row in table.rows]
    if not rows:
        raise table.refusal("a row for each individual", "none", "Add rows below the headings.", table.line)
    seen: dict[str, int] = {}
    for row, cells in rows:
        name = cells.get(INDIVIDUAL, "")
        if not name or name in seen:
            raise table.refusal(
                "another name for each individual",
                f"{name!r} as in line {seen[name]}" if name else "an empty cell",
                f"Give the row a name of its own in `{INDIVIDUAL}`.",
                row.line,
            )
        seen[name] = row.line
    called = pseudonyms(seen, "individual")
    for row, cells in rows:
        yield _individual(table, written, row, cells, called[cells[INDIVIDUAL]])


def _require_headings(table: CsvTable, written: PopulationFile) -> None:
    known = (*OWN, *FACTS)
    for heading in table.heading:
        if heading not in known:
            remedy = f"{closest(heading, known)} Leave other columns out."
            raise table.refusal("headings that a population has", repr(heading), remedy, table.line)
    if twice := {one for one in table.heading if table.heading.count(one) > 1}:
        raise table.refusal("each heading once", f"{min(twice)!r} again", "Remove one.", table.line)
    if INDIVIDUAL not in table.heading:
        raise table.refusal(
            f"a column {INDIVIDUAL}", ", ".join(table.heading), "Add one with a name a row.", table.line
        )
    if (NEAR_M in table.heading) != (FAR_M in table.heading):
        raise table.refusal(
            f"both {NEAR_M} and {FAR_M}", "one of them", "Add the other, or leave both out.", table.line
        )
    if written.wishes == "stated" and WISH_M not in table.heading:
        raise table.refusal(
            f"a column {WISH_M}", "none", "Add one, or state a share of wishes instead.", table.line
        )
    if WISH_M in table.heading and written.wishes != "stated":
        raise table.refusal(
            f"no column {WISH_M}, as a wish goes before culture",
            "one",
            "Write `wishes: stated` into the population, or leave the column out.",
            table.line,
        )


def _cells(table: CsvTable, row: Row) -> dict[str, str]:
    cells = {heading: row.cell(i) for i, heading in enumerate(table.heading)}
    return {heading: cell for heading, cell in cells.items() if cell}


def _individual(
    table: CsvTable, written: PopulationFile, row: Row, cells: dict[str, str], name: str
) -> Individual:
    facts: dict[str, Any] = {
        key: plain_fact(key, table.number(cell, row.line, f"a number in `{key}`")) if key in NUMBERS else cell
        for key, cell in cells.items()
        if key in FACTS
    }
    profile: dict[str, Any] = {"name": name, **facts}
    comfort = _comfort(table, row, cells) or written.comfort
    if WISH_M in cells:
        profile["settings"] = {DISTANCE: table.number(cells[WISH_M], row.line)}
    try:
        declared_by(profile, called=name)
    except InputError as error:
        raise table.refusal(error.expected, error.got, error.remedy, row.line) from None
    return Individual(name, cells.get(GROUP, ""), profile, comfort, row.line)


def _comfort(table: CsvTable, row: Row, cells: dict[str, str]) -> ComfortSpec | None:
    if NEAR_M not in cells and FAR_M not in cells:
        return None
    near_m, far_m = (
        table.number(cells.get(key, ""), row.line, f"a number in `{key}`") for key in (NEAR_M, FAR_M)
    )
    if not 0.0 <= near_m + 0.05 <= far_m:
        raise table.refusal(
            f"{FAR_M} at least 0.05 above {NEAR_M}",
            f"{near_m:g} and {far_m:g}",
            "Correct the cells, or leave both empty.",
            row.line,
        )
    return ComfortSpec(wants_m=(near_m, far_m))
