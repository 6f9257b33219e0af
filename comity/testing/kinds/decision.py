"""What decided a parameter: its origin, and the words of its contributions."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar, Self, get_args

from comity.report.values.inference import because
from comity.testing.amounts import causes
from comity.testing.amounts.quantity import require_parameter
from comity.testing.amounts.words import holds
from comity.testing.expectation import Expectation, Finding
from comity.testing.trials.visits import to_visit, values_when_judged
from comity_fis import InputError, unknown_word
from comity_fis.inference.value import Origin

if TYPE_CHECKING:
    from comity.episode import Episode


@dataclass(frozen=True, slots=True)
class DecidedBy(Expectation):
    """The origin of a parameter: culture, situation, learning, setting, safety; `neutral` without any."""

    RULE: ClassVar[str] = "NAME [_OF NAME] _IS _DECIDED [_BY NAME] [_BECAUSE NAME]"
    EXAMPLE: ClassVar[str] = (
        "conversational_distance of anna is decided by culture because 'gender is female → close'"
    )

    parameter: str
    person: str | None
    """None for every person to visit."""
    origin: str | None
    """Required origin; None for any."""
    words: str | None
    """Words in the contributions, as shown by `comity infer`; None for any."""

    @classmethod
    def read(cls, parts: Sequence[Any]) -> Self:
        """Create from a parameter, a person, an origin and words."""
        parameter, person, origin, words = parts
        if origin is not None and origin not in get_args(Origin):
            raise unknown_word("what may decide a parameter", origin, get_args(Origin))
        if origin is None and words is None:
            raise InputError(
                expected="`by` and an origin, or `because` and words of a contribution",
                got="neither",
                remedy=f"Write it like `{cls.EXAMPLE}`.",
            )
        return cls(parameter, person, origin, words)

    def judge(self, episode: Episode) -> Iterator[Finding]:
        """Each person with another origin, or without a contribution that has the words."""
        for person in self.people or to_visit(episode):
            values = values_when_judged(episode, person, self.parameter)
            require_parameter(self.parameter, values)
            value = values[self.parameter]
            contributions = because(value, values.inputs)
            if self.origin in (None, value.origin) and holds(contributions, self.words or ""):
                continue
            by = f" by {self.origin}" if self.origin else ""
            words = f" because of “{self.words}”" if self.words else ""
            yield Finding(
                f"{self.parameter} of {person} decided{by}{words}",
                f"{value.origin}: {contributions.splitlines()[0]}" if self.words else value.origin,
                tuple(causes.of_parameter(episode, self.parameter, person)),
            )
