"""How often a change makes another plan, or only other numbers for the same one."""

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
class PlansAnew:
    """Other steps take over: another order, side or greeting, or the rest of the visits."""

    RULE: ClassVar[str] = "_PLANS_ANEW times"
    EXAMPLE: ClassVar[str] = "plans anew exactly once"
    STATUS: ClassVar[str] = "replanned"
    VERB: ClassVar[str] = "planned anew"

    often: Times

    @classmethod
    def read(cls, parts: Sequence[Any]) -> Self:
        """From how often."""
        (often,) = parts
        return cls(often or AT_LEAST_ONCE)

    @property
    def people(self) -> Sequence[str]:
        """Nobody."""
        return ()

    def judge(self, trial: Trial) -> Iterator[Finding]:
        """A count that is wrong, with every change of the plan and its reason."""
        changes = [event for event in trial.episode.events if event.node == "plan_holds?"]
        count = sum(event.status == self.STATUS for event in changes)
        if not self.often.holds(count):
            because = tuple(line for event in changes for line in causes.of_event(event))
            yield Finding(f"{self.VERB} {self.often}", times(count), because)


@dataclass(frozen=True, slots=True)
class NeverPlansAnew(PlansAnew):
    """The first plan is carried out."""

    RULE: ClassVar[str] = "_NEVER _PLANS_ANEW"
    EXAMPLE: ClassVar[str] = "never plans anew"

    @classmethod
    def read(cls, parts: Sequence[Any]) -> Self:
        """From nothing more."""
        return cls(NEVER)


@dataclass(frozen=True, slots=True)
class BindsAnew(PlansAnew):
    """The steps stay, and go on with new numbers."""

    RULE: ClassVar[str] = "_BINDS_ANEW times"
    EXAMPLE: ClassVar[str] = "binds anew exactly once"
    STATUS: ClassVar[str] = "rebound"
    VERB: ClassVar[str] = "bound anew"


@dataclass(frozen=True, slots=True)
class NeverBindsAnew(NeverPlansAnew):
    """The plan's numbers are carried out as they were, for as long as its steps stay."""

    RULE: ClassVar[str] = "_NEVER _BINDS_ANEW"
    EXAMPLE: ClassVar[str] = "never binds anew"
    STATUS: ClassVar[str] = BindsAnew.STATUS
    VERB: ClassVar[str] = BindsAnew.VERB
