"""`comity trace`: what every node of the tree did, when, and because of what."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from comity.commands.options import AsJson, print_json

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from comity.answers.run import Disturbance
    from comity.report.episodes.trace import StoredTrace
    from comity_executor import TraceEvent

Run = Annotated[Path, typer.Argument(metavar="RUN", help="A run folder.")]
When = Annotated[float | None, typer.Option(metavar="T", help="The tree as it was at this time [s].")]
Events = Annotated[bool, typer.Option("--events", help="Every change, one a line.")]
Nodes = Annotated[str | None, typer.Option(metavar="N", help="Only nodes whose name contains this.")]
Span = Annotated[
    tuple[float, float] | None, typer.Option(metavar="A B", help="Only changes from A to B [s].")
]
Shared = Annotated[
    bool, typer.Option("--blackboard", help="What the leaves share, as it was at the end, or at --at T.")
]
Question = Annotated[
    str | None,
    typer.Option(metavar="T_OR_NODE", help="Why it did what it did: at a time [s], or a node's last."),
]
Other = Annotated[
    Path | None, typer.Option(metavar="OTHER", help="Where another run first parts from this one.")
]


def trace(
    run: Run,
    *,
    at: When = None,
    events: Events = False,
    node: Nodes = None,
    between: Span = None,
    blackboard: Shared = False,
    why: Question = None,
    diff: Other = None,
    as_json: AsJson = False,
) -> None:
    """Show the tree of a run, what its nodes did, why, or where two runs part.

    For example: comity trace runs/johanna-1 --why 7.3
    """
    from comity.output.run_folder import open_run
    from comity.report.episodes.blackboard import blackboard_at, blackboard_text
    from comity.report.episodes.parting import parting
    from comity.report.episodes.reading_now import readings_at
    from comity.report.episodes.times import time_of
    from comity.report.episodes.trace import (
        after_end_text,
        end_text,
        load,
        reasons,
        refuse_several,
        selected,
        selected_disturbances,
        trace_answer,
    )
    from comity.report.episodes.undisclosed import undisclosed_in
    from comity.report.episodes.why import differences_text, why_text
    from comity.report.text import show

    listed = events or node is not None or between is not None
    refuse_several(
        {
            "--blackboard": blackboard,
            "--why": why is not None,
            "--diff": diff is not None,
            "--events, --node or --between": listed,
        }
    )
    refuse_several({"--diff": diff is not None, "--at": at is not None})
    recorded = load(open_run(run))
    entries = blackboard_at(open_run(run), at) if blackboard else None
    chosen = selected(recorded, node=node, between=between, until=at)
    around = selected_disturbances(recorded, node=node, between=between, until=at)
    whys = reasons(recorded, why, at) if why is not None else None
    readings = readings_at(open_run(run), at if (t := time_of(why)) is None else t) if why else {}
    apart = parting(recorded, load(open_run(diff))) if diff is not None else None
    if as_json:
        print_json(
            trace_answer(
                recorded, chosen, around, whys=whys, differences=apart, entries=entries, readings=readings
            )
        )
    elif entries is not None:
        show(*blackboard_text(entries), *end_text(recorded, entries, at))
    elif whys is not None:
        undisclosed = undisclosed_in(open_run(run))
        show(*after_end_text(recorded, why or ""), *why_text(whys, readings, undisclosed))
    elif apart is not None:
        show(*differences_text(apart, (str(run), str(diff))))
    else:
        show(*(_changes(recorded, chosen, around, at) if listed else _whole(recorded, at)))


def _changes(
    recorded: StoredTrace,
    chosen: Sequence[TraceEvent],
    around: Sequence[Disturbance],
    at: float | None,
) -> Iterator[str]:
    """Those that were chosen, a line each, with what happened around them, and where the run ended."""
    from comity.report.episodes.trace import end_text, events_text

    yield from events_text(chosen, around)
    yield from end_text(recorded, (*chosen, *around), at)


def _whole(recorded: StoredTrace, at: float | None) -> Iterator[str]:
    """The tree, where the run ended, and how much room it takes."""
    from comity.report.episodes.trace import end_text, size_text, tree_at

    yield tree_at(recorded, at)
    yield from end_text(recorded, recorded.history.events, at)
    if sizes := recorded.account.bytes_per_minute:
        yield f"\nSize  {size_text(sizes)}"
