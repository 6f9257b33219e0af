"""Scales: the operations that a variable's level of measurement allows on its values.

Each level adds to the one below (Stevens 1946): equality; order; differences and means; ratios, if zero means
none. Type checkers see this in the types; at run time the error names the remedy.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from math import fsum
from typing import TYPE_CHECKING, Generic, NoReturn, TypeVar

from comity_fis.errors import InputError
from comity_fis.variables.measurement import Coercion, Level

if TYPE_CHECKING:
    from comity_fis.variables.partitioning import FittedPartition

V = TypeVar("V", str, float)


@dataclass(frozen=True, slots=True, kw_only=True)
class NominalScale(Generic[V]):
    """Values are equal or not: gender, nationality."""

    variable: str
    check: Callable[[object], V]
    """Validates a value of the variable; raises `InputError` for any other."""
    level: Level
    """Level of the values themselves."""
    coercion: Coercion | None = None
    """Declared treatment at a higher level, or None."""

    def equal(self, a: V, b: V) -> bool:
        """Whether two values are the same."""
        return self.check(a) == self.check(b)

    def mode(self, values: Iterable[V]) -> V:
        """The most frequent value; the first one if there are several."""
        return Counter(self._all(values)).most_common(1)[0][0]

    def _all(self, values: Iterable[V]) -> list[V]:
        checked = [self.check(value) for value in values]
        if not checked:
            raise InputError(
                expected=f"at least one value of {self.variable}",
                got="none",
                remedy="Leave the question open where nothing is known.",
            )
        return checked

    if not TYPE_CHECKING:  # type checkers see which operations exist; at run time the error explains

        def __getattr__(self, operation: str) -> NoReturn:
            needed = NEEDS.get(operation)
            if needed is None:
                raise AttributeError(operation)
            raise too_low(self.variable, self.level, needed, operation)


@dataclass(frozen=True, slots=True, kw_only=True)
class OrdinalScale(NominalScale[V]):
    """Values are ordered: levels of education."""

    rank: Callable[[V], float]
    """Rank, larger for later values; only the order of ranks is meaningful."""

    def before(self, a: V, b: V) -> bool:
        """Whether one value comes before another."""
        return self.rank(self.check(a)) < self.rank(self.check(b))

    def median(self, values: Iterable[V]) -> V:
        """The median; of two middle values the lower, as their mean need not be a value."""
        ordered = sorted(self._all(values), key=self.rank)
        return ordered[(len(ordered) - 1) // 2]


@dataclass(frozen=True, slots=True, kw_only=True)
class IntervalScale(OrdinalScale[float]):
    """Differences are meaningful: latitude."""

    def distance(self, a: float, b: float) -> float:
        """Difference of two values, in the variable's unit."""
        return abs(self.check(a) - self.check(b))

    def mean(self, values: Iterable[float]) -> float:
        """The arithmetic mean."""
        checked = self._all(values)
        return fsum(checked) / len(checked)

    def partition(self, values: Iterable[float], radius: float = 0.5) -> FittedPartition:
        """Clusters and the terms fitted to them, based on distances and means."""
        from comity_fis.variables.partitioning import partition

        return partition(self._all(values), radius)


@dataclass(frozen=True, slots=True, kw_only=True)
class RatioScale(IntervalScale):
    """Zero means none, so that ratios are meaningful: age."""

    def ratio(self, a: float, b: float) -> float:
        """The ratio `a / b`.

        Raises:
            InputError: `b` is 0.
        """
        dividend, divisor = self.check(a), self.check(b)
        if divisor == 0:
            raise InputError(
                expected=f"a value of {self.variable} other than 0 to divide by",
                got="0",
                remedy="Compare by difference instead.",
            )
        return dividend / divisor


NEEDS = {
    "before": Level.ORDINAL,
    "median": Level.ORDINAL,
    "distance": Level.INTERVAL,
    "mean": Level.INTERVAL,
    "partition": Level.INTERVAL,
    "ratio": Level.RATIO,
}
"""Minimum level for each operation."""


class LevelError(InputError, AttributeError):
    """An operation that a level of measurement does not allow; for `hasattr` it does not exist."""


def too_low(variable: str, level: Level, needed: Level, operation: str) -> LevelError:
    """The error for an operation that a level does not allow."""
    allowed = "Use what its own level allows"
    coercible = level >= Level.ORDINAL and needed >= Level.INTERVAL
    remedy = f"{allowed}, or declare a coercion to {needed} with a reason." if coercible else f"{allowed}."
    return LevelError(
        expected=f"{needed} level for the {operation} of {variable}", got=f"{level} level", remedy=remedy
    )
