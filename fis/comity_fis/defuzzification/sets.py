"""The output sets of many people at once: the same terms, each at every person's own strengths."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from comity_fis.defuzzification.ground import Ground
from comity_fis.membership.arrays import degrees
from comity_fis.rules.methods import Methods

Floats = NDArray[np.float64]
Whole = NDArray[np.intp]


@dataclass(frozen=True, slots=True)
class Sets:
    """The output sets of several people, made of layers: terms that rules conclude, or one rule's term."""

    ground: Ground
    methods: Methods
    terms: Sequence[int]
    """Of each layer, the number of its term; at least one."""
    strengths: Floats
    """Of each layer and person; 0 where the rule does not hold."""

    @property
    def count(self) -> int:
        """How many people."""
        return len(self.strengths[0])

    def part(self, people: slice) -> Sets:
        """Of some of the people."""
        return Sets(self.ground, self.methods, self.terms, self.strengths[:, people])

    def tops(self) -> dict[int, Floats]:
        """The largest strength of each term that a layer has, for each person."""
        tops: dict[int, Floats] = {}
        for term, strengths in zip(self.terms, self.strengths, strict=True):
            tops[term] = np.maximum(tops[term], strengths) if term in tops else strengths
        return tops

    def on_ground(self) -> Floats:
        """Degrees by person, panel of the ground, and place in it."""
        implied = self._implied
        layers = zip(self.terms, self.strengths, strict=True)
        return self._united(implied(self.ground.degrees[term], row[:, None, None]) for term, row in layers)

    def at(self, people: Whole, xs: Floats) -> Floats:
        """Degrees at places of some person each: `xs` has one row, or one number, for each of `people`."""
        return self._united(self.shaped(people, xs))

    def shaped(self, people: Whole, xs: Floats) -> Iterator[Floats]:
        """What each layer alone has there."""
        here = {term: degrees(self.ground.terms[term], xs) for term in set(self.terms)}
        shape = (people.size, *[1] * (xs.ndim - 1))
        for term, strengths in zip(self.terms, self.strengths, strict=True):
            yield self._implied(here[term], strengths[people].reshape(shape))

    @property
    def _implied(self) -> np.ufunc:
        return np.minimum if self.methods.implication == "min" else np.multiply

    def _united(self, layers: Iterator[Floats]) -> Floats:
        """Layers as one set; under `sum` it may pass 1."""
        united = next(layers)
        for layer in layers:
            if self.methods.aggregation == "max":
                np.maximum(united, layer, out=united)
            else:
                both = united * layer if self.methods.aggregation == "probor" else 0.0
                united += layer
                united -= both
        return united
