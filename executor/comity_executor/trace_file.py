"""A trace on disk that grows while the tree runs, so that a crash keeps what happened before it."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from pathlib import Path
from types import TracebackType

from comity_executor.node import Node
from comity_executor.trace import TraceEncoding, TraceEvent


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
        self._write([self._encoding.header(nodes)])

    def keep(self, events: Sequence[TraceEvent]) -> None:
        """Write down those that are not yet.

        Args:
            events: All so far, in the order in which they happened.
        """
        self._write(map(self._encoding.line, events[self._written :]))
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
