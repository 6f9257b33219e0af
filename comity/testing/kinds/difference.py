"""By how much two profiles differ in a parameter."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar, Self

from comity.testing import causes
from comity.testing.amount import Amount, apart, told
from comity.testing.expectation import Finding
from comity.testing.quantity import require_parameter
from comity_fis import InputError

if TYPE_CHECKING:
    from comity.testing.among import Among


@dataclass(frozen=True, slots=True)
class Difference:
    """What is inferred for the person of the matrix with the one profile, and with the other."""

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
        """From two profiles, a parameter and an amount."""
        one, other, parameter, least = parts
        if one == other:
            raise InputError(expected="two profiles", got=f"{one!r} twice", remedy="Name another one.")
        return cls(one, other, parameter, least)

    @property
    def people(self) -> Sequence[str]:
        """Nobody."""
        return ()

    @property
    def profiles(self) -> Sequence[str]:
        """The two."""
        return (self.one, self.other)

    def compare(self, among: Among) -> Iterator[Finding]:
        """Too small a difference, with what each value comes from."""
        answers = [among.values(profile) for profile in self.profiles]
        require_parameter(self.parameter, answers[0])
        one, other = (values[self.parameter] for values in answers)
        if self.least is not None and isinstance(one.value, str):
            raise InputError(
                expected="a parameter that is a number, for a difference by so much",
                got=f"{self.parameter}, which is a word",
                remedy="Leave `by at least ...` out: words are the same or not.",
            )
        if self.least is None or isinstance(one.value, str) or isinstance(other.value, str):
            fine, expected = one.value != other.value, f"another {self.parameter}"
        else:
            least = self.least.size(one.unit)
            fine = abs(one.number - other.number) >= least
            expected = f"{self.parameter} at least {apart(least, one.unit)} apart"
        if not fine:
            pairs = zip((one, other), self.profiles, strict=True)
            got = ", ".join(f"{told(value.value, value.unit)} for {profile}" for value, profile in pairs)
            if not isinstance(one.value, str) and not isinstance(other.value, str):
                got += f": {apart(one.value - other.value, one.unit)} apart"
            because = (
                line
                for values, profile in zip(answers, self.profiles, strict=True)
                for line in causes.of_value(values, self.parameter, profile)
            )
            yield Finding(expected, got, tuple(because))
