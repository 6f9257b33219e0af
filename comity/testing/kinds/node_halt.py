"""How often a node of the behaviour tree is halted, and by what."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar, Self

from comity.testing import causes
from comity.testing.amount import AT_LEAST_ONCE, NEVER, Times, times
from comity.testing.expectation import Finding

if TYPE_CHECKING:
    from comity.testing.trial import Trial
    from comity_executor import TraceEvent


@dataclass(frozen=True, slots=True)
class Halt:
    """By a condition or another node: a part of any link of the halt's chain of causes."""

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
        paths = set(trial.nodes_like(self.node))
        if self.by:
            list(trial.nodes_like(self.by))
        halts = [event for event in trial.episode.events if event.halt and event.path in paths]
        count = sum(self._is_meant(halt) for halt in halts)
        if not self.often.holds(count):
            by = f" by {self.by}" if self.by else ""
            because = [line for halt in halts for line in causes.of_event(halt)]
            yield Finding(
                f"{self.node} halted{by} {self.often}",
                f"{times(count)}; {self.node} was halted {times(len(halts))} in all",
                tuple(because) or ("no node of that name was ever halted",),
            )

    def _is_meant(self, halt: TraceEvent) -> bool:
        return self.by is None or any(self.by in cause.text for cause in halt.because)


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
