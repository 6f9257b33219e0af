"""The three ways to compute the same inference."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal, get_args

from comity_fis.defuzzification.output_set import OutputSet
from comity_fis.errors import InputError, closest, shown
from comity_fis.membership.function import NumericMembership

Mode = Literal["exact", "matlab", "skfuzzy"]
"""exact: the integral; matlab: 101 points and plain sums, as in the paper; skfuzzy: its plain functions."""


@dataclass(frozen=True, slots=True)
class Engine:
    """How to find a degree, and the number that stands for a set."""

    degree: Callable[[NumericMembership, float], float]
    value: Callable[[OutputSet], float | None]


def engine_for(mode: str) -> Engine:
    """The engine of a mode.

    Raises:
        InputError: if there is no such mode.
    """
    if not isinstance(mode, str) or mode not in get_args(Mode):
        raise InputError(expected="a mode", got=shown(mode), remedy=closest(str(mode), get_args(Mode)))
    if mode == "exact":
        return EXACT
    if mode == "skfuzzy":
        from comity_fis.defuzzification import reference

        return Engine(reference.degree, reference.value)
    return MATLAB


def _own(term: NumericMembership, x: float) -> float:
    """By the membership function itself."""
    return term(x)


EXACT = Engine(_own, OutputSet.value)
MATLAB = Engine(_own, OutputSet.value_from_samples)
