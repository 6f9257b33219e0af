"""What decided a parameter: culture, the situation, what was learnt, a wish, safety, or nothing at all."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar, Self, get_args

from comity.testing.expectation import Finding
from comity.testing.metrics import causes
from comity.testing.metrics.quantity import require_parameter
from comity_fis import InputError, closest
from comity_fis.inference.value import Origin

if TYPE_CHECKING:
    from comity.testing.trials.trial import Trial


@dataclass(frozen=True, slots=True)
class DecidedBy:
    """`neutral` where nothing is known that a rule asks for."""

    RULE: ClassVar[str] = "NAME [_OF NAME] _IS _DECIDED_BY NAME"
    EXAMPLE: ClassVar[str] = "approach_speed of johanna is decided by culture"

    parameter: str
    person: str | None
    origin: str

    @classmethod
    def read(cls, parts: Sequence[Any]) -> Self:
        """From a parameter, a person and an origin."""
        parameter, person, origin = parts
        if origin not in get_args(Origin):
            raise InputError(
                expected="what may decide a parameter",
                got=repr(origin),
                remedy=closest(origin, get_args(Origin)),
            )
        return cls(parameter, person, origin)

    @property
    def people(self) -> Sequence[str]:
        """The one whom it names."""
        return (self.person,) if self.person else ()

    def judge(self, trial: Trial) -> Iterator[Finding]:
        """Everybody for whom something else decided."""
        for person in self.people or trial.wanted:
            values = trial.values(person, self.parameter)
            require_parameter(self.parameter, values)
            origin = values[self.parameter].origin
            if origin != self.origin:
                expected = f"{self.parameter} of {person} decided by {self.origin}"
                yield Finding(expected, origin, tuple(causes.of_parameter(trial, self.parameter, person)))
