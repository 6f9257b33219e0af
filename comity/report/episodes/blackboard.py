"""The blackboard of a run at a given time."""

from __future__ import annotations

from typing import TYPE_CHECKING

from comity.output.run_folder import BLACKBOARD
from comity.report.episodes.times import check_time
from comity.report.text import table
from comity_executor import read_blackboard

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from rich.console import RenderableType

    from comity.output.run_folder import RunFolder
    from comity_executor import Write


def blackboard_at(folder: RunFolder, until: float | None) -> tuple[Write, ...]:
    """The last value written to every entry up to a time, in the order of the entries.

    Args:
        folder: The run.
        until: The time [s]; None for the end.

    Raises:
        InputError: if the run has no such file, it is damaged, or the time is invalid.
    """
    check_time(until)
    writes = read_blackboard(folder / BLACKBOARD)
    last = {each.entry: each for each in writes if until is None or each.t <= until}
    return tuple(sorted(last.values(), key=lambda each: each.entry))


def blackboard_text(entries: Iterable[Write]) -> Iterator[RenderableType]:
    """One row for every entry."""
    rows = [(each.entry, each.value, f"t={each.t:.2f}", each.leaf) for each in entries]
    yield table(rows, head=("entry", "value", "since", "written by")) if rows else "Nothing was written."
