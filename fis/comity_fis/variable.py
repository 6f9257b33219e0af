"""Linguistic variables: name, domain, terms and membership functions (Zadeh 1975; the paper's quadruple)."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Literal

from comity_fis.errors import InputError, WrongValueError, closest
from comity_fis.interval import Interval
from comity_fis.measurement import Coercion, Level
from comity_fis.membership import Categories, NumericMembership

Shapes = Literal["published", "reconstructed", "fitted", "design"]
"""Where membership functions come from: printed in the source; recovered from the numbers that it prints;
fitted to data; our own choice."""


@dataclass(frozen=True, slots=True)
class Derivation:
    """How a caller finds a variable's value in a profile that does not state it."""

    fact: str
    """What the profile states instead, for example `culture`."""
    table: str
    """The table that translates it, see `comity_fis.score`."""


@dataclass(frozen=True, slots=True)
class Partition:
    """How a variable's terms were obtained from data: enough to do it again."""

    data: str
    radius: float
    """Of the subtractive clustering, relative to the data's range."""
    centres: tuple[float, ...]
    """Of the c-means clusters, ascending, one per term."""
    squared_errors: tuple[float, ...]
    """Of the fit of each term, summed over all data."""
    method: str


@dataclass(frozen=True, slots=True, kw_only=True)
class NumericVariable:
    """A variable whose values are numbers."""

    name: str
    kind: Literal["culture", "situation"]
    """Whether it tells who the person is or how things stand now."""
    level: Level
    domain: Interval
    terms: Mapping[str, NumericMembership]
    unit: str | None = None
    coercion: Coercion | None = None
    derived_from: Derivation | None = None
    partition: Partition | None = None
    shapes: Shapes = "design"
    reason: str = ""
    """Why this domain and these shapes."""

    def __post_init__(self) -> None:
        effective = self.coercion.to if self.coercion else self.level
        if effective < Level.INTERVAL:
            raise WrongValueError(
                expected="at least interval level for terms over numbers, or a coercion to it with a reason",
                got=f"level {effective}",
            )
        if self.level == Level.RATIO and self.domain.low < 0:
            raise WrongValueError(
                expected="a range that starts at 0 or above for ratio level", got=self.domain
            )
        if not self.terms:
            raise WrongValueError(expected="at least one term", got="none")

    def check(self, value: object) -> float:
        """A value that a user gave, as a number of the domain.

        Raises:
            InputError: if it is no number of the domain.
        """
        if isinstance(value, (int, float)) and not isinstance(value, bool) and value in self.domain:
            return float(value)
        unit = f" {self.unit}" if self.unit else ""
        raise InputError(
            expected=f"{self.name} as a number in {self.domain}{unit}",
            got=repr(value),
            remedy="Leave it out where it is not known.",
        )


@dataclass(frozen=True, slots=True, kw_only=True)
class NominalVariable:
    """A variable whose values are words."""

    name: str
    kind: Literal["culture", "situation"]
    categories: tuple[str, ...]
    """In declared order. Every category is a term of its own."""
    groups: Mapping[str, Categories] = field(default_factory=dict)
    """Further terms that stand for several categories."""
    labels: Mapping[str, str] = field(default_factory=dict)
    """What a category is called in plain words, where its name is a code."""
    derived_from: Derivation | None = None
    reason: str = ""
    terms: Mapping[str, Categories] = field(init=False)
    level: Literal[Level.NOMINAL] = field(default=Level.NOMINAL, init=False)
    unit: None = field(default=None, init=False)
    coercion: None = field(default=None, init=False)

    def __post_init__(self) -> None:
        if not self.categories or len(set(self.categories)) < len(self.categories):
            raise WrongValueError(
                expected="at least one category and each only once", got=list(self.categories)
            )
        singles = {category: Categories(frozenset({category})) for category in self.categories}
        for name, group in self.groups.items():
            if name in singles or not group.members <= singles.keys():
                raise WrongValueError(
                    expected=f"a group {name} with a name of its own and only declared categories",
                    got=sorted(group.members),
                )
        object.__setattr__(self, "terms", {**singles, **self.groups})

    def check(self, value: object) -> str:
        """A value that a user gave, as one of the categories.

        Raises:
            InputError: if it is none of them.
        """
        if not isinstance(value, str) or value not in self.categories:
            raise InputError(
                expected=f"{self.name} as one of its {len(self.categories)} categories",
                got=repr(value),
                remedy=closest(
                    str(value), self.categories, {label: key for key, label in self.labels.items()}
                ),
            )
        return value


Variable = NumericVariable | NominalVariable
