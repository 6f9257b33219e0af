"""A trace on disk that grows while the tree runs, so that a crash keeps what happened before it."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from pathlib import Path
from types import TracebackType

from comity_executor.nodes.node import Node
from comity_executor.tracing.trace import TraceEncoding, TraceEvent


class TraceFile:
    """An open trace; its bytes are those of `trace_lines`, whenever they are written.

    Args:
        path: Where to write; what is there is replaced.
        nodes: The tree, for the first line.
    """

    def __init__(self, path: Path, nodes: Iterable[Node]) -> None:
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
        self._file.writelines(f"{line}\n" for line in lines)
        self._file.flush()
