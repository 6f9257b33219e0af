"""The trace: what every node of the tree did and why, as events in a canonical encoding.

A trace is text, one JSON object a line, with sorted keys and numbers rounded to a millionth: the same episode
gives the same bytes. The first line names the format and describes the tree; it holds no path, date or
version of this package. A new plan has a tree of its own, described in a line before its first event; its
nodes are numbered on.
"""

from __future__ import annotations

import hashlib
import json
import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import asdict, dataclass
from functools import cache
from itertools import pairwise
from pathlib import Path
from typing import TYPE_CHECKING, Literal

from comity_executor.cause import Cause
from comity_executor.node import Node
from comity_fis.errors import InputError, Where

if TYPE_CHECKING:
    from pydantic import TypeAdapter

FORMAT = "comity-trace-1"
_DECIMALS = 6
_TREE = '{"nodes"'
"""How a line begins that describes the tree of another plan; an event's keys come in alphabetical order."""

EventStatus = Literal["running", "success", "failure", "halted", "rebound", "replanned", "not_replanned"]
"""The last three are about the plan, and stand at `plan_holds?`.

`rebound`: it stays, with other numbers. `replanned`: it is a new one. `not_replanned`: the tree failed, and
no other plan took over.
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
    """One change of one node."""

    t: float
    """The world's time at the start of the tick, in seconds."""
    node: str
    path: int
    """The node's place in the tree, in pre-order."""
    status: EventStatus
    halt: Halt | None
    """Set if and only if the status is `halted`."""
    because: tuple[Cause, ...]
    """For a halt the chain of causes, nearest first; for a leaf's result what it read; else empty."""


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


class TraceEncoding:
    """Lines of one trace; it remembers which trees are described already."""

    def __init__(self) -> None:
        self._described = 0

    def header(self, nodes: Sequence[Node]) -> str:
        """The first line: the format and the first tree."""
        return _dump({"format": FORMAT, "nodes": self._next_tree(nodes)})

    def lines(self, event: TraceEvent, nodes: Sequence[Node]) -> Iterator[str]:
        """An event, and before it the trees up to the one that it is about, as far as they are new."""
        while self._described < len(nodes) and event.path >= self._described:
            yield _dump({"nodes": self._next_tree(nodes)})
        yield _dump(asdict(event))

    def _next_tree(self, nodes: Sequence[Node]) -> list[dict[str, object]]:
        roots = [node.path for node in nodes[self._described + 1 :] if node.parent is None]
        tree = nodes[self._described : roots[0] if roots else None]
        self._described += len(tree)
        return [asdict(node) for node in tree]


def trace_sha256(lines: Iterable[str]) -> str:
    """The digest of a trace in its canonical encoding; the same as that of its file."""
    digest = hashlib.sha256()
    for line in lines:
        digest.update(f"{line}\n".encode())
    return digest.hexdigest()


def read_trace(path: Path) -> tuple[TraceEvent, ...]:
    """Read the events of a trace; a last line without its end was being written when the run was killed.

    Raises:
        InputError: It is not a trace, of another format, or damaged; with file and line.
    """
    try:
        *lines, cut = path.read_bytes().decode(errors="strict").split("\n")  # a text may hold other line ends
    except (OSError, UnicodeDecodeError) as error:
        raise InputError(
            expected="a trace file", got=str(error), remedy="Name the trace of a run.", where=Where(str(path))
        ) from error
    _check_header(lines[0] if lines else cut, str(path))
    events = tuple(
        _event(line, Where(str(path), number))
        for number, line in enumerate(lines[1:], start=2)
        if not line.startswith(_TREE)
    )
    for number, (before, after) in enumerate(pairwise(events), start=3):
        if after.t < before.t:
            raise _damaged(f"t {after.t} after {before.t}", Where(str(path), number), "times in order")
    return events


def read_nodes(path: Path) -> tuple[Node, ...]:
    """Read the description of the tree at the head of a trace, and of those of later plans.

    Raises:
        InputError: It is not a trace, or of another format.
    """
    with path.open(encoding="utf-8", errors="replace", newline="\n") as file:
        head = file.readline()
        _check_header(head, str(path))
        lines = [head, *(line for line in file if line.startswith(_TREE) and line.endswith("\n"))]
    return tuple(Node(**node) for line in lines for node in json.loads(line)["nodes"])


def _check_header(line: str, file: str) -> None:
    try:
        header = json.loads(line)
    except ValueError:
        header = None
    found = header.get("format") if isinstance(header, dict) else None
    if found != FORMAT:
        got = repr(found) if found else "no such header"
        raise InputError(
            expected=f'a first line with "format": "{FORMAT}"',
            got=got,
            remedy="Name a trace that this version wrote, or run the scenario again.",
            where=Where(file, 1),
        )


def _event(line: str, where: Where) -> TraceEvent:
    from pydantic import ValidationError

    try:
        event = _adapter().validate_json(line, strict=True)
    except ValidationError as error:
        first = error.errors()[0]
        place = ".".join(map(str, first["loc"]))
        raise _damaged(f"{place}: {first['msg']}" if place else first["msg"], where) from error
    if not math.isfinite(event.t):
        raise _damaged(f"t {event.t}", where, "a finite time")
    if (event.status == "halted") != (event.halt is not None):
        raise _damaged(
            f"status {event.status} with halt {event.halt}", where, "a halt with status halted alone"
        )
    return event


def _damaged(got: str, where: Where, expected: str = "one event as a JSON object") -> InputError:
    remedy = "The file is damaged: run the scenario again."
    return InputError(expected=expected, got=got, remedy=remedy, where=where)


@cache
def _adapter() -> TypeAdapter[TraceEvent]:
    from pydantic import TypeAdapter

    return TypeAdapter(TraceEvent)


def _dump(record: object) -> str:
    return json.dumps(
        _rounded(record), sort_keys=True, ensure_ascii=False, separators=(", ", ": "), allow_nan=False
    )


def _rounded(value: object) -> object:
    """Numbers to a millionth, without a negative zero; what is not finite becomes null."""
    match value:
        case float():
            return round(value, _DECIMALS) + 0.0 if math.isfinite(value) else None
        case dict():
            return {key: _rounded(item) for key, item in value.items()}
        case list() | tuple():
            return [_rounded(item) for item in value]
    return value
