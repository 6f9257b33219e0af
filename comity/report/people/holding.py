"""Folders searched for a person's data, and what was found."""

from __future__ import annotations

from collections.abc import Collection, Iterator
from typing import TYPE_CHECKING

from comity.report.text import unbroken

if TYPE_CHECKING:
    from pathlib import Path

    from rich.console import RenderableType

    from comity.output.holding import Searched

SHOWN = 50
"""Maximum number of unread files listed per folder."""
NOTE = (
    "Copies elsewhere, backups, and runs with pseudonyms, which hold no name, cannot be found: "
    "those are yours to delete."
)


def holding_text(
    name: str, searched: Collection[Searched], deleted: Collection[Path] = ()
) -> Iterator[RenderableType]:
    """By folder: the number of searched files, what was found, and what could not be read.

    Args:
        name: Name of the person.
        searched: Searched folders.
        deleted: Deleted runs.
    """
    if not searched:
        yield "Searched no folder: there is none called runs here. --in DIR names others."
    for each in searched:
        yield unbroken(
            f"Searched {each.folder}: {_counted(each.runs, 'run')}, {_counted(each.files, 'other file')}"
        )
        for one in each.found:
            state = ", deleted" if one.path in deleted else ""
            yield unbroken(f"  {one.path} holds {name} {one.as_}{state}")
        for not_read in each.unread[:SHOWN]:
            yield unbroken(f"  {not_read.path} was not read ({not_read.why}): {not_read.remedy}")
        if len(each.unread) > SHOWN:
            yield f"  and {len(each.unread) - SHOWN} more were not read: look yourself"
    yield NOTE


def _counted(count: int, what: str) -> str:
    return f"{count} {what}{'' if count == 1 else 's'}"
