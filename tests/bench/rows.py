"""What a bench measures: rows of a table, with the spread of the rounds."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from statistics import median


@dataclass(frozen=True, slots=True, kw_only=True)
class Row:
    """One contestant at one task."""

    suite: str
    task: str
    contestant: str
    seconds: tuple[float, ...] = ()
    """Per unit (a call, an input, a tick), one for each round."""
    per: str = "call"
    ratios: tuple[float, ...] = ()
    """How many times as long as the task's first contestant it took, round by round; empty for the first."""
    peak_bytes: int | None = None
    """The most memory that one call held beyond its inputs."""
    note: str = ""
    """A limit, an extrapolation, or why nothing was measured."""

    def as_json(self) -> dict[str, object]:
        """Everything, and the medians."""
        return {
            "suite": self.suite,
            "task": self.task,
            "contestant": self.contestant,
            "per": self.per,
            "median_s": median(self.seconds) if self.seconds else None,
            "seconds": list(self.seconds),
            "median_ratio": median(self.ratios) if self.ratios else None,
            "ratios": list(self.ratios),
            "peak_bytes": self.peak_bytes,
            "note": self.note,
        }


def table(rows: Sequence[Row]) -> str:
    """The rows for a person to read."""
    head = ("suite", "task", "contestant", "median", "times the first (spread)", "peak", "note")
    lines = [head, *(_cells(row) for row in rows)]
    widths = [max(len(line[i]) for line in lines) for i in range(len(head))]
    return "\n".join(
        "  ".join(cell.ljust(width) for cell, width in zip(line, widths, strict=True)).rstrip()
        for line in lines
    )


def _cells(row: Row) -> tuple[str, ...]:
    time = f"{_seconds(median(row.seconds))}/{row.per}" if row.seconds else "-"
    spread = f"{median(row.ratios):.4g} ({min(row.ratios):.4g}..{max(row.ratios):.4g})" if row.ratios else ""
    peak = f"{row.peak_bytes / 1e6:.1f} MB" if row.peak_bytes is not None else ""
    return row.suite, row.task, row.contestant, time, spread, peak, row.note


def _seconds(value: float) -> str:
    for factor, unit in ((1.0, "s"), (1e3, "ms"), (1e6, "us")):
        if value * factor >= 1:
            return f"{value * factor:.3g} {unit}"
    return f"{value * 1e9:.3g} ns"
