"""Antecedents in the form in which they are evaluated, for one person or for a column of them.

`not` is moved inwards by De Morgan's laws once, so that what remains are literals under `and` and `or`; an
undisclosed value then needs no special case: each of its literals, negated or not, has degree 1.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import partial
from operator import itemgetter
from typing import Any, Generic, NamedTuple, Protocol, TypeVar

from comity_fis.rules.hedge import HEDGES
from comity_fis.rules.methods import DUAL, MAMDANI, Methods, combined
from comity_fis.rules.rule import And, Condition, Hedged, Is, Not

Degree = TypeVar("Degree")
"""A degree in [0, 1], or an array of them."""

Value = TypeVar("Value")
"""What a literal is about: a number or a category."""


class Literal(NamedTuple):
    """`name is term`, possibly hedged, possibly negated."""

    name: str
    term: str
    exponent: float = 1.0
    negated: bool = False


TIE = 1e-12
"""Degrees that differ by less are equal: either may decide when they change."""


@dataclass(frozen=True, slots=True)
class Modified(Generic[Value]):
    """A term's membership function as a literal wants it."""

    term: Callable[[Value], float]
    exponent: float
    negated: bool

    def __call__(self, value: Value) -> float:
        """The degree of a value: hedged by the exponent, perhaps negated."""
        hedged: float = self.term(value) ** self.exponent
        return 1.0 - hedged if self.negated else hedged


class Logic(NamedTuple, Generic[Degree]):
    """What `and` and `or` do to degrees, and `not` before them to the degrees of the opposites."""

    all_of: Callable[[Sequence[Degree]], Degree]
    any_of: Callable[[Sequence[Degree]], Degree]
    not_all_of: Callable[[Sequence[Degree]], Degree]
    not_any_of: Callable[[Sequence[Degree]], Degree]


MIN_MAX: Logic[float] = Logic(min, max, not_all_of=max, not_any_of=min)
"""For one person."""


def logic_of(methods: Methods) -> Logic[float]:
    """What a rulebook's methods make of `and` and `or`, for one person."""
    if (methods.conjunction, methods.disjunction) == (MAMDANI.conjunction, MAMDANI.disjunction):
        return MIN_MAX
    return Logic(
        partial(combined, methods.conjunction),
        partial(combined, methods.disjunction),
        not_all_of=partial(combined, DUAL[methods.conjunction]),
        not_any_of=partial(combined, DUAL[methods.disjunction]),
    )


class Antecedent(Protocol):
    """A condition over numbered literals."""

    @property
    def necessary(self) -> tuple[int, ...]:
        """Literals without which it cannot hold, by number; there may be more."""
        ...

    def strength(self, degrees: Sequence[Degree], logic: Logic[Degree]) -> Degree:
        """The degree to which it holds, from the degrees of all literals."""
        ...

    def decisive(self, degrees: Sequence[float]) -> Antecedent:
        """The part of it that alone decides its strength by min and max when the degrees change a little."""
        ...

    def rate(self, rates: Mapping[int, float]) -> float:
        """How fast the strength of what is decisive changes, with the rates of the literals that change."""
        ...


@dataclass(frozen=True, slots=True)
class Single:
    """One literal."""

    index: int

    @property
    def necessary(self) -> tuple[int, ...]:
        """The literal."""
        return (self.index,)

    def strength(self, degrees: Sequence[Degree], logic: Logic[Degree]) -> Degree:
        """The literal's degree."""
        return degrees[self.index]

    def decisive(self, degrees: Sequence[float]) -> Antecedent:
        """The literal."""
        return self

    def rate(self, rates: Mapping[int, float]) -> float:
        """The literal's."""
        return rates.get(self.index, 0.0)


@dataclass(frozen=True, slots=True)
class Conjunction:
    """Two or more literals that all hold: the form of most rules."""

    necessary: tuple[int, ...]
    pick: itemgetter[Any] = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "pick", itemgetter(*self.necessary))

    def strength(self, degrees: Sequence[Degree], logic: Logic[Degree]) -> Degree:
        """What `and` makes of the literals' degrees."""
        return logic.all_of(self.pick(degrees))

    def decisive(self, degrees: Sequence[float]) -> Antecedent:
        """The literals that hold least."""
        least = min(self.pick(degrees)) + TIE
        literals = tuple([index for index in self.necessary if degrees[index] <= least])
        return Single(literals[0]) if len(literals) == 1 else Conjunction(literals)

    def rate(self, rates: Mapping[int, float]) -> float:
        """That of the slowest literal."""
        return min([rates.get(index, 0.0) for index in self.necessary])


@dataclass(frozen=True, slots=True)
class Nested:
    """Parts that all hold, or of which one holds."""

    parts: tuple[Antecedent, ...]
    conjunctive: bool
    """As it was written, whether or not it is negated."""
    negated: bool
    """Whether `not` stood before it: the parts are the opposites already."""

    @property
    def necessary(self) -> tuple[int, ...]:
        """Those of all parts, where all must hold."""
        return tuple([i for part in self.parts for i in part.necessary]) if self._all_hold else ()

    def strength(self, degrees: Sequence[Degree], logic: Logic[Degree]) -> Degree:
        """What `and` or `or` makes of the parts' strengths."""
        strengths = [part.strength(degrees, logic) for part in self.parts]
        if self.negated:
            return logic.not_all_of(strengths) if self.conjunctive else logic.not_any_of(strengths)
        return logic.all_of(strengths) if self.conjunctive else logic.any_of(strengths)

    def decisive(self, degrees: Sequence[float]) -> Antecedent:
        """The parts that hold least where all must, those that hold most where one must."""
        decides = min if self._all_hold else max
        strengths = [part.strength(degrees, MIN_MAX) for part in self.parts]
        edge = decides(strengths)
        tied = (part for part, h in zip(self.parts, strengths, strict=True) if abs(h - edge) <= TIE)
        parts = tuple(dict.fromkeys(part.decisive(degrees) for part in tied))
        return parts[0] if len(parts) == 1 else Nested(parts, self.conjunctive, self.negated)

    def rate(self, rates: Mapping[int, float]) -> float:
        """That of the slowest part where all must hold, of the fastest where one must."""
        return (min if self._all_hold else max)([part.rate(rates) for part in self.parts])

    @property
    def _all_hold(self) -> bool:
        return self.conjunctive is not self.negated


def compile_antecedent(
    condition: Condition, literals: dict[Literal, int], *, negated: bool = False
) -> Antecedent:
    """The condition, or its opposite, over numbered literals.

    Args:
        condition: What a rule or a guard says.
        literals: Known ones with their numbers; new ones are added.
        negated: Whether the opposite is meant.
    """
    if isinstance(condition, Is | Hedged):
        return Single(literals.setdefault(literal_of(condition, negated), len(literals)))
    if isinstance(condition, Not):
        return compile_antecedent(condition.part, literals, negated=not negated)
    parts = tuple(compile_antecedent(part, literals, negated=negated) for part in condition.parts)
    conjunctive = isinstance(condition, And)
    indices = tuple(part.index for part in parts if isinstance(part, Single))
    if conjunctive and not negated and len(indices) == len(parts) > 1:
        return Conjunction(indices)
    return Nested(parts, conjunctive, negated)


def literal_of(condition: Is | Hedged, negated: bool) -> Literal:
    """The literal that a condition, or its opposite, consists of."""
    if isinstance(condition, Is):
        return Literal(condition.name, condition.term, 1.0, negated)
    return Literal(condition.part.name, condition.part.term, HEDGES[condition.hedge], negated)
