"""Why a node succeeds, fails or is halted, and why a plan is made or bound anew: words of the causes."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar, Self

from comity.testing.expectation import Finding
from comity.testing.metrics import causes
from comity.testing.metrics.amount import AT_LEAST_ONCE, Times, times
from comity.testing.metrics.words import holds

if TYPE_CHECKING:
    from comity.testing.trials.trial import Trial
    from comity_executor import TraceEvent

MOST = 6
"""Events that a failure shows: where another reason comes again and again, the first tell it."""


@dataclass(frozen=True, slots=True)
class SucceedsBecause:
    """So often with a reason that holds these words; whatever else it holds."""

    RULE: ClassVar[str] = "NAME _SUCCEEDS _BECAUSE NAME [times]"
    EXAMPLE: ClassVar[str] = "Give_up succeeds because 'anna cannot be reached' at least once"
    STATUS: ClassVar[str] = "success"
    VERB: ClassVar[str] = "succeeds"

    node: str
    words: str
    often: Times

    @classmethod
    def read(cls, parts: Sequence[Any]) -> Self:
        """From a node, words of a reason and how often."""
        node, words, often = parts
        return cls(node, words, often or AT_LEAST_ONCE)

    @property
    def people(self) -> Sequence[str]:
        """Nobody."""
        return ()

    def judge(self, trial: Trial) -> Iterator[Finding]:
        """A count that is wrong, with the reasons that there were."""
        results = [event for event in trial.events_of(self.node) if event.status == self.STATUS]
        speaking = [event for event in results if _holds(event, self.words)]
        if not self.often.holds(len(speaking)):
            expected = f"{self.node} {self.VERB} because of “{self.words}” {self.often}"
            got = f"{times(len(speaking))}, of {len(results)} in all"
            silent = [event for event in results if event not in speaking]
            shown = speaking if self.often.exceeded_by(len(speaking)) else silent or results
            because = tuple(causes.of_events(trial, self.node, shown[:MOST]))
            yield Finding(expected, got, because or (f"no event in which {self.node} {self.VERB}",))


@dataclass(frozen=True, slots=True)
class FailsBecause(SucceedsBecause):
    """The same for failures."""

    RULE: ClassVar[str] = "NAME _FAILS _BECAUSE NAME [times]"
    EXAMPLE: ClassVar[str] = "Navigate_to_user fails because 'a wheel is stuck' at least once"
    STATUS: ClassVar[str] = "failure"
    VERB: ClassVar[str] = "fails"


@dataclass(frozen=True, slots=True)
class HaltedBecause(SucceedsBecause):
    """The same for halts."""

    RULE: ClassVar[str] = "NAME _IS _HALTED _BECAUSE NAME [times]"
    EXAMPLE: ClassVar[str] = "Dock_to_user is halted because 'distance 0.64 m' exactly once"
    STATUS: ClassVar[str] = "halted"
    VERB: ClassVar[str] = "is halted"


@dataclass(frozen=True, slots=True)
class PlansAnewBecause(SucceedsBecause):
    """The same for a plan that takes over."""

    RULE: ClassVar[str] = "_PLANS_ANEW _BECAUSE NAME [times]"
    EXAMPLE: ClassVar[str] = "plans anew because 'guest moved' exactly once"
    STATUS: ClassVar[str] = "replanned"
    VERB: ClassVar[str] = "plans anew"

    @classmethod
    def read(cls, parts: Sequence[Any]) -> Self:
        """From words of a reason and how often."""
        words, often = parts
        return cls("plan_holds?", words, often or AT_LEAST_ONCE)


@dataclass(frozen=True, slots=True)
class BindsAnewBecause(PlansAnewBecause):
    """The same for new numbers of a plan that stays."""

    RULE: ClassVar[str] = "_BINDS_ANEW _BECAUSE NAME [times]"
    EXAMPLE: ClassVar[str] = "binds anew because 'guest moved' exactly once"
    STATUS: ClassVar[str] = "rebound"
    VERB: ClassVar[str] = "binds anew"


@dataclass(frozen=True, slots=True)
class NoOtherPlanBecause(PlansAnewBecause):
    """The same for a search after which no other plan takes over."""

    RULE: ClassVar[str] = "_FINDS_NO_OTHER_PLAN _BECAUSE NAME [times]"
    EXAMPLE: ClassVar[str] = "finds no other plan because 'front is blocked by wall 1' exactly once"
    STATUS: ClassVar[str] = "not_replanned"
    VERB: ClassVar[str] = "finds no other plan"


def _holds(event: TraceEvent, words: str) -> bool:
    return any(holds(cause.words, words) for cause in event.because)
