"""Reading of a stored allocation: the session of a participant."""

from __future__ import annotations

from pathlib import Path

from comity.study.allocation import Session
from comity_fis import InputError, Where, closest
from comity_fis.validation.csv_table import CsvTable, Row, read_csv, short

ALLOCATION = "allocation.csv"
OWN = ("participant", "group", "block")


def read_allocation(folder: Path) -> dict[str, Session]:
    """All sessions by participant, from a folder that `comity study sessions` wrote.

    Raises:
        InputError: with file and line, for anything that cannot be used.
    """
    with read_csv(folder / ALLOCATION, OWN) as table:
        places = [i for i, name in enumerate(table.heading) if name.startswith("condition_")]
        if "participant" not in table.heading or not places:
            raise table.refusal(
                "the columns participant, group, block, condition_1 and so on",
                ", ".join(table.heading),
                "Let `comity study sessions` write the allocation.",
                table.line,
            )
        found: dict[str, Session] = {}
        for row in table.rows:
            one = _session(table, row, places)
            if not one.participant or one.participant in found:
                raise table.refusal(
                    "another participant in each row", short(one.participant), "Remove the row.", row.line
                )
            found[one.participant] = one
    return found


def _session(table: CsvTable, row: Row, places: list[int]) -> Session:
    def cell(name: str) -> str:
        return row.cell(table.heading.index(name)) if name in table.heading else ""

    block = cell("block")
    return Session(
        participant=cell("participant"),
        group=cell("group"),
        block=int(table.number(block, row.line)) if block else 1,
        conditions=tuple(row.cell(i) for i in places if row.cell(i)),
    )


def session_of(folder: Path, participant: str) -> Session:
    """The session of one participant.

    Raises:
        InputError: if the allocation has no such participant.
    """
    sessions = read_allocation(folder)
    if participant not in sessions:
        raise InputError(
            expected=f"a participant of {folder / ALLOCATION}",
            got=repr(participant),
            remedy=f"{closest(participant, sessions)} More are allocated by `comity study sessions`.",
            where=Where("--participant"),
        )
    return sessions[participant]
