"""How often a node of the behaviour tree succeeds or fails."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar, Self

from comity.testing.expectation import Finding
from comity.testing.metrics import causes
from comity.testing.metrics.amount import AT_LEAST_ONCE, NEVER, Times, times

if TYPE_CHECKING:
    from comity.testing.trials.trial import Trial


@dataclass(frozen=True, slots=True)
class Succeeds:
    """Counted over all nodes of the name."""

    RULE: ClassVar[str] = "NAME _SUCCEEDS [times]"
    EXAMPLE: ClassVar[str] = "docked? succeeds at least once"
    STATUS: ClassVar[str] = "success"

    node: str
    often: Times

    @classmethod
    def read(cls, parts: Sequence[Any]) -> Self:
        """From a node and how often."""
        node, often = parts
        return cls(node, often or AT_LEAST_ONCE)

    @property
    def people(self) -> Sequence[str]:
        """Nobody."""
        return ()

    def judge(self, trial: Trial) -> Iterator[Finding]:
        """A count that is wrong, with the results that were counted."""
        events = trial.events_of(self.node)
        results = [event for event in events if event.status == self.STATUS]
        if not self.often.holds(len(results)):
            because = (
                *causes.of_events(trial, self.node, results[:4] or events[-1:]),
                *(() if events else causes.of_unserved(trial)),
            )
            expected = f"{self.node} ends with {self.STATUS} {self.often}"
            yield Finding(expected, times(len(results)), because)


@dataclass(frozen=True, slots=True)
class Fails(Succeeds):
    """The same for failures."""

    RULE: ClassVar[str] = "NAME _FAILS [times]"
    EXAMPLE: ClassVar[str] = "Dock_to_user fails at most once"
    STATUS: ClassVar[str] = "failure"


@dataclass(frozen=True, slots=True)
class NeverSucceeds(Succeeds):
    """The same for never."""

    RULE: ClassVar[str] = "NAME _NEVER _SUCCEEDS"
    EXAMPLE: ClassVar[str] = "Give_up never succeeds"

    @classmethod
    def read(cls, parts: Sequence[Any]) -> Self:
        """From a node."""
        (node,) = parts
        return cls(node, NEVER)


@dataclass(frozen=True, slots=True)
class NeverFails(NeverSucceeds):
    """The same for failures."""

    RULE: ClassVar[str] = "NAME _NEVER _FAILS"
    EXAMPLE: ClassVar[str] = "Dock_to_user never fails"
    STATUS: ClassVar[str] = "failure"
