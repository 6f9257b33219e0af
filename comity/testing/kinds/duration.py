"""How long the whole episode takes."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar, Self

from comity.testing.expectation import Finding
from comity.testing.metrics.amount import Amount
from comity.testing.metrics.course import of_time
from comity.testing.metrics.shaping import shaping

if TYPE_CHECKING:
    from comity.testing.trials.trial import Trial


@dataclass(frozen=True, slots=True)
class Duration:
    """In simulated seconds, from the start to the last node's end."""

    RULE: ClassVar[str] = "_FINISHES _WITHIN amount"
    EXAMPLE: ClassVar[str] = "finishes within 60 s"

    within_s: float

    @classmethod
    def read(cls, parts: Sequence[Any]) -> Self:
        """From an amount."""
        (within,) = parts
        assert isinstance(within, Amount)
        return cls(within.size("s"))

    @property
    def people(self) -> Sequence[str]:
        """Nobody."""
        return ()

    def judge(self, trial: Trial) -> Iterator[Finding]:
        """An end that is too late, with what took long, what failed and what shaped it."""
        end_s = trial.episode.history.end_s
        if end_s > self.within_s:
            got, because = f"an end at t={end_s:.2f} s", (*of_time(trial), *shaping(trial))
            yield Finding(f"an end within {self.within_s:g} s", got, because)
