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

from comity_executor.cause import Cause
from comity_executor.node import Node
from comity_executor.trace import FORMAT, EventStatus, Halt, TraceEvent
from comity_fis.errors import InputError, Where

if TYPE_CHECKING:
    from pydantic import TypeAdapter


@dataclass(frozen=True, slots=True)
class _Line:
    """An event as it is written."""

    t: float
    node: str
    path: int
    status: EventStatus
    halt: Halt | None = None
    because: tuple[Cause | int, ...] = ()


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
    nodes = _nodes(lines[0] if lines else cut, str(path))
    events = tuple(_events(lines[1:], str(path)))
    for number, (before, after) in enumerate(pairwise(events), start=3):
        if after.t < before.t:
            raise _damaged(f"t {after.t} after {before.t}", Where(str(path), number), "times in order")
    for number, event in enumerate(events, start=2):
        if nodes and not (0 <= event.path < len(nodes) and nodes[event.path].name == event.node):
            raise _damaged(f"path {event.path}", Where(str(path), number), f"the place of {event.node}")
    return events


def read_nodes(path: Path) -> tuple[Node, ...]:
    """Read the description of the tree at the head of a trace.

    Raises:
        InputError: It is not a trace, or of another format.
    """
    with path.open(encoding="utf-8", errors="replace") as file:
        return _nodes(file.readline(), str(path))


def _nodes(line: str, file: str) -> tuple[Node, ...]:
    header = _header(line)
    if (found := header.get("format")) != FORMAT:
        raise InputError(
            expected=f'a first line with "format": "{FORMAT}"',
            got=repr(found) if found else "no such header",
            remedy="Name a trace that this version wrote, or run the scenario again.",
            where=Where(file, 1),
        )
    try:
        return tuple(Node(**node) for node in header["nodes"])
    except (KeyError, TypeError) as error:
        raise _damaged(str(error), Where(file, 1), "the nodes of a tree") from error


def _header(line: str) -> dict[str, Any]:
    try:
        header = json.loads(line)
    except ValueError:
        return {}
    return header if isinstance(header, dict) else {}


def _events(lines: Sequence[str], file: str) -> Iterator[TraceEvent]:
    known: list[Cause] = []
    for number, text in enumerate(lines, start=2):
        where = Where(file, number)
        line = _line(text, where)
        because: list[Cause] = []
        for cause in line.because:
            if isinstance(cause, Cause):
                known.append(cause)
            elif not 0 <= cause < len(known):
                raise _damaged(f"cause {cause}", where, f"the number of one of {len(known)} causes before")
            because.append(known[cause] if isinstance(cause, int) else cause)
        yield TraceEvent(line.t, line.node, line.path, line.status, line.halt, tuple(because))


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
