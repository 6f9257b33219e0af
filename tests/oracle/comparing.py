"""Compare an episode that was played with the line that is kept of it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from tests.oracle.line import DIGEST, PLANNED, Line

Kind = Literal["equal", "equal but for the digest", "other plan", "other outcome", "not kept yet"]


@dataclass(frozen=True, slots=True)
class Comparison:
    """What became of one case."""

    kept: Line | None
    now: Line
    same_fingerprint: bool
    """Whether digests can be compared."""

    @property
    def changed(self) -> list[str]:
        """Keys whose values differ, in the order of a line."""
        kept = self.kept or {}
        keys = [key for key in kept | self.now if kept.get(key) != self.now.get(key)]
        return [key for key in keys if key != DIGEST or self.same_fingerprint]

    @property
    def kind(self) -> Kind:
        """What kind of change it is; another plan explains another outcome."""
        changed = set(self.changed)
        if self.kept is None:
            return "not kept yet"
        if changed & set(PLANNED):
            return "other plan"
        if changed - {DIGEST}:
            return "other outcome"
        return "equal but for the digest" if changed else "equal"

    @property
    def text(self) -> str:
        """The case, its kind, and every changed value but the digest's."""
        kept = self.kept or {}
        shown = [
            f"    {key}: {_difference(kept.get(key), self.now.get(key))}"
            for key in self.changed
            if key != DIGEST
        ]
        return "\n".join([f"{self.now['case']}: {self.kind}", *shown])


def _difference(before: object, now: object) -> str:
    """Show of two tables only the entries that differ."""
    if isinstance(before, dict) and isinstance(now, dict):
        keys = [key for key in before | now if before.get(key) != now.get(key)]
        return ", ".join(f"{key} ({_difference(before.get(key), now.get(key))})" for key in keys)
    return f"{before} -> {now}"
