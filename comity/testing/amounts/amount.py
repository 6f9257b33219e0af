"""Numbers with units and counts of occurrences, with their wording in sentences."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import Literal, Self

from comity_fis import InputError
from comity_fis.listing import listed
from comity_fis.variables.unit import factor

_DIGITS = {"m": 3, "s": 2, "deg": 1}
_SHOWN = {"m": ("cm", 100.0), "deg": ("deg", 1.0), "s": ("s", 1.0), "m/s": ("m/s", 1.0)}
_MORE_DIGITS = 12
"""Maximum number of digits beyond the usual ones; any further digits are noise."""

BEYOND = 1e9
"""No number of an episode is farther from 0 than this, in any unit; a bound beyond it would be
meaningless."""

ROUNDING = 1e-9
"""Tolerance for floating-point errors, in any unit: a user who writes 82.5 cm means the 0.825 m that the
computation misses by less than this."""

MOST_TIMES = 1_000_000
"""Maximum count: no event happens more often in an episode."""


@dataclass(frozen=True, slots=True)
class Amount:
    """A number with its unit, as written in a sentence."""

    number: float
    unit: str | None

    def __post_init__(self) -> None:
        if not abs(self.number) <= BEYOND:
            raise InputError(expected="a number", got="one beyond all measure", remedy="Write a smaller one.")

    def to(self, unit: str | None) -> float:
        """Convert to another unit of the same quantity; an amount without a unit is a plain number.

        Raises:
            InputError: if they measure different things.
        """
        wanted = unit or "1"
        if wanted == "1" and self.unit is None:
            return self.number
        if wanted == "1":
            raise InputError(
                expected="a plain number", got=f"a number of {self.unit}", remedy="Leave the unit out."
            )
        return self.number * factor(self.unit or "", wanted)

    def size(self, unit: str | None) -> float:
        """Convert a non-negative amount: a time, a distance, a difference or a tolerance.

        Raises:
            InputError: if it is negative, or they measure different things.
        """
        if self.number < 0:
            raise InputError(
                expected="0 or more", got=str(self), remedy="Leave the minus out, or write another sentence."
            )
        return self.to(unit)

    def __str__(self) -> str:
        return f"{self.number:g} {self.unit or ''}".strip()


@dataclass(frozen=True, slots=True)
class Bounds:
    """A closed interval between two amounts; None where an end is open."""

    least: Amount | None
    most: Amount | None

    @classmethod
    def between(cls, least: Amount, most: Amount) -> Self:
        """Bounds from two ends; an end without a unit takes the other's.

        Raises:
            InputError: if they measure different things, or the first exceeds the second.
        """
        least = replace(least, unit=least.unit or most.unit)
        most = replace(most, unit=most.unit or least.unit)
        if least.to(most.unit) > most.number:
            raise InputError(
                expected="the smaller number first",
                got=f"{least} and {most}",
                remedy=f"Write `between {most} and {least}`.",
            )
        return cls(least, most)

    @classmethod
    def around(cls, middle: Amount, within: Amount | None) -> Self:
        """Bounds around a middle; a tolerance without a unit takes the middle's. Exact without a tolerance.

        Raises:
            InputError: if they measure different things, or the tolerance is negative.
        """
        within = within or Amount(0.0, middle.unit)
        off = replace(within, unit=within.unit or middle.unit).size(middle.unit)
        return cls(replace(middle, number=middle.number - off), replace(middle, number=middle.number + off))

    def ends(self, unit: str | None) -> tuple[float | None, float | None]:
        """Both ends, converted to a unit.

        Raises:
            InputError: if they measure something else.
        """
        low = None if self.least is None else self.least.to(unit)
        return low, None if self.most is None else self.most.to(unit)

    def holds(self, value: float, unit: str | None, *, slack: float = ROUNDING) -> bool:
        """Whether a value is inside the bounds, within the slack."""
        return passed_end(value, *self.ends(unit), slack=slack) is None

    def require_possible(
        self, what: str, lowest: float | None, highest: float | None, unit: str | None
    ) -> None:
        """Refuse bounds outside the range of possible values.

        Raises:
            InputError: if no value can satisfy them, or they measure something else.
        """
        low, high = self.ends(unit)
        if high is not None and lowest is not None and high < lowest:
            raise InputError(
                expected=f"{Amount(lowest, unit)} or more: {what} is never less",
                got=str(self.most),
                remedy="Leave the minus out, or write another sentence.",
            )
        if low is not None and highest is not None and low > highest:
            raise InputError(
                expected=f"{Amount(highest, unit)} or less: {what} is never more",
                got=str(self.least),
                remedy="Write a smaller number, or another sentence.",
            )

    def require_breakable(
        self, what: str, lowest: float | None, highest: float | None, unit: str | None
    ) -> None:
        """Refuse bounds that every possible value satisfies.

        Raises:
            InputError: if no value can violate them, or they measure something else.
        """
        low, high = self.ends(unit)
        keeps_low = low is None or (lowest is not None and low <= lowest)
        keeps_high = high is None or (highest is not None and high >= highest)
        if keeps_low and keeps_high:
            known = [
                f"never {word} than {Amount(end, unit)}"
                for word, end in (("less", lowest), ("more", highest))
                if end is not None
            ]
            ends = (("least", self.least), ("most", self.most))
            raise InputError(
                expected=f"a bound that a run may break: {what} is {listed(known)}",
                got=listed(f"at {word} {end}" for word, end in ends if end),
                remedy="Write another number, or leave the sentence out.",
            )

    def told(self, unit: str | None, *beside: float) -> str:
        """The bounds in words, with enough digits to distinguish the ends from the given values."""
        return told_range(*self.ends(unit), unit, *beside)

    def missed_by(self, value: float, unit: str | None, note: str = "") -> str:
        """A value outside the bounds in words, with a note, and by how much it is too small or too large."""
        low, high = self.ends(unit)
        end = passed_end(value, low, high)
        beyond = "" if end is None else f", {told_beyond(value, end, unit)}"
        return f"{told_beside(value, low, high, unit)}{note}{beyond}"


@dataclass(frozen=True, slots=True)
class Times:
    """Bounds on how often something happens."""

    limit: Literal["at_least", "at_most", "exactly"]
    count: int

    @classmethod
    def written(cls, limit: Literal["at_least", "at_most", "exactly"], word: str) -> Self:
        """Parse `once`, `twice` or a number.

        Raises:
            InputError: if no count, or every count, satisfies the limit.
        """
        number = {"once": 1.0, "twice": 2.0}.get(word.lower()) or float(word)
        if not (0 <= number <= MOST_TIMES and number.is_integer()):
            got = word if len(word) < 20 else f"{word[:20]}..."
            raise InputError(
                expected=f"a whole number of times, 0 to {MOST_TIMES}", got=got, remedy="Write `3 times`."
            )
        if limit == "at_least" and not number:
            raise InputError(
                expected="a number of times that a run may fall short of, 1 or more",
                got="at least 0, which every run keeps",
                remedy="Write `at most`, `exactly` or `never`, or leave the sentence out.",
            )
        return cls(limit, int(number))

    def holds(self, count: int) -> bool:
        """Whether a count satisfies the limit."""
        if self.limit == "at_least":
            return count >= self.count
        return count <= self.count if self.limit == "at_most" else count == self.count

    def exceeded_by(self, count: int) -> bool:
        """Whether a count is too high."""
        return self.limit != "at_least" and count > self.count

    def __str__(self) -> str:
        if not self.count:
            return "never"  # "at most" and "exactly" mean the same for 0
        return f"{self.limit.replace('_', ' ')} {times(self.count)}"


AT_LEAST_ONCE = Times("at_least", 1)
NEVER = Times("exactly", 0)


def times(count: int) -> str:
    """`once`, `twice`, `3 times`."""
    return {0: "never", 1: "once", 2: "twice"}.get(count, f"{count} times")


def told(value: float | str, unit: str | None, more: int = 0) -> str:
    """A value with its unit, as in findings: metres to the millimetre, or with `more` digits."""
    if isinstance(value, str):
        return value
    if unit in (None, "1"):
        return f"{value:.{6 + more}g}"
    digits = _DIGITS.get(unit or "", 3) + more
    return f"{round(value, digits) + 0.0:.{digits}f} {unit}"


def told_apart(values: Sequence[float], unit: str | None) -> tuple[str, ...]:
    """Values in words, with the fewest digits (at least the usual ones) that show which of them differ."""
    return _distinct(values, (partial(told, unit=unit, more=more) for more in range(_MORE_DIGITS)))


def told_beside(value: float, low: float | None, high: float | None, unit: str | None) -> str:
    """A value in words, with enough digits to distinguish it from both ends of a range."""
    return told_apart((value, *_ends(low, high)), unit)[0]


def told_range(low: float | None, high: float | None, unit: str | None, *beside: float) -> str:
    """A range in words; either end may be open.

    Args:
        low: Lower end; None if open.
        high: Upper end; None if open.
        unit: Unit of both ends.
        beside: Values stated next to the range, which get enough digits to differ from its ends.
    """
    ends = _ends(low, high)
    first, *rest = told_apart((*ends, *beside), unit)[: len(ends)]
    if high is None:
        return f"at least {first}"
    if low is None:
        return f"at most {first}"
    return f"exactly {first}" if low == high else f"from {first} to {rest[0]}"


def _ends(low: float | None, high: float | None) -> tuple[float, ...]:
    return tuple(end for end in (low, high) if end is not None)


def _distinct(values: Sequence[float], ways: Iterable[Callable[[float], str]]) -> tuple[str, ...]:
    """The values in the first format in which different values look different; else in the last format."""
    shown: tuple[str, ...] = ()
    for way in ways:
        shown = tuple(way(value) for value in values)
        if len(set(shown)) == len(set(values)):
            break
    return shown


def passed_end(
    value: float, low: float | None, high: float | None, *, slack: float = ROUNDING
) -> float | None:
    """The end of a range that a value exceeds by more than the slack; None if it is inside."""
    if low is not None and value < low - slack:
        return low
    return high if high is not None and value > high + slack else None


def told_beyond(value: float, end: float, unit: str | None) -> str:
    """How far a value is beyond the end of a range, in words."""
    return f"{apart(value - end, unit)} {'too little' if value < end else 'too much'}"


def apart(difference: float, unit: str | None, more: int = 0) -> str:
    """The difference of two values in words; metres as centimetres."""
    bare = "" if unit in (None, "1") else unit
    shown, scale = _SHOWN.get(bare, (bare, 1.0))
    size = abs(difference) * scale
    number = f"{size:.{more}f}" if size >= 100 else f"{size:.{3 + more}g}"
    return f"{number} {shown}".strip()


def differences_apart(differences: Sequence[float], unit: str | None) -> tuple[str, ...]:
    """Several differences in words, with enough digits to show which of their sizes differ."""
    sizes = [abs(difference) for difference in differences]
    return _distinct(sizes, (partial(apart, unit=unit, more=more) for more in range(_MORE_DIGITS)))
