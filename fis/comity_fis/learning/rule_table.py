"""Rules from examples: one for each combination of terms to which enough examples belong.

The grid is that of Wang and Mendel, "Generating fuzzy rules by learning from examples", IEEE Transactions on
Systems, Man, and Cybernetics 22 (1992): every example belongs to the combination of those terms in which it
has the highest degrees. There the one example of the highest degree decides what its combination concludes,
so that a single outlier keeps a rule. Here all examples of a combination decide together, by their weighted
mean, as in Wang, "The WM method completed", IEEE Transactions on Fuzzy Systems 11 (2003).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from comity_fis.membership.arrays import degrees
from comity_fis.rules.rule import And, Condition, Is
from comity_fis.variables.parameter import NumericParameter

Floats = NDArray[np.float64]

LEAST_SUPPORT = 3.0
"""Below it a combination gets no rule (our choice): two people are an anecdote."""
POINTS = 2001
"""At which a term's centre of area is computed: it only has to be told from the other terms' centres."""


@dataclass(frozen=True, slots=True)
class Cell:
    """One combination of terms, and what its examples say."""

    terms: tuple[Is, ...]
    """One of each input, in the inputs' order."""
    conclusion: str
    """The term of the parameter whose own centre of area is nearest to `mean`."""
    mean: float
    """Of the examples, each weighted by its squared degree, in the parameter's unit."""
    support: float
    """Sum of the degrees to which examples belong here."""
    agreement: float
    """Mean degree of the examples' values in the conclusion, in [0, 1]."""

    @property
    def is_thin(self) -> bool:
        """Whether too few examples belong here for a rule."""
        return self.support < LEAST_SUPPORT

    @property
    def weight(self) -> float:
        """Of the rule, in (0, 1): support / (support + 1), so that 3 examples count 0.75 and 19 count 0.95.

        Our choice. It says how much the rule rests on, and stops to matter where there are many examples.
        """
        return round(self.support / (self.support + 1), 2)

    @property
    def antecedent(self) -> Condition:
        """What the rule asks for."""
        return self.terms[0] if len(self.terms) == 1 else And(self.terms)


def rule_table(
    inputs: Mapping[str, Mapping[str, Floats]], parameter: NumericParameter, values: Floats
) -> tuple[Cell, ...]:
    """What the examples say of every combination of terms that has any, the best supported first.

    Args:
        inputs: By variable, then by term: the degree of each example, in [0, 1]; at least one variable. An
            example with no degree above 0 in some variable belongs nowhere.
        parameter: What is concluded.
        values: Of the examples, in the parameter's unit.
    """
    best = {name: np.stack(list(terms.values())) for name, terms in inputs.items()}
    strength = np.min([degree.max(axis=0) for degree in best.values()], axis=0)
    places = np.stack([degree.argmax(axis=0) for degree in best.values()], axis=1)
    centres = centres_of_area(parameter)
    cells = [
        _cell(
            tuple(Is(name, list(inputs[name])[i]) for name, i in zip(inputs, place, strict=True)),
            strength[here],
            values[here],
            parameter,
            centres,
        )
        for place in np.unique(places[strength > 0], axis=0)
        if (here := (places == place).all(axis=1) & (strength > 0)).any()
    ]
    return tuple(sorted(cells, key=lambda cell: (-cell.support, str(cell.terms))))


def centres_of_area(parameter: NumericParameter) -> dict[str, float]:
    """By term, what a rule that concludes it gives alone; a term that is 0 in the rules' range has none."""
    xs = np.linspace(*parameter.rules.ends, POINTS)
    areas = {name: degrees(term, xs) for name, term in parameter.terms.items()}
    return {name: float(np.average(xs, weights=area)) for name, area in areas.items() if area.any()}


def _cell(
    terms: Sequence[Is],
    strength: Floats,
    values: Floats,
    parameter: NumericParameter,
    centres: Mapping[str, float],
) -> Cell:
    # Squared: an example that belongs here by half only has a value that is a blend with the neighbour's.
    mean = float(np.average(values, weights=strength**2))
    conclusion = min(centres, key=lambda term: abs(centres[term] - mean))
    within = np.clip(values, *parameter.rules.ends)
    agreement = np.average(degrees(parameter.terms[conclusion], within), weights=strength)
    return Cell(tuple(terms), conclusion, mean, float(strength.sum()), float(agreement))
