"""The trace of a run: the tree with its states, and the events with their causes."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from comity.answers import EventAnswer, TraceAnswer
from comity.run_folder import RUN, TRACE
from comity_executor import Node, TraceEvent, read_nodes, read_trace, tree_text
from comity_fis import InputError, Where, closest

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Sized

    from comity.run_folder import RunFolder


@dataclass(frozen=True, slots=True)
class Recorded:
    """A trace as it was read back."""

    episode: str
    nodes: tuple[Node, ...]
    events: tuple[TraceEvent, ...]

    @property
    def end_s(self) -> float:
        """When the last thing happened."""
        return self.events[-1].t if self.events else 0.0


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

    Raises:
        InputError: if no node is called so, or the times are in the wrong order.
    """
    _check_node(recorded, node)
    _check_times(between)
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


def _check_node(recorded: Recorded, node: str | None) -> None:
    names = {known.name for known in recorded.nodes} | {event.node for event in recorded.events}
    if node is not None and not any(node in name for name in names):
        raise InputError(
            expected="a part of the name of a node of this run",
            got=repr(node),
            remedy=closest(node, names),
            where=Where("--node"),
        )


def _check_times(between: tuple[float, float] | None) -> None:
    if between is not None and not between[0] <= between[1]:
        raise InputError(
            expected="two times in order, the earlier one first",
            got=f"{between[0]:g} {between[1]:g}",
            remedy=f"Write --between {min(between):g} {max(between):g}.",
            where=Where("--between"),
        )


def end_text(recorded: Recorded, chosen: Sized, until: float | None) -> Iterator[str]:
    """What needs to be said where a time is beyond the end, or nothing was chosen."""
    end = f"the run ended at t={recorded.end_s:.2f} s"
    if until is not None and until > recorded.end_s:
        yield f"Nothing changes after that: {end}."
    elif not chosen:
        yield f"No change of these nodes in this time; {end}."


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
