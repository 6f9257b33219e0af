"""The trace of a run: the tree with its states, and the events with their causes."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from comity.answers import EventAnswer, TraceAnswer
from comity.run_folder import RUN, TRACE
from comity_executor import Node, TraceEvent, read_nodes, read_trace, tree_text
from comity_fis import InputError, Where

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from comity.run_folder import RunFolder


@dataclass(frozen=True, slots=True)
class Recorded:
    """A trace as it was read back."""

    episode: str
    nodes: tuple[Node, ...]
    events: tuple[TraceEvent, ...]


def load(folder: RunFolder) -> Recorded:
    """The trace of a run folder.

    Raises:
        InputError: if it is missing or damaged.
    """
    path = folder / TRACE
    if not path.is_file():
        raise InputError(
            expected="a run with a trace",
            got="one that has none, because it crashed or is still running",
            remedy=f"See {folder / RUN}, and run the scenario again.",
            where=Where(str(folder.path)),
        )
    return Recorded(str(folder.path), read_nodes(path), read_trace(path))


def selected(
    recorded: Recorded, *, node: str | None, between: tuple[float, float] | None, until: float | None
) -> tuple[TraceEvent, ...]:
    """The events of some nodes and times.

    Args:
        recorded: The trace.
        node: A part of the names; all nodes when None.
        between: First and last time [s]; all times when None.
        until: The last time [s]; the end when None.
    """
    first, last = between or (0.0, float("inf"))
    last = min(last, until if until is not None else last)
    return tuple(
        event for event in recorded.events if first <= event.t <= last and (node or "") in event.node
    )


def trace_answer(recorded: Recorded, events: Iterable[TraceEvent]) -> TraceAnswer:
    """The answer of `comity trace --json`."""
    from dataclasses import asdict

    return TraceAnswer(
        episode=recorded.episode, events=tuple(EventAnswer.model_validate(asdict(event)) for event in events)
    )


def events_text(events: Iterable[TraceEvent]) -> Iterator[str]:
    """One line for every event: when, which node, what, and the nearest cause."""
    for event in events:
        halt = f" ({event.halt.replace('_', ' ')})" if event.halt else ""
        causes = " because ".join(cause.text for cause in reversed(event.because[:2]))
        yield f"t={event.t:6.2f}  {event.node} {event.status}{halt}" + (
            f"  because {causes}" if causes else ""
        )


def tree_at(recorded: Recorded, until: float | None) -> str:
    """The tree as it was at a time (at the end when None), with how often each node changed."""
    states: dict[int, str] = {}
    counts: dict[int, int] = {}
    for event in recorded.events:
        if until is None or event.t <= until:
            states[event.path] = event.status
            counts[event.path] = counts.get(event.path, 0) + 1
    changes = {1: "1 change"}
    return tree_text(
        recorded.nodes,
        {
            path: f"{state} ({changes.get(counts[path], f'{counts[path]} changes')})"
            for path, state in states.items()
        },
    )
