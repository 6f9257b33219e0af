"""How often a node of the behaviour tree is halted, and by what."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar, Self

from comity.testing.expectation import Finding
from comity.testing.metrics import causes
from comity.testing.metrics.amount import AT_LEAST_ONCE, NEVER, Times, times

if TYPE_CHECKING:
    from comity.testing.trials.trial import Trial
    from comity_executor import TraceEvent


@dataclass(frozen=True, slots=True)
class Halt:
    """By a condition or another node: one that is named in the halt's chain of causes."""

    RULE: ClassVar[str] = "NAME _IS _HALTED [_BY NAME] [times]"
    EXAMPLE: ClassVar[str] = "utter is halted by docked? at least once"

    node: str
    by: str | None
    often: Times

    @classmethod
    def read(cls, parts: Sequence[Any]) -> Self:
        """From two nodes and how often."""
        node, by, often = parts
        return cls(node, by, often or AT_LEAST_ONCE)

    @property
    def people(self) -> Sequence[str]:
        """Nobody."""
        return ()

    def judge(self, trial: Trial) -> Iterator[Finding]:
        """A count that is wrong, with all halts of the node."""
        events = trial.events_of(self.node)
        by_whom = tuple(node.name for node in trial.nodes_named(self.by)) if self.by else ()
        halts = [event for event in events if event.halt]
        count = sum(self.by is None or _names(halt, by_whom) for halt in halts)
        if not self.often.holds(count):
            by = f" by {self.by}" if self.by else ""
            got = times(count)
            if not halts:
                got = f"{self.node} was never halted"
            elif self.by:
                got += f"; in all {self.node} was halted {times(len(halts))}"
            because = tuple(causes.of_events(trial, self.node, halts))
            expected = f"{self.node} halted{by} {self.often}"
            yield Finding(expected, got, because or tuple(causes.of_last(trial, self.node)))


@dataclass(frozen=True, slots=True)
class NeverHalt(Halt):
    """The same for never."""

    RULE: ClassVar[str] = "NAME _IS _NEVER _HALTED [_BY NAME]"
    EXAMPLE: ClassVar[str] = "utter is never halted by docked?"

    @classmethod
    def read(cls, parts: Sequence[Any]) -> Self:
        """From two nodes."""
        node, by = parts
        return cls(node, by, NEVER)


def _names(halt: TraceEvent, nodes: Sequence[str]) -> bool:
    """Whether a link of the chain of causes, such as `docked?(host) -> success`, names one of the nodes."""
    whole = [re.compile(rf"(?<![\w?]){re.escape(node)}(?![\w?(])") for node in nodes]
    return any(name.search(cause.text) for name in whole for cause in halt.because)
