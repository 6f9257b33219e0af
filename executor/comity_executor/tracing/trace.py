"""The trace: what every node of the tree did and why, as events in a canonical encoding.

A trace is text, one JSON object a line, with sorted keys and numbers rounded to a millionth: the same episode
gives the same bytes. The first line names the format and describes the tree; it holds no path, date or
version of this package. Every further line is an event. Most causes come again and again: each is written out
where it comes first, and from then on it is its number, counted from 0. What is empty is left out. A new plan
has a tree of its own, described in a line before its first event; its nodes are numbered on.
"""

from __future__ import annotations

import hashlib
import json
import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import asdict, dataclass
from typing import Literal

from comity_executor.nodes.cause import Cause
from comity_executor.nodes.node import Node

FORMAT = "comity-trace-3"
_DECIMALS = 6
_encode = json.JSONEncoder(ensure_ascii=False, separators=(",", ":"), allow_nan=False).encode

EventStatus = Literal["running", "success", "failure", "halted", "rebound", "replanned", "not_replanned"]
"""The last three are about the plan, and stand at `plan_holds?`.

`rebound`: it stays, with other numbers. `replanned`: it is a new one. `not_replanned`: the tree failed and
no other plan took over, or the planner broke down: then all of the plan stays
that is still permitted.
"""

Halt = Literal["preempted", "timed_out", "achieved_early", "parent_ended", "emergency"]
"""How a running node was stopped from above.

`preempted`: a sibling with precedence runs again, or a condition before it no longer holds. `timed_out`: its
time was over. `achieved_early`: what it worked for turned true. `parent_ended`: its parent ended for another
reason, such as a parallel that is done. `emergency`: the emergency stop was pressed, or the whole tree was
stopped.
"""


@dataclass(frozen=True, slots=True)
class TraceEvent:
    """One change of one node, or what it came to in another attempt."""

    t: float
    """The world's time at the start of the tick, in seconds."""
    of: Node
    """The node that it happened to."""
    status: EventStatus
    halt: Halt | None
    """Set if and only if the status is `halted`."""
    because: tuple[Cause, ...]
    """For a halt the chain of causes, nearest first; for the result of a leaf, or of a decorator that had a
    say in it, what it rests on; else empty."""

    @property
    def node(self) -> str:
        """The node's name, for display."""
        return self.of.name

    @property
    def path(self) -> int:
        """The node's place in the tree, in pre-order."""
        return self.of.path

    @property
    def action(self) -> str:
        """What the node does or asks: `Dock_to_user`, `docked?`."""
        return self.of.action

    @property
    def person(self) -> str | None:
        """The person in whose visit the node is; None for nodes of the whole run."""
        return self.of.person


class TraceEncoding:
    """Lines of one trace; it remembers which trees and causes are written out already."""

    def __init__(self) -> None:
        self._described = 0
        self._numbers: dict[tuple[str, str, object], int] = {}

    def header(self, nodes: Sequence[Node]) -> str:
        """The first line: the format and the first tree."""
        return _encode({"format": FORMAT, "nodes": self._next_tree(nodes)})

    def lines(self, event: TraceEvent, nodes: Sequence[Node]) -> Iterator[str]:
        """The next line, and before it the trees up to the one that it is about, as far as they are new."""
        while self._described < len(nodes) and event.path >= self._described:
            yield _encode({"nodes": self._next_tree(nodes)})
        yield self._line(event)

    def _next_tree(self, nodes: Sequence[Node]) -> list[dict[str, object]]:
        roots = [node.path for node in nodes[self._described + 1 :] if node.parent is None]
        tree = nodes[self._described : roots[0] if roots else None]
        self._described += len(tree)
        return [asdict(node) for node in tree]

    def _line(self, event: TraceEvent) -> str:
        """Keys in alphabetical order."""
        record: dict[str, object] = {}
        if event.because:
            record["because"] = [self._cause(cause) for cause in event.because]
        if event.halt:
            record["halt"] = event.halt
        record |= {"node": event.node, "path": event.path, "status": event.status, "t": _rounded(event.t)}
        return _encode(record)

    def _cause(self, cause: Cause) -> int | dict[str, object]:
        value = _rounded(cause.value)
        key = (cause.kind, cause.text, value)
        if (number := self._numbers.get(key)) is not None:
            return number
        self._numbers[key] = len(self._numbers)
        written: dict[str, object] = {"kind": cause.kind, "text": cause.text}
        return written if value is None else written | {"value": value}


def trace_lines(events: Iterable[TraceEvent], nodes: Iterable[Node] = ()) -> Iterator[str]:
    """The canonical encoding, without line ends.

    Args:
        events: In the order in which they happened.
        nodes: The tree, for the header; those of later plans behind it.
    """
    encoding, nodes = TraceEncoding(), tuple(nodes)
    yield encoding.header(nodes)
    for event in events:
        yield from encoding.lines(event, nodes)


def trace_sha256(lines: Iterable[str]) -> str:
    """The digest of a trace in its canonical encoding; the same as that of its file."""
    digest = hashlib.sha256()
    for line in lines:
        digest.update(f"{line}\n".encode())
    return digest.hexdigest()


def _rounded(value: float | str | None) -> float | str | None:
    """Numbers to a millionth, without a negative zero; what is not finite becomes null."""
    if isinstance(value, float):
        return round(value, _DECIMALS) + 0.0 if math.isfinite(value) else None
    return value
