"""Inference operators, with MATLAB's options and names.

The defaults are Mamdani's and the paper's. `prod` is a b, `probor` is a + b - a b, and `sum` is not clipped
at 1; the defuzzification methods are in `defuzzification`.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, fields
from functools import reduce
from typing import Any, Literal, get_args

from comity_fis.errors import WrongValueError

Conjunction = Literal["min", "prod"]
Disjunction = Literal["max", "probor"]
Implication = Literal["min", "prod"]
Aggregation = Literal["max", "probor", "sum"]
Defuzzification = Literal["centroid", "bisector", "mom", "som", "lom"]

CHOICES: dict[str, tuple[str, ...]] = {
    "conjunction": get_args(Conjunction),
    "disjunction": get_args(Disjunction),
    "implication": get_args(Implication),
    "aggregation": get_args(Aggregation),
    "defuzzification": get_args(Defuzzification),
}

DUAL = {"min": "max", "max": "min", "prod": "probor", "probor": "prod"}
"""De Morgan duals: 1 - f(a, b) = dual(1 - a, 1 - b)."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Methods:
    """Inference methods of a rulebook."""

    conjunction: Conjunction = "min"
    """Operator for `and`."""
    disjunction: Disjunction = "max"
    """Operator for `or`."""
    implication: Implication = "min"
    """How a rule's strength shapes its output term: clipped (min) or scaled (prod)."""
    aggregation: Aggregation = "max"
    """How the shaped terms of all rules are combined."""
    defuzzification: Defuzzification = "centroid"
    """How the aggregated set becomes one number."""

    def __post_init__(self) -> None:
        for field in fields(self):
            if getattr(self, field.name) not in CHOICES[field.name]:
                raise WrongValueError(
                    expected=f"{field.name} to be one of {', '.join(CHOICES[field.name])}",
                    got=repr(getattr(self, field.name)),
                )


MAMDANI = Methods()
"""Min, max, min, max and centroid."""


def combined(method: str, degrees: Iterable[float]) -> float:
    """Degrees (at least one) combined by min, prod, max, probor or sum."""
    return OPERATORS[method](tuple(degrees))


def united(strengths: Iterable[tuple[str, float]], aggregation: Aggregation) -> dict[str, float]:
    """Combined strength of each term, which may exceed 1 for `sum`; terms in order of first occurrence."""
    by_term: dict[str, list[float]] = {}
    for term, degree in strengths:
        by_term.setdefault(term, []).append(degree)
    return {term: combined(aggregation, degrees) for term, degrees in by_term.items()}


def probor(one: Any, other: Any) -> Any:
    """MATLAB's probabilistic or, of two degrees or two arrays of them."""
    return one + other - one * other


def _folded(operator: Callable[[float, float], float]) -> Callable[[Sequence[float]], float]:
    """Fold in sorted order, so that the result does not depend on the order of the degrees to the last digit.

    An exported rule has its conditions in the order of the columns.
    """
    return lambda degrees: reduce(operator, sorted(degrees))


OPERATORS: Mapping[str, Callable[[Sequence[float]], float]] = {
    "min": min,
    "max": max,
    "prod": _folded(lambda one, other: one * other),
    "probor": _folded(probor),
    "sum": _folded(lambda one, other: one + other),
}
"""Operators for one person; at least one degree each."""
