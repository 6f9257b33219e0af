"""Parameters of actions and behaviours: what the rules decide.

The paper divides them into action parameters, fixed when the plan is made, and behaviour parameters, used by
a running behaviour and inferred again when the situation changes.
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
    """A parameter that is a number. All numbers are in `unit`."""

    name: str
    kind: ParameterKind
    unit: str
    rules: Interval
    """What the rules can give: the domain of the output sets."""
    ask: Interval
    """What a person may ask for; anything else is refused. It may leave out what the rules can give where the
    robot would not keep to it."""
    safe: Interval
    """What safety allows, with infinite ends where it sets no limit; anything else is clamped."""
    terms: Mapping[str, NumericMembership]
    neutral: float
    """What stands where the rules have nothing to go on."""
    spread: float
    """Standard deviation of people around a value; not the width of a fuzzy set."""
    measured: Literal["surface", "centre"] | None = None
    """Of a distance: between the nearest points of the two bodies, or between their centres."""
    shapes: Shapes = "design"
    shift: Shift | None = None
    """How far the situation may move it; None where the rulebook lets nothing move it."""
    reasons: Mapping[str, str]
    """Why these ranges, terms, neutral and spread: a source, or that it is our choice."""

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
        """Terms that are 0 everywhere in the rules' range: rules that conclude them change nothing."""
        ends = self.rules.ends
        return tuple(name for name, term in self.terms.items() if not term.height(*ends) > 0)

    @property
    def conclusions(self) -> Mapping[str, NumericMembership]:
        """What rules may conclude of it: its terms, and those of its shift."""
        return {**self.terms, **(self.shift.terms if self.shift else {})}

    def check(self, value: object) -> float:
        """What a person asked for, as a number of the ask range.

        Raises:
            InputError: if it is no such number.
        """
        if isinstance(value, int | float) and not isinstance(value, bool) and value in self.ask:
            return float(value)
        raise InputError(
            expected=f"{self.name} as a number in {self.ask} {self.unit}",
            got=shown(value),
            remedy="Ask for a value in this range, or leave it to the rules.",
        )

    def membership(self, term: str, value: float | str) -> float:
        """The degree to which a rule that reads this parameter finds it in one of its terms.

        A setting beyond the rules' range counts as the end of that range.
        """
        return self.terms[term](self.rules.clamp(float(value)))


@dataclass(frozen=True, slots=True)
class Category:
    """One value of a nominal parameter."""

    name: str
    requires: Condition | None = None
    """What must hold fully and be known, for example that touch was consented to; None: always permitted."""


@dataclass(frozen=True, slots=True, kw_only=True)
class NominalParameter:
    """A parameter that is one of several words."""

    name: str
    kind: ParameterKind
    categories: tuple[Category, ...]
    neutral: str
    """What stands where the rules have nothing to go on, and wins ties."""
    reasons: Mapping[str, str]
    terms: tuple[str, ...] = field(init=False, repr=False, compare=False)
    """The categories' names in declared order."""

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
        """What rules may conclude of it."""
        return self.terms

    def check(self, value: object) -> str:
        """What a person asked for, as one of the categories, permitted or not.

        Raises:
            InputError: if it is none of them.
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
