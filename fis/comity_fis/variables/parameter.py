"""Parameters of actions and behaviours, which the rules conclude.

The paper distinguishes action parameters, fixed when the plan is made, and behaviour parameters, used by a
running behaviour and inferred again when the situation changes.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Literal

from comity_fis.errors import InputError, WrongValueError, closest, shown
from comity_fis.membership.function import NumericMembership
from comity_fis.membership.interval import Interval
from comity_fis.rules.rule import Condition
from comity_fis.variables.frozen import freeze
from comity_fis.variables.shift import Shift
from comity_fis.variables.variable import Shapes

ParameterKind = Literal["action", "behaviour"]


@dataclass(frozen=True, slots=True, kw_only=True)
class NumericParameter:
    """A numeric parameter. All numbers are in `unit`."""

    name: str
    kind: ParameterKind
    unit: str
    rules: Interval
    """Range of the rules' output: the domain of the output sets."""
    ask: Interval
    """Range that a person may request; other requests are rejected. It may exclude values that the rules can
    give but the robot would not keep to."""
    safe: Interval
    """Safe range, with infinite ends where there is no limit; other values are clamped."""
    terms: Mapping[str, NumericMembership]
    neutral: float
    """Value if no rule has a known input."""
    spread: float
    """Standard deviation between individuals around a value; not the width of a fuzzy set."""
    measured: Literal["surface", "centre"] | None = None
    """For a distance: between the nearest points of the two bodies, or between their centres."""
    shapes: Shapes = "design"
    shift: Shift | None = None
    """How far the situation may shift the parameter; None for not at all."""
    reasons: Mapping[str, str]
    """Reasons for these ranges, terms, neutral and spread: a source, or that it is our choice."""

    def __post_init__(self) -> None:
        if self.neutral not in self.ask:
            raise WrongValueError(
                expected=f"an ask range with the neutral value {self.neutral:g} in it", got=self.ask
            )
        if not self.safe.covers(self.rules):
            raise WrongValueError(
                expected=f"a safe range that covers the rules' range {self.rules}", got=self.safe
            )
        if self.neutral not in self.rules:
            raise WrongValueError(
                expected=f"a neutral value in the rules' range {self.rules}", got=self.neutral
            )
        if not self.spread > 0:
            raise WrongValueError(expected="a spread above 0", got=self.spread)
        if both := [name for name in self.terms if self.shift and name in self.shift.terms]:
            raise WrongValueError(expected="other names for the shift's terms", got=repr(both[0]))
        freeze(self, terms=self.terms)

    @property
    def empty_terms(self) -> tuple[str, ...]:
        """Terms that are 0 everywhere in the rules' range: concluding them has no effect."""
        ends = self.rules.ends
        return tuple(name for name, term in self.terms.items() if not term.height(*ends) > 0)

    @property
    def conclusions(self) -> Mapping[str, NumericMembership]:
        """Terms that rules may conclude: the parameter's own and those of its shift."""
        return {**self.terms, **(self.shift.terms if self.shift else {})}

    def check(self, value: object) -> float:
        """A person's request as a number in the `ask` range.

        Raises:
            InputError: It is not a number in that range.
        """
        if isinstance(value, int | float) and not isinstance(value, bool) and value in self.ask:
            return float(value)
        raise InputError(
            expected=f"{self.name} as a number in {self.ask} {self.unit}",
            got=shown(value),
            remedy="Ask for a value in this range, or leave it to the rules.",
        )

    def membership(self, term: str, value: float | str) -> float:
        """The degree of the parameter's value in a term, for rules that read this parameter.

        A setting outside the rules' range counts as the nearest end of that range.
        """
        return self.terms[term](self.rules.clamp(float(value)))


@dataclass(frozen=True, slots=True)
class Category:
    """One value of a nominal parameter."""

    name: str
    requires: Condition | None = None
    """Condition that must hold fully and be known, such as consent to touch; None: always permitted."""


@dataclass(frozen=True, slots=True, kw_only=True)
class NominalParameter:
    """A nominal parameter: one of several categories."""

    name: str
    kind: ParameterKind
    categories: tuple[Category, ...]
    neutral: str
    """Category if no rule has a known input; it also wins ties."""
    reasons: Mapping[str, str]
    terms: tuple[str, ...] = field(init=False, repr=False, compare=False)
    """Names of the categories in declared order."""

    def __post_init__(self) -> None:
        names = tuple(category.name for category in self.categories)
        object.__setattr__(self, "terms", names)
        if not names or len(set(names)) < len(names):
            raise WrongValueError(expected="at least one category and each only once", got=list(names))
        if self.neutral not in {category.name for category in self.categories if category.requires is None}:
            raise WrongValueError(
                expected="a neutral category that is always permitted", got=repr(self.neutral)
            )

    @property
    def conclusions(self) -> tuple[str, ...]:
        """Categories that rules may conclude."""
        return self.terms

    def check(self, value: object) -> str:
        """A person's request as one of the categories, permitted or not.

        Raises:
            InputError: It is not a category.
        """
        if not isinstance(value, str) or value not in self.terms:
            raise InputError(
                expected=f"{self.name} as one of its categories",
                got=shown(value),
                remedy=closest(str(value), self.terms),
            )
        return value

    def membership(self, term: str, value: float | str) -> float:
        """1 if the parameter has this category, 0 otherwise."""
        return 1.0 if value == term else 0.0


Parameter = NumericParameter | NominalParameter
