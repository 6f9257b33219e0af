"""The operators of an inference: MATLAB's choices under MATLAB's names.

The defaults are Mamdani's and the paper's. `prod` is a b, `probor` is a + b - a b, `sum` adds up and is not
cut off at 1; the defuzzification methods are in `defuzzification`.
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
"""By De Morgan: 1 - f(a, b) = dual(1 - a, 1 - b)."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Methods:
    """How one rulebook's rules are evaluated."""

    conjunction: Conjunction = "min"
    """`and`."""
    disjunction: Disjunction = "max"
    """`or`."""
    implication: Implication = "min"
    """How a rule's strength shapes its output term: cut off, or scaled."""
    aggregation: Aggregation = "max"
    """How the shaped terms of all rules unite."""
    defuzzification: Defuzzification = "centroid"
    """How the united set becomes one number."""

    def __post_init__(self) -> None:
        for field in fields(self):
            if getattr(self, field.name) not in CHOICES[field.name]:
                raise WrongValueError(
                    expected=f"{field.name} to be one of {', '.join(CHOICES[field.name])}",
                    got=repr(getattr(self, field.name)),
                )


MAMDANI = Methods()
"""Min, max, min, max and the centre of area."""


def combined(method: str, degrees: Iterable[float]) -> float:
    """At least one degree, combined by min, prod, max, probor or sum."""
    return OPERATORS[method](tuple(degrees))


def united(strengths: Iterable[tuple[str, float]], aggregation: Aggregation) -> dict[str, float]:
    """Each term's strengths as one, which under `sum` may pass 1; terms in the order in which they came."""
    by_term: dict[str, list[float]] = {}
    for term, degree in strengths:
        by_term.setdefault(term, []).append(degree)
    return {term: combined(aggregation, degrees) for term, degrees in by_term.items()}


def probor(one: Any, other: Any) -> Any:
    """MATLAB's probabilistic or, of two degrees or two arrays of them."""
    return one + other - one * other


def _folded(operator: Callable[[float, float], float]) -> Callable[[Sequence[float]], float]:
    """In whatever order degrees come, their combination is the same to the last digit.

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
"""For one person; at least one degree each."""
