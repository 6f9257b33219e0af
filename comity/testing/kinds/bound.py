"""Bounds on a number: a metric of the episode, or a parameter of a person."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, ClassVar, Self

from comity.testing import causes
from comity.testing.amount import Amount, apart, ordered, told, told_beside
from comity.testing.expectation import Finding
from comity.testing.quantity import quantities

if TYPE_CHECKING:
    from comity.testing.trial import Trial


@dataclass(frozen=True, slots=True)
class _Bound:
    """From one number to another, both ends included."""

    quantity: str
    person: str | None
    least: Amount | None
    most: Amount | None

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
            if (low is not None and found.number < low) or (high is not None and found.number > high):
                passed = low if low is not None and found.number < low else high or 0.0
                off = found.number - passed
                over = "too little" if off < 0 else "too much"
                yield Finding(
                    f"{found.name} {_range(low, high, found.unit)}",
                    f"{told_beside(found.number, passed, found.unit)}, {apart(off, found.unit)} {over}",
                    tuple(found.because()),
                )


def _without_number(trial: Trial, quantity: str, person: str) -> Finding:
    """About everybody a sentence may hold of nobody; who names somebody wants to know."""
    because = tuple(causes.of_visit(trial, person))
    return Finding(f"a number for {quantity} of {person}", "none: nothing happened to measure it by", because)


def _range(low: float | None, high: float | None, unit: str | None) -> str:
    if low is None:
        return f"at most {told(high or 0.0, unit)}"
    if high is None:
        return f"at least {told(low, unit)}"
    if low == high:
        return f"exactly {told(low, unit)}"
    return f"from {told(low, unit)} to {told(high, unit)}"


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
        within = within or Amount(0.0, middle.unit)
        off = replace(within, unit=within.unit or middle.unit).size(middle.unit)
        low, high = middle.number - off, middle.number + off
        return cls(quantity, person, replace(middle, number=low), replace(middle, number=high))
