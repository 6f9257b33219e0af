"""Bounds on a number: a metric of the episode, or a parameter of a person."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar, Self

from comity.testing.expectation import Finding
from comity.testing.metrics import causes
from comity.testing.metrics.amount import (
    Amount,
    around,
    ordered,
    passed_end,
    told_beside,
    told_beyond,
    told_range,
)
from comity.testing.metrics.quantity import quantities, require_breakable, require_possible

if TYPE_CHECKING:
    from comity.testing.trials.trial import Trial


@dataclass(frozen=True, slots=True)
class _Bound:
    """From one number to another, both ends included."""

    quantity: str
    person: str | None
    least: Amount | None
    most: Amount | None

    def __post_init__(self) -> None:
        require_possible(self.quantity, self.least, self.most)
        if self.person is None:  # of somebody, a number may be missing
            require_breakable(self.quantity, self.least, self.most)

    @property
    def people(self) -> Sequence[str]:
        """The one whom it names."""
        return (self.person,) if self.person else ()

    def judge(self, trial: Trial) -> Iterator[Finding]:
        """Every number outside."""
        every = list(quantities(trial, self.quantity, self.person))
        if self.person and not every:
            yield _without_number(trial, self.quantity, self.person)
        for found in every:
            low = None if self.least is None else self.least.to(found.unit)
            high = None if self.most is None else self.most.to(found.unit)
            if (end := passed_end(found.number, low, high)) is not None:
                beyond = told_beyond(found.number, end, found.unit)
                here = f" {found.at}" if found.at else ""
                yield Finding(
                    f"{found.name} {told_range(low, high, found.unit, found.number)}",
                    f"{told_beside(found.number, low, high, found.unit)}{here}, {beyond}",
                    tuple(found.because()),
                )


def _without_number(trial: Trial, quantity: str, person: str) -> Finding:
    """About everybody a sentence may hold of nobody; who names somebody wants to know."""
    because = tuple(causes.of_visit(trial, person))
    return Finding(f"a number for {quantity} of {person}", "none: nothing happened to measure it by", because)


@dataclass(frozen=True, slots=True)
class Lower(_Bound):
    """At least so much."""

    RULE: ClassVar[str] = "NAME [_OF NAME] _AT_LEAST amount"
    EXAMPLE: ClassVar[str] = "min_clearance at least 45 cm"

    @classmethod
    def read(cls, parts: Sequence[Any]) -> Self:
        """From a quantity, a person and an amount."""
        quantity, person, least = parts
        return cls(quantity, person, least, None)


@dataclass(frozen=True, slots=True)
class Upper(_Bound):
    """At most so much."""

    RULE: ClassVar[str] = "NAME [_OF NAME] _AT_MOST amount"
    EXAMPLE: ClassVar[str] = "path_length at most 12 m"

    @classmethod
    def read(cls, parts: Sequence[Any]) -> Self:
        """From a quantity, a person and an amount."""
        quantity, person, most = parts
        return cls(quantity, person, None, most)


@dataclass(frozen=True, slots=True)
class Between(_Bound):
    """Between two numbers."""

    RULE: ClassVar[str] = "NAME [_OF NAME] _IS? _BETWEEN amount _AND amount"
    EXAMPLE: ClassVar[str] = "conversational_distance of johanna between 60 and 70 cm"

    @classmethod
    def read(cls, parts: Sequence[Any]) -> Self:
        """From a quantity, a person and two amounts; one may leave its unit to the other."""
        quantity, person, least, most = parts
        return cls(quantity, person, *ordered(least, most))


@dataclass(frozen=True, slots=True)
class Close(_Bound):
    """A number, within so much."""

    RULE: ClassVar[str] = "NAME [_OF NAME] _IS amount [_WITHIN amount]"
    EXAMPLE: ClassVar[str] = "conversational_distance of johanna is 64 cm within 1 cm"

    @classmethod
    def read(cls, parts: Sequence[Any]) -> Self:
        """From a quantity, a person, an amount and how far off it may be."""
        quantity, person, middle, within = parts
        return cls(quantity, person, *around(middle, within))
