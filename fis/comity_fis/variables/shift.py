"""How far the situation may shift a parameter, as linguistic terms: closer, same, farther."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from comity_fis.errors import WrongValueError
from comity_fis.membership.function import NumericMembership
from comity_fis.membership.interval import Interval
from comity_fis.variables.frozen import freeze
from comity_fis.variables.variable import Shapes

NEUTRAL = 0.0
"""Shift if nothing is known."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Shift:
    """Domain and terms of a parameter's shift, concluded by separate rules over situation variables."""

    range: Interval
    """Range of the shift in the parameter's unit; contains 0."""
    terms: Mapping[str, NumericMembership]
    shapes: Shapes
    reason: str
    """Reason for range and terms: a source, or that it is our choice."""

    def __post_init__(self) -> None:
        if NEUTRAL not in self.range:
            raise WrongValueError(expected="a shift's range that holds 0", got=self.range)
        if not self.terms:
            raise WrongValueError(expected="at least one term", got="none")
        for name, term in self.terms.items():
            if not term.height(*self.range.ends) > 0:
                raise WrongValueError(
                    expected=f"a term {name} that is above 0 somewhere in {self.range}", got=term
                )
        freeze(self, terms=self.terms)
