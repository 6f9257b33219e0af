"""Scales: what may be computed with a variable's values, by their level of measurement.

Each level allows what the one below allows and more (Stevens 1946): equality; order; differences and means;
quotients, once zero means none. The types say it to a type checker; at run time a refusal names the remedy.
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
    """Takes a value of the variable, and refuses any other with an `InputError`."""
    level: Level
    """That the values have by nature."""
    coercion: Coercion | None = None
    """The declared step above it, where there is one."""

    def equal(self, a: V, b: V) -> bool:
        """Whether two values are the same."""
        return self.check(a) == self.check(b)

    def mode(self, values: Iterable[V]) -> V:
        """The most frequent value; of several the one that came first."""
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

    if not TYPE_CHECKING:  # a type checker refuses what a level has not; at run time this says why

        def __getattr__(self, operation: str) -> NoReturn:
            needed = NEEDS.get(operation)
            if needed is None:
                raise AttributeError(operation)
            raise too_low(self.variable, self.level, needed, operation)


@dataclass(frozen=True, slots=True, kw_only=True)
class OrdinalScale(NominalScale[V]):
    """Values have an order: levels of education."""

    rank: Callable[[V], float]
    """Larger for a later value; only the order of ranks means anything."""

    def before(self, a: V, b: V) -> bool:
        """Whether one value comes before another."""
        return self.rank(self.check(a)) < self.rank(self.check(b))

    def median(self, values: Iterable[V]) -> V:
        """The middle value; of two middle ones the lower, which is a value where their mean need not be."""
        ordered = sorted(self._all(values), key=self.rank)
        return ordered[(len(ordered) - 1) // 2]


@dataclass(frozen=True, slots=True, kw_only=True)
class IntervalScale(OrdinalScale[float]):
    """Differences mean something: latitude."""

    def distance(self, a: float, b: float) -> float:
        """How far apart two values are, in the variable's unit."""
        return abs(self.check(a) - self.check(b))

    def mean(self, values: Iterable[float]) -> float:
        """The arithmetic mean."""
        checked = self._all(values)
        return fsum(checked) / len(checked)

    def partition(self, values: Iterable[float], radius: float = 0.5) -> FittedPartition:
        """Clusters and the terms fitted to them: both rest on distances and means."""
        from comity_fis.variables.partitioning import partition

        return partition(self._all(values), radius)


@dataclass(frozen=True, slots=True, kw_only=True)
class RatioScale(IntervalScale):
    """Zero means none, so that quotients mean something: age."""

    def ratio(self, a: float, b: float) -> float:
        """How many times `b` goes into `a`.

        Raises:
            InputError: if `b` is 0: nothing goes into something.
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
"""The lowest level that allows an operation."""


class LevelError(InputError, AttributeError):
    """An operation that a level of measurement does not allow; to `hasattr` the scale has it not."""


def too_low(variable: str, level: Level, needed: Level, operation: str) -> LevelError:
    """The refusal of an operation that a level does not allow."""
    allowed = "Use what its own level allows"
    coercible = level >= Level.ORDINAL and needed >= Level.INTERVAL
    remedy = f"{allowed}, or declare a coercion to {needed} with a reason." if coercible else f"{allowed}."
    return LevelError(
        expected=f"{needed} level for the {operation} of {variable}", got=f"{level} level", remedy=remedy
    )
