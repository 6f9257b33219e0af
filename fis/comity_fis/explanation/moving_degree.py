"""Degrees that move: a value with its rate, through any `and` and `or` (forward differentiation).

Where two degrees tie, `min` goes on with the slower and `max` with the faster of them: the derivative on the
side to which the input moves.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import reduce
from typing import NamedTuple

from comity_fis.rules.antecedent import TIE, Logic
from comity_fis.rules.methods import DUAL, Methods


class MovingDegree(NamedTuple):
    """A degree in [0, 1] and how fast it changes."""

    degree: float
    rate: float


Operator = Callable[[MovingDegree, MovingDegree], MovingDegree]


def moving_logic(methods: Methods) -> Logic[MovingDegree]:
    """What a rulebook's methods make of `and` and `or`, for degrees that move."""
    return Logic(
        _of_several(methods.conjunction),
        _of_several(methods.disjunction),
        not_all_of=_of_several(DUAL[methods.conjunction]),
        not_any_of=_of_several(DUAL[methods.disjunction]),
    )


def _of_several(method: str) -> Callable[[Sequence[MovingDegree]], MovingDegree]:
    operator = _OPERATORS[method]
    return lambda degrees: reduce(operator, degrees)


def _min(one: MovingDegree, other: MovingDegree) -> MovingDegree:
    if abs(one.degree - other.degree) <= TIE:
        return MovingDegree(min(one.degree, other.degree), min(one.rate, other.rate))
    return one if one.degree < other.degree else other


def _max(one: MovingDegree, other: MovingDegree) -> MovingDegree:
    if abs(one.degree - other.degree) <= TIE:
        return MovingDegree(max(one.degree, other.degree), max(one.rate, other.rate))
    return one if one.degree > other.degree else other


def _prod(one: MovingDegree, other: MovingDegree) -> MovingDegree:
    rate = _times(one.rate, other.degree) + _times(other.rate, one.degree)
    return MovingDegree(one.degree * other.degree, rate)


def _probor(one: MovingDegree, other: MovingDegree) -> MovingDegree:
    rate = _times(one.rate, 1.0 - other.degree) + _times(other.rate, 1.0 - one.degree)
    return MovingDegree(one.degree + other.degree - one.degree * other.degree, rate)


def _times(rate: float, degree: float) -> float:
    """Their product, 0 where one is: a jump that nothing lets through is none."""
    return rate * degree if rate and degree else 0.0


_OPERATORS: dict[str, Operator] = {"min": _min, "max": _max, "prod": _prod, "probor": _probor}
