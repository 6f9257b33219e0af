"""The set that rules give together: the desirability of a numeric parameter.

Each rule shapes its term by its strength, and the shaped terms unite: cut off and united by max in the
paper's case (Mamdani and Assilian 1975; MATLAB's default).
"""

from __future__ import annotations

from dataclasses import dataclass
from math import isnan
from typing import TYPE_CHECKING, NamedTuple

from comity_fis.defuzzification.curve import Point
from comity_fis.defuzzification.outline import corners, sampled
from comity_fis.defuzzification.samples import SAMPLED
from comity_fis.membership.function import NumericMembership, Singleton, is_straight
from comity_fis.membership.interval import Interval
from comity_fis.rules.methods import MAMDANI, Defuzzification, Methods, combined

if TYPE_CHECKING:
    from comity_fis.defuzzification.panels import Panels


class Layer(NamedTuple):
    """An output term, and the strength in (0, 1] of a rule that concludes it."""

    term: NumericMembership
    strength: float


@dataclass(frozen=True, slots=True)
class OutputSet:
    """The desirability of a numeric parameter."""

    interval: Interval
    layers: tuple[Layer, ...]
    """What rules conclude; where only the strongest rule of a term counts, that of each term."""
    methods: Methods = MAMDANI
    terms: tuple[NumericMembership, ...] = ()
    """All terms of the parameter, for which the range is cut into panels once; empty: those of the layers."""

    @property
    def domain(self) -> tuple[float, float]:
        """The interval, in the parameter's unit."""
        return self.interval.ends

    @property
    def all_singletons(self) -> bool:
        """Whether nothing but single places is concluded, which no even samples would meet."""
        return all(isinstance(layer.term, Singleton) for layer in self.layers)

    def __call__(self, x: float) -> float:
        """The desirability of one value, in [0, 1]; 0 outside the domain."""
        return min(1.0, self.degree(x)) if x in self.interval else 0.0

    def degree(self, x: float) -> float:
        """As the methods have it: `sum` is not cut off at 1."""
        shaped = [combined(self.methods.implication, (strength, term(x))) for term, strength in self.layers]
        return combined(self.methods.aggregation, shaped) if shaped else 0.0

    def height(self, low: float, high: float) -> float:
        """The largest desirability in [low, high]; 0 where that lies outside the domain."""
        low, high = max(low, self.interval.low), min(high, self.interval.high)
        if not low < high or not self.layers:
            return self(low) if low == high else 0.0
        if self.methods.aggregation == "max":
            implication = self.methods.implication
            return max(
                combined(implication, (height, term.height(low, high))) for term, height in self.layers
            )
        from comity_fis.defuzzification.exact import heights

        return min(1.0, float(heights(self._panels(low, high))[0]))

    def centroid(self, low: float, high: float) -> float | None:
        """The centre of area over [low, high]; None where there is no area."""
        low, high = max(low, self.interval.low), min(high, self.interval.high)
        return self._exact("centroid", low, high) if low < high else None

    def value(self) -> float | None:
        """The number that stands for the set by its methods, exactly; None without area."""
        return self._exact(self.methods.defuzzification, *self.domain)

    def value_from_samples(self, samples: int = 101) -> float | None:
        """MATLAB's rule: evenly spaced samples of equal weight, both ends included; None without area.

        Singletons are no samples: MATLAB reads constants where they stand.
        """
        if self.all_singletons:
            return self.value()
        low, high = self.domain
        xs = [low + (high - low) * i / (samples - 1) for i in range(samples)]
        return SAMPLED[self.methods.defuzzification](xs, [self.degree(x) for x in xs])

    def sample(self, n: int = 101) -> tuple[Point, ...]:
        """The desirability at `n` evenly spaced values, both ends of the domain among them."""
        return sampled(self, *self.domain, n)

    @property
    def outline(self) -> tuple[Point, ...]:
        """Points that straight lines join to the curve: its corners where it is made of straight lines.

        A jump has two points at the same value. Another set is given by 101 points.
        """
        if self.layers and self.methods.aggregation == "max" and all(is_straight(t) for t, _ in self.layers):
            return corners(self._panels(*self.domain))
        return self.sample()

    def _exact(self, method: Defuzzification, low: float, high: float) -> float | None:
        from comity_fis.defuzzification.exact import EXACT

        if not self.layers:
            return None
        value = float(EXACT[method](self._panels(low, high))[0])
        return None if isnan(value) else value

    def _panels(self, low: float, high: float) -> Panels:
        # numpy is imported where an exact value of a set needs it: most parameters have a closed form.
        import numpy as np

        from comity_fis.defuzzification.ground import ground_of
        from comity_fis.defuzzification.panels import panels_of
        from comity_fis.defuzzification.sets import Sets

        terms = self.terms or tuple(dict.fromkeys(term for term, _ in self.layers))
        strengths = np.array([[strength] for _, strength in self.layers])
        numbers = [terms.index(term) for term, _ in self.layers]
        return panels_of(Sets(ground_of(terms, low, high, self.methods), self.methods, numbers, strengths))
