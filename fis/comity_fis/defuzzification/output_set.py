"""The set that the rules give together, under any implication and aggregation.

`mamdani.AggregatedSet` is the special case of min and max, which has a faster centre of area.
"""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from itertools import accumulate, combinations, pairwise
from math import prod
from operator import add, mul
from typing import NamedTuple

from comity_fis.defuzzification import defuzzification
from comity_fis.defuzzification.curve import Point
from comity_fis.defuzzification.outline import sampled
from comity_fis.membership.curved import Complement
from comity_fis.membership.function import NumericMembership, Trapezoid
from comity_fis.membership.interval import Interval
from comity_fis.membership.peak import highest
from comity_fis.rules.methods import Methods, combined

SCAN = 8
"""Parts of the way between two knots of a curve, searched for the place where a rule cuts it off."""


class Concluded(NamedTuple):
    """An output term, and the strength in (0, 1] of one rule that concludes it."""

    term: NumericMembership
    strength: float


@dataclass(frozen=True, slots=True)
class Stack:
    """One output term as all rules that conclude it shape it together."""

    term: NumericMembership
    strengths: tuple[float, ...]
    """Of the rules, ascending; the largest only where no other counts."""
    methods: Methods
    _weakest: tuple[float, ...] = field(init=False, repr=False, compare=False)
    """Of the first n strengths, their sum, or under probor the product of what they leave of 1."""

    def __post_init__(self) -> None:
        sums = self.methods.aggregation == "sum"
        left = self.strengths if sums else (1.0 - strength for strength in self.strengths)
        weakest = accumulate(left, add if sums else mul, initial=0.0 if sums else 1.0)
        object.__setattr__(self, "_weakest", tuple(weakest))

    def __call__(self, x: float) -> float:
        """The degree at one place; under `sum` it may pass 1."""
        return self._united(self.term(x))

    def height(self, low: float, high: float) -> float:
        """The largest degree in [low, high]: it grows with the term's."""
        return self._united(self.term.height(low, high))

    def cuts(self, low: float, high: float) -> Iterator[float]:
        """Where rules cut the term off between two places."""
        if self.methods.implication == "min":
            parts = 1 if self.is_straight else SCAN
            for left, right in pairwise(_ascending(self.term.knots, low, high)):
                between = (left + (right - left) * i / parts for i in range(1, parts))
                for ends in pairwise((left, *between, right)):
                    yield from _crossings(self.term, self.strengths, *ends)

    @property
    def is_straight(self) -> bool:
        """Whether it is straight between knots and cuts."""
        return isinstance(self.term.part if isinstance(self.term, Complement) else self.term, Trapezoid)

    def _united(self, degree: float) -> float:
        implication, aggregation = self.methods.implication, self.methods.aggregation
        if aggregation == "max":
            return combined(implication, (self.strengths[-1], degree))
        if implication == "prod":
            if aggregation == "sum":
                return degree * self._weakest[-1]
            return 1.0 - prod(1.0 - strength * degree for strength in self.strengths)
        # Rules weaker than the term is high cut it off; the others leave it as it is.
        cutting = bisect_left(self.strengths, degree)
        others = len(self.strengths) - cutting
        if aggregation == "sum":
            return self._weakest[cutting] + others * degree
        return float(1.0 - self._weakest[cutting] * (1.0 - degree) ** others)


@dataclass(frozen=True, slots=True)
class OutputSet:
    """The desirability of a numeric parameter."""

    interval: Interval
    concluded: tuple[Concluded, ...]
    """What each rule concludes; at least one."""
    methods: Methods
    _stacks: tuple[Stack, ...] = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        strengths: dict[NumericMembership, list[float]] = {}
        for term, strength in self.concluded:
            strengths.setdefault(term, []).append(strength)
        only_largest = self.methods.aggregation == "max"
        stacks = (
            Stack(term, (max(given),) if only_largest else tuple(sorted(given)), self.methods)
            for term, given in strengths.items()
        )
        object.__setattr__(self, "_stacks", tuple(stacks))

    @property
    def domain(self) -> tuple[float, float]:
        """The interval, in the parameter's unit."""
        return self.interval.ends

    def __call__(self, x: float) -> float:
        """The desirability of one value, in [0, 1]; 0 outside the domain."""
        return min(1.0, self.degree(x)) if x in self.interval else 0.0

    def degree(self, x: float) -> float:
        """As the methods have it: `sum` is not cut off at 1."""
        return combined(self.methods.aggregation, (stack(x) for stack in self._stacks))

    def height(self, low: float, high: float) -> float:
        """The largest desirability in [low, high]; 0 where that lies outside the domain."""
        low, high = max(low, self.interval.low), min(high, self.interval.high)
        if not low < high:
            return self(low) if low == high else 0.0
        if self.methods.aggregation == "max":
            return max(stack.height(low, high) for stack in self._stacks)
        return highest(self, self._places(low, high), low, high)

    def centroid(self, low: float, high: float) -> float | None:
        """The centre of area over [low, high]; None where there is no area."""
        low, high = max(low, self.interval.low), min(high, self.interval.high)
        return defuzzification.centroid(self._surface(low, high)) if low < high else None

    def sample(self, n: int = 101) -> tuple[Point, ...]:
        """The desirability at `n` evenly spaced values, both ends of the domain among them."""
        return sampled(self, *self.domain, n)

    @property
    def outline(self) -> tuple[Point, ...]:
        """101 points that straight lines join to the curve, nearly: it need not be straight anywhere."""
        return self.sample()

    def defuzzified(self) -> float | None:
        """The value by the rulebook's method, exactly (curves to 1e-9 of the range); None without area."""
        return defuzzification.EXACT[self.methods.defuzzification](self._surface(*self.domain))

    def defuzzified_from_samples(self, samples: int = 101) -> float | None:
        """MATLAB's rule: evenly spaced samples of equal weight, both ends included; None without area."""
        low, high = self.domain
        xs = [low + (high - low) * i / (samples - 1) for i in range(samples)]
        return defuzzification.SAMPLED[self.methods.defuzzification](xs, [self.degree(x) for x in xs])

    def _surface(self, low: float, high: float) -> defuzzification.Surface:
        parts: Sequence[defuzzification.Degree] = [self.degree]
        if self.methods.aggregation == "max":
            heights = [stack.height(low, high) for stack in self._stacks]
            largest = max(heights) - defuzzification.LEVEL
            parts = [s for s, height in zip(self._stacks, heights, strict=True) if height >= largest]
        return defuzzification.Surface(self.degree, self._places(low, high), parts)

    def _places(self, low: float, high: float) -> tuple[float, ...]:
        """Ascending, from low to high: the set is smooth between them, and straight where its terms are."""
        ends = (x for stack in self._stacks for x in (*stack.term.knots, *stack.cuts(low, high)))
        places = _ascending(ends, low, high)
        if self.methods.aggregation != "max":
            return places
        return _ascending((*places, *self._meetings(places)), low, high)

    def _meetings(self, places: Sequence[float]) -> Iterator[float]:
        """Where one straight conclusion passes another; curves are left to the quadrature."""
        straight = [stack for stack in self._stacks if stack.is_straight]
        for left, right in pairwise(places):
            lines = {_line(stack, left, right) for stack in straight}
            for (p0, p1), (q0, q1) in combinations(sorted(lines), 2):
                if (p0 - q0) * (p1 - q1) < 0:
                    yield left + (right - left) * (p0 - q0) / (p0 - q0 - p1 + q1)


def needs_output_set(methods: Methods) -> bool:
    """Whether `mamdani.AggregatedSet` does not serve; what `and` and `or` mean does not matter here."""
    return (methods.implication, methods.aggregation, methods.defuzzification) != ("min", "max", "centroid")


def _line(stack: Stack, left: float, right: float) -> tuple[float, float]:
    """The degrees just inside both ends, from two places between them: an edge may be vertical there."""
    near, far = (stack(left + part * (right - left)) for part in (0.25, 0.75))
    return near - (far - near) / 2, far + (far - near) / 2


def _crossings(term: NumericMembership, levels: Sequence[float], low: float, high: float) -> Iterator[float]:
    """Where a term that is monotonous over [low, high] has one of several ascending degrees, by bisection."""
    rises = term(high) > term(low)
    least, most = sorted((term(low), term(high)))
    for level in levels[bisect_left(levels, least) : bisect_left(levels, most)]:
        left, right = low, high
        for _ in range(60):
            middle = (left + right) / 2
            left, right = (middle, right) if (term(middle) < level) is rises else (left, middle)
        yield (left + right) / 2


def _ascending(places: Iterable[float], low: float, high: float) -> tuple[float, ...]:
    return low, *sorted({x for x in places if low < x < high}), high
