"""A trace on disk that grows while the tree runs, so that a crash keeps what happened before it.

A long one is written in parts: `trace.jsonl`, `trace-2.jsonl` and so on, which together are the trace.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from pathlib import Path
from types import TracebackType

from comity_executor.nodes.node import Node
from comity_executor.tracing.trace import TraceEncoding, TraceEvent

PART_BYTES = 16_000_000
"""A part that has grown to this is the last of its size: an editor opens it still (our choice)."""


def parts_of(path: Path) -> tuple[Path, ...]:
    """The parts of a trace in their order, the first of them as it is named."""
    parts = [path]
    while (after := _part(path, len(parts) + 1)).exists():
        parts.append(after)
    return tuple(parts)


def _part(path: Path, number: int) -> Path:
    return path.with_stem(f"{path.stem}-{number}")


class TraceFile:
    """An open trace; the bytes of its parts are those of `trace_lines`, whenever they are written.

    Args:
        path: Where to write; what is there is replaced, older parts included.
        nodes: The tree, for the first line.
        part_bytes: Another part begins once this one has so many.
    """

    def __init__(self, path: Path, nodes: Iterable[Node], *, part_bytes: int = PART_BYTES) -> None:
        for old in parts_of(path)[1:]:
            old.unlink()
        self._path, self._part_bytes, self._parts, self._bytes = path, part_bytes, 1, 0
        self._file = path.open("w", encoding="utf-8", newline="\n")
        self._encoding = TraceEncoding()
        self._written = 0
        self._write([self._encoding.header(tuple(nodes))])

    def keep(self, events: Sequence[TraceEvent], nodes: Sequence[Node] = ()) -> None:
        """Write down those that are not yet.

        Args:
            events: All so far, in the order in which they happened.
            nodes: The trees of all plans so far; what is new of them is written before its first event.
        """
        self._write(line for event in events[self._written :] for line in self._encoding.lines(event, nodes))
        self._written = len(events)

    def __enter__(self) -> TraceFile:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._file.close()

    def _write(self, lines: Iterable[str]) -> None:
        for line in lines:
            if self._bytes >= self._part_bytes:
                self._file.close()
                self._parts, self._bytes = self._parts + 1, 0
                part = _part(self._path, self._parts)
                part.touch(self._path.stat().st_mode)  # no more people may read it than the first part
                self._file = part.open("w", encoding="utf-8", newline="\n")
            self._file.write(f"{line}\n")
            self._bytes += len(line.encode()) + 1
        self._file.flush()
