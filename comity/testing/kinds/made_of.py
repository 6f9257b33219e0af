"""What a parameter is made of: rules and their strengths, the situation, what was learnt or asked for."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar, Self

from comity.report.values.inference import because
from comity.testing.expectation import Finding
from comity.testing.metrics import causes
from comity.testing.metrics.quantity import require_parameter
from comity.testing.metrics.words import holds

if TYPE_CHECKING:
    from comity.testing.trials.trial import Trial


@dataclass(frozen=True, slots=True)
class MadeOf:
    """In the words in which `comity infer --why` tells it."""

    RULE: ClassVar[str] = "NAME [_OF NAME] _IS _MADE_OF NAME"
    EXAMPLE: ClassVar[str] = "conversational_distance of anna is made of 'gender is female → close'"

    parameter: str
    person: str | None
    words: str

    @classmethod
    def read(cls, parts: Sequence[Any]) -> Self:
        """From a parameter, a person and words."""
        return cls(*parts)

    @property
    def people(self) -> Sequence[str]:
        """The one whom it names."""
        return (self.person,) if self.person else ()

    def judge(self, trial: Trial) -> Iterator[Finding]:
        """Everybody for whom the account has no such words."""
        for person in self.people or trial.wanted:
            values = trial.values(person, self.parameter)
            require_parameter(self.parameter, values)
            told = because(values[self.parameter], values.inputs)
            if not holds(told, self.words):
                expected = f"{self.parameter} of {person} made of “{self.words}”"
                yield Finding(
                    expected, told.splitlines()[0], tuple(causes.of_parameter(trial, self.parameter, person))
                )
