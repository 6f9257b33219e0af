"""Coverage: which outcomes of which leaves a set of runs has shown."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping
from dataclasses import dataclass

from comity_executor.tracing.history import History

OUTCOMES: Mapping[str, tuple[str, ...]] = {
    "condition": ("success", "failure"),
    "action": ("success", "failure", "halted"),
}
"""Possible outcomes by kind of leaf."""


@dataclass(frozen=True, slots=True)
class LeafCoverage:
    """One behaviour, over all people."""

    leaf: str
    """The name without the person: `docked?`, `Dock_to_user`."""
    seen: Mapping[str, int]
    """Count of each outcome; 0 for those that never occurred."""

    @property
    def never(self) -> tuple[str, ...]:
        """The outcomes that no run has shown."""
        return tuple(outcome for outcome, count in self.seen.items() if not count)


def leaf_coverage(histories: Iterable[History]) -> tuple[LeafCoverage, ...]:
    """What the leaves of some runs' trees did, taken together; in the order of the trees."""
    kinds: dict[str, str] = {}
    counts: Counter[tuple[str, str]] = Counter()
    for history in histories:
        for node in history.nodes:
            if node.kind in OUTCOMES:
                kinds.setdefault(node.action, node.kind)
        counts.update((history.nodes[event.path].action, event.status) for event in history.events)
    return tuple(
        LeafCoverage(leaf, {outcome: counts[leaf, outcome] for outcome in OUTCOMES[kind]})
        for leaf, kind in kinds.items()
    )
