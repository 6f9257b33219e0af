"""The divergence of two runs, for the page."""

from __future__ import annotations

from typing import TYPE_CHECKING

from comity.report.episodes.trace import load
from comity.report.episodes.why import differences

if TYPE_CHECKING:
    from comity.output.run_folder import RunFolder
    from comity_executor import Cause, History, TraceEvent


def parting(folder: RunFolder, other: RunFolder) -> list[dict[str, object]]:
    """The first difference in numbers, and the first in actions; events by their indices."""
    one, two = load(folder).history, load(other).history
    return [
        {
            "t": found.t,
            "in_behaviour": found.in_behaviour,
            "events": [_place(one, found.one), _place(two, found.other)],
            "causes": [_side_by_side(*pair) for pair in found.causes],
        }
        for found in differences(one, two)
    ]


def _side_by_side(mine: Cause | None, theirs: Cause | None) -> list[str | None]:
    kind = next(cause.kind for cause in (mine, theirs) if cause)
    return [kind, mine.text if mine else None, theirs.text if theirs else None]


def _place(history: History, event: TraceEvent | None) -> int | None:
    return next((i for i, each in enumerate(history.events) if each is event), None)
