"""Difference between two profiles in a parameter."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar, Self

from comity.testing.amounts import causes
from comity.testing.amounts.amount import ROUNDING, Amount, differences_apart, told_apart
from comity.testing.amounts.quantity import require_parameter
from comity.testing.expectation import Finding, ProfileComparison
from comity_fis import InputError

if TYPE_CHECKING:
    from comity.testing.measuring.compared_profiles import ComparedProfiles


@dataclass(frozen=True, slots=True)
class ProfileDifference(ProfileComparison):
    """The difference between the values inferred for the matrix's person with either profile."""

    RULE: ClassVar[str] = "_DIFFERS _BETWEEN NAME _AND NAME NAME [_BY _AT_LEAST amount]"
    EXAMPLE: ClassVar[str] = (
        "differs between german_man and arab_woman: conversational_distance, by at least 20 cm"
    )

    one: str
    other: str
    parameter: str
    least: Amount | None

    @classmethod
    def read(cls, parts: Sequence[Any]) -> Self:
        """Create from two profiles, a parameter and an amount."""
        one, other, parameter, least = parts
        if one == other:
            raise InputError(expected="two profiles", got=f"{one!r} twice", remedy="Name another one.")
        return cls(one, other, parameter, least)

    @property
    def profiles(self) -> Sequence[str]:
        """The two compared profiles."""
        return (self.one, self.other)

    def compare(self, compared: ComparedProfiles) -> Iterator[Finding]:
        """A difference that is too small, with the origin of each value."""
        answers = [compared.values(profile) for profile in self.profiles]
        require_parameter(self.parameter, answers[0])
        one, other = (values[self.parameter] for values in answers)
        if self.least is not None and isinstance(one.value, str):
            raise InputError(
                expected="a parameter that is a number, for a difference by so much",
                got=f"{self.parameter}, which is a word",
                remedy="Leave `by at least ...` out: words are the same or not.",
            )
        least = None if self.least is None else self.least.size(one.unit)
        if isinstance(one.value, str) or isinstance(other.value, str):
            fine, expected = one.value != other.value, f"another {self.parameter}"
            got = ", ".join(
                f"{value.value} for {profile}"
                for value, profile in zip((one, other), self.profiles, strict=True)
            )
        else:
            off = one.number - other.number
            fine = abs(off) > ROUNDING if least is None else abs(off) >= least - ROUNDING
            wanted, apart = differences_apart((off if least is None else least, off), one.unit)
            shown = told_apart((one.number, other.number), one.unit)
            expected = (
                f"another {self.parameter}" if least is None else f"{self.parameter} at least {wanted} apart"
            )
            got = ", ".join(
                f"{number} for {profile}" for number, profile in zip(shown, self.profiles, strict=True)
            )
            got += f": {apart} apart"
        if not fine:
            because = (
                line
                for values, profile in zip(answers, self.profiles, strict=True)
                for line in causes.of_value(values, self.parameter, profile)
            )
            yield Finding(expected, got, tuple(because))
