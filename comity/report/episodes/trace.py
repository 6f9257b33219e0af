"""The trace of a run: the tree with its states, and the events with their causes."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass
from hashlib import sha256
from heapq import merge
from math import inf
from types import MappingProxyType
from typing import TYPE_CHECKING

from comity.answers.run import Disturbance, RunAnswer
from comity.answers.trace import TraceAnswer
from comity.output.run_folder import INTERRUPTED, RUN, TRACE
from comity.report.episodes.times import check_time, check_times, time_of
from comity.report.episodes.why import OF_PLANS, difference_answer, event_answer, fault_text, reason_answer
from comity_executor import (
    Divergence,
    History,
    NodeExplanation,
    TraceEvent,
    read_nodes,
    read_trace,
    tree_text,
)
from comity_fis import InputError, Where, unknown_word
from comity_fis.listing import listed

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Mapping, Sized
    from pathlib import Path

    from comity.answers.trace import ReadingAnswer
    from comity.output.run_folder import RunFolder
    from comity_executor import Write

NO_READINGS: Mapping[str, ReadingAnswer] = MappingProxyType({})


@dataclass(frozen=True, slots=True)
class StoredTrace:
    """A stored trace."""

    episode: str
    history: History
    account: RunAnswer
    ending: str | None
    """State of an unfinished run; None if it is done."""


def load(folder: RunFolder) -> StoredTrace:
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
    account = folder.read(RUN, RunAnswer)
    history = History(read_nodes(path), read_trace(path))
    if account.status == "done":
        _refuse_other(path, account.trace_sha256)
    return StoredTrace(str(folder.path), history, account, _ending(folder, account))


def _ending(folder: RunFolder, account: RunAnswer) -> str | None:
    if account.status == "done":
        return None
    if account.error == INTERRUPTED:
        return "The run was interrupted. What happened before is here."
    if account.error:
        return f"The run crashed: {account.error}. What happened before is here."
    if folder.is_written_to():
        return "The run still goes on; this is how far it has come."
    return "The run was killed; up to a second of what happened last is missing."


def _refuse_other(path: Path, digest: str | None) -> None:
    """Refuse a trace that differs from the one the run ended with: it was truncated or changed."""
    if digest is not None and sha256(path.read_bytes()).hexdigest() != digest:
        raise InputError(
            expected=f"the trace that the run's {RUN} names by its digest",
            got="another one, cut off or changed",
            remedy="Copy the folder again, or run the scenario again.",
            where=Where(str(path)),
        )


def selected(
    recorded: StoredTrace, *, node: str | None, between: tuple[float, float] | None, until: float | None
) -> tuple[TraceEvent, ...]:
    """The events of some nodes and times.

    Args:
        recorded: The trace.
        node: Part of the nodes' names; None for all nodes.
        between: First and last time [s]; None for all times.
        until: The last time [s]; None for the end.

    Raises:
        InputError: if no node matches, a time is invalid, or the times are in the wrong order.
    """
    _check_node(recorded, node)
    check_time(until)
    check_times(between, recorded.history.end_s)
    first, last = _span(between, until)
    return tuple(
        event for event in recorded.history.events if first <= event.t <= last and (node or "") in event.node
    )


def selected_disturbances(
    recorded: StoredTrace, *, node: str | None, between: tuple[float, float] | None, until: float | None
) -> tuple[Disturbance, ...]:
    """Disturbances at some times; arguments as for `selected`, which checks them."""
    first, last = _span(between, until)
    return tuple(
        one for one in recorded.account.disturbances if first <= one.t <= last and (node or "") in one.about
    )


def _span(between: tuple[float, float] | None, until: float | None) -> tuple[float, float]:
    first, last = between or (0.0, inf)
    return (first, min(last, until if until is not None else last))


def trace_answer(
    recorded: StoredTrace,
    events: Iterable[TraceEvent],
    disturbances: Iterable[Disturbance],
    *,
    whys: Iterable[NodeExplanation] | None = None,
    differences: Iterable[Divergence] | None = None,
    entries: Iterable[Write] | None = None,
    readings: Mapping[str, ReadingAnswer] = NO_READINGS,
) -> TraceAnswer:
    """The answer of `comity trace --json`."""
    return TraceAnswer(
        episode=recorded.episode,
        status=recorded.account.status,
        bytes_per_minute=recorded.account.bytes_per_minute,
        events=tuple(map(event_answer, events)),
        disturbances=tuple(disturbances),
        blackboard=None if entries is None else tuple(entries),
        why=None if whys is None else tuple(reason_answer(why, readings) for why in whys),
        differences=None if differences is None else tuple(map(difference_answer, differences)),
    )


def _check_node(recorded: StoredTrace, node: str | None) -> None:
    names = _names(recorded)
    if node is not None and not (node.strip() and any(node in name for name in names)):
        raise _unknown_node(node, names, "--node")


def reasons(recorded: StoredTrace, word: str, until: float | None) -> tuple[NodeExplanation, ...]:
    """Causes of the tree's behaviour.

    Args:
        recorded: The trace.
        word: A time [s], or part of a node's name, for the last events of such nodes.
        until: The last time that counts for nodes [s]; None for the end.

    Raises:
        InputError: if it is neither, or such nodes have no events yet.
    """
    history = recorded.history
    if (t := time_of(word)) is not None:
        refuse_several({f"--why {word}": True, "--at": until is not None})
        return history.why_at(t)
    names = _names(recorded)
    paths = [node.path for node in history.nodes if node.name == word] or [
        node.path for node in history.nodes if word and word in node.name
    ]
    if not paths:
        raise _unknown_node(word, names, "--why", "a time in seconds, or ")
    found = [why for path in paths if (why := history.why_node(path, until))]
    if not found:
        raise InputError(
            expected="a node that did something by then",
            got=repr(word),
            remedy="`comity trace RUN` shows which nodes did.",
            where=Where("--why"),
        )
    return tuple(found)


def _names(recorded: StoredTrace) -> set[str]:
    history = recorded.history
    about = {one.about for one in recorded.account.disturbances}
    return {node.name for node in history.nodes} | {event.node for event in history.events} | about


def _unknown_node(word: str, names: set[str], option: str, or_else: str = "") -> InputError:
    return unknown_word(
        f"{or_else}a part of the name of a node of this run", word, names, where=Where(option)
    )


def refuse_several(asked: Mapping[str, bool]) -> None:
    """Refuse options that exclude each other.

    Args:
        asked: Whether each option was used; at most one may be.

    Raises:
        InputError: if more than one was.
    """
    used = [option for option, is_used in asked.items() if is_used]
    if len(used) > 1:
        raise InputError(
            expected="one question at a time",
            got=listed(used),
            remedy=f"Ask with {used[0]}, and then with {used[1]}.",
        )


def after_end_text(recorded: StoredTrace, why: str) -> Iterator[str]:
    """A note if the requested time is after the end."""
    t = time_of(why)
    if t is None or t <= recorded.history.end_s:
        return
    if recorded.ending:
        yield f"No change is known after t={recorded.history.end_s:.2f} s; the last that is:"
    else:
        yield f"At t={t:.2f} s nothing runs; the last that happened:"


def end_text(recorded: StoredTrace, chosen: Sized, until: float | None) -> Iterator[str]:
    """A note if a time is after the end, or nothing was selected."""
    end = f"the run ended at t={recorded.history.end_s:.2f} s"
    if recorded.ending:
        end = f"the last change known is at t={recorded.history.end_s:.2f} s"
    if until is not None and until > recorded.history.end_s:
        yield f"Nothing changes after that: {end}."
    elif not chosen:
        yield f"No change of these nodes in this time; {end}."
    if recorded.ending:
        yield recorded.ending


def size_text(bytes_per_minute: Mapping[str, int]) -> str:
    """Disk space of a run per minute, in words."""
    sizes = (f"{name} {size / 1000:.0f} kB" for name, size in bytes_per_minute.items())
    return f"{', '.join(sizes)} per simulated minute"


def events_text(events: Iterable[TraceEvent], disturbances: Iterable[Disturbance]) -> Iterator[str]:
    """One line for every event (time, node, status, nearest cause) and for every disturbance.

    At equal times the disturbance comes first: the world is stepped before the tree is ticked.
    """
    around = ((one.t, f"t={one.t:6.2f}  {disturbance_text(one)}") for one in disturbances)
    changes = ((event.t, _event_text(event)) for event in events)
    yield from (text for _, text in merge(around, changes, key=lambda line: line[0]))


def disturbance_text(one: Disturbance) -> str:
    """A disturbance and its end."""
    until = "" if one.end_s is None or one.end_s == one.t else f", until t={one.end_s:.2f} s"
    return f"{one.kind}: {one.text}{until}"


def _event_text(event: TraceEvent) -> str:
    """An event: time, node, status and nearest cause."""
    halt = f" ({event.halt.replace('_', ' ')})" if event.halt else ""
    near = [cause.text for cause in event.because if cause.kind in ("reading", "condition")]
    causes = "; ".join(near) if event.status in OF_PLANS else " because ".join(reversed(near))
    because = f"  because {causes}{fault_text(event.because)}" if causes else ""
    return f"t={event.t:6.2f}  {event.node} {event.status}{halt}{because}"


def tree_at(recorded: StoredTrace, until: float | None) -> str:
    """The tree at a time (None for the end), with the number of state changes of each node."""
    history = recorded.history
    states = history.states(until)
    counts = Counter(event.path for event in history.events if until is None or event.t <= until)
    changes = {1: "1 change"}
    return tree_text(
        history.nodes,
        {
            path: f"{state.status} ({changes.get(counts[path], f'{counts[path]} changes')})"
            for path, state in states.items()
        },
    )
