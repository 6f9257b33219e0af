"""Reading a trace back, whole or up to where a process was killed; what is damaged is named with its line."""

from __future__ import annotations

import json
import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cache
from itertools import pairwise
from pathlib import Path
from typing import TYPE_CHECKING, Any

from comity_executor.nodes.cause import Cause, CauseKind
from comity_executor.nodes.node import Node
from comity_executor.tracing.file import parts_of
from comity_executor.tracing.trace import FORMAT, EventStatus, Halt, TraceEvent
from comity_fis.errors import InputError, Where

if TYPE_CHECKING:
    from pydantic import TypeAdapter

_TREE = '{"nodes"'
"""How a line begins that describes the tree of another plan; an event's keys come in alphabetical order."""


@dataclass(frozen=True, slots=True)
class _Cause:
    """A cause as it is written, without what is empty."""

    kind: CauseKind
    text: str
    value: float | str | None = None


@dataclass(frozen=True, slots=True)
class _Line:
    """An event as it is written."""

    t: float
    node: str
    path: int
    status: EventStatus
    halt: Halt | None = None
    because: tuple[_Cause | int, ...] = ()


def read_trace(path: Path) -> tuple[TraceEvent, ...]:
    """Read the events of a trace, with all its parts.

    A last line without its end was being written when the run was killed.

    Raises:
        InputError: It is not a trace, of another format, or damaged; with file and line.
    """
    (head, first), *rest = _lines(path)
    trees = [(where, line) for where, line in rest if line.startswith(_TREE)]
    nodes = _nodes(first, head) + tuple(node for where, line in trees for node in _tree(line, where))
    lines_of_events = [(where, line) for where, line in rest if not line.startswith(_TREE)]
    events = tuple(_events(lines_of_events, nodes))
    places = [where for where, _ in lines_of_events]
    for where, (before, after) in zip(places[1:], pairwise(events), strict=False):
        if after.t < before.t:
            raise _damaged(f"t {after.t} after {before.t}", where, "times in order")
    return events


def read_nodes(path: Path) -> tuple[Node, ...]:
    """Read the description of the tree at the head of a trace, and of those of later plans.

    Raises:
        InputError: It is not a trace, or of another format.
    """
    (head, first), *rest = _lines(path, errors="replace")
    trees = [(where, line) for where, line in rest if line.startswith(_TREE)]
    return _nodes(first, head) + tuple(node for where, line in trees for node in _tree(line, where))


def _lines(path: Path, *, errors: str = "strict") -> list[tuple[Where, str]]:
    """Every whole line of a trace with its place; at least one, however short the file is."""
    found: list[tuple[Where, str]] = []
    for part in parts_of(path):
        try:
            *lines, cut = (
                part.read_bytes().decode(errors=errors).split("\n")
            )  # a text may hold other line ends
        except (OSError, UnicodeDecodeError) as error:
            raise InputError(
                expected="a trace file",
                got=str(error),
                remedy="Name the trace of a run.",
                where=Where(str(part)),
            ) from error
        found += [(Where(str(part), number), line) for number, line in enumerate(lines or [cut], start=1)]
    return found


def _nodes(line: str, where: Where) -> tuple[Node, ...]:
    header = _header(line)
    if (found := header.get("format")) != FORMAT:
        raise InputError(
            expected=f'a first line with "format": "{FORMAT}"',
            got=repr(found) if found else "no such header",
            remedy="Name a trace that this version wrote, or run the scenario again.",
            where=where,
        )
    return _tree(line, where)


def _tree(line: str, where: Where) -> tuple[Node, ...]:
    try:
        return tuple(Node(**{**node, "about": tuple(node["about"])}) for node in _header(line)["nodes"])
    except (KeyError, TypeError) as error:
        raise _damaged(str(error), where, "the nodes of a tree") from error


def _header(line: str) -> dict[str, Any]:
    try:
        header = json.loads(line)
    except ValueError:
        return {}
    return header if isinstance(header, dict) else {}


def _events(lines: Sequence[tuple[Where, str]], nodes: Sequence[Node]) -> Iterator[TraceEvent]:
    known: list[Cause] = []
    for where, text in lines:
        line = _line(text, where)
        if not (0 <= line.path < len(nodes) and nodes[line.path].name == line.node):
            raise _damaged(f"path {line.path}", where, f"the place of {line.node}")
        because: list[Cause] = []
        for cause in line.because:
            if isinstance(cause, _Cause):
                known.append(Cause(cause.kind, cause.text, cause.value))
            elif not 0 <= cause < len(known):
                raise _damaged(f"cause {cause}", where, f"the number of one of {len(known)} causes before")
            because.append(known[cause if isinstance(cause, int) else -1])
        yield TraceEvent(line.t, nodes[line.path], line.status, line.halt, tuple(because))


def _line(text: str, where: Where) -> _Line:
    from pydantic import ValidationError

    try:
        line = _adapter().validate_json(text, strict=True)
    except ValidationError as error:
        first = error.errors()[0]
        place = ".".join(map(str, first["loc"]))
        raise _damaged(f"{place}: {first['msg']}" if place else first["msg"], where) from error
    if not math.isfinite(line.t):
        raise _damaged(f"t {line.t}", where, "a finite time")
    if (line.status == "halted") != (line.halt is not None):
        raise _damaged(
            f"status {line.status} with halt {line.halt}", where, "a halt with status halted alone"
        )
    return line


def _damaged(got: str, where: Where, expected: str = "one event as a JSON object") -> InputError:
    remedy = "The file is damaged: run the scenario again."
    return InputError(expected=expected, got=got, remedy=remedy, where=where)


@cache
def _adapter() -> TypeAdapter[_Line]:
    from pydantic import TypeAdapter

    return TypeAdapter(_Line)
