"""Linguistic variables: name, domain, terms and membership functions (Zadeh 1975; the paper's quadruple)."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace
from typing import Any, Literal

from comity_fis.errors import InputError, WrongValueError, closest, shown
from comity_fis.membership.function import Categories, NumericMembership
from comity_fis.membership.interval import Interval
from comity_fis.scores.iso3166 import NO_CODE
from comity_fis.scores.population_table import Population, PopulationTable, Score
from comity_fis.variables.culture_terms import CultureTerms
from comity_fis.variables.frozen import FrozenDict, freeze
from comity_fis.variables.measurement import Coercion, Level, effective_level, level_text
from comity_fis.variables.own_words import CULTURE, in_own_words
from comity_fis.variables.scale import IntervalScale, NominalScale, OrdinalScale, RatioScale

Shapes = Literal["published", "reconstructed", "fitted", "design"]
"""Origin of membership functions: published in the source; reconstructed from its numbers; fitted to data;
our own choice."""


@dataclass(frozen=True, slots=True)
class Derivation:
    """How to derive a variable's value from a profile that does not state it."""

    fact: str
    """The fact that the profile states instead, such as `culture`."""
    table: PopulationTable[Score] | None = None
    """Table from the fact to the value, see `comity_fis.read_scores`; None if the fact is the value."""


@dataclass(frozen=True, slots=True)
class Partition:
    """How a variable's terms were obtained from data, to make it reproducible."""

    data: str
    radius: float
    """Radius of the subtractive clustering, relative to the data's range."""
    centres: tuple[float, ...]
    """Centres of the c-means clusters, ascending, one per term."""
    squared_errors: tuple[float, ...]
    """Sum of squared errors of each term's fit over all data."""
    method: str
    largest_errors: tuple[float, ...] = ()
    """Maximum error of each term against the c-means degrees over the data's range; empty if not computed."""
    held: Mapping[str, str] = field(default_factory=dict)
    """Terms constrained to one peak, each with the reason why its free fit is unusable."""


@dataclass(frozen=True, slots=True, kw_only=True)
class NumericVariable:
    """A numeric variable."""

    name: str
    kind: Literal["culture", "situation"]
    """Whether it describes the person or the current situation."""
    level: Level
    domain: Interval
    terms: Mapping[str, NumericMembership]
    """Terms; empty if no rule reads the variable."""
    unit: str | None = None
    coercion: Coercion | None = None
    derived_from: Derivation | None = None
    partition: Partition | None = None
    shapes: Shapes = "design"
    reason: str = ""
    """Reason for this domain and these shapes."""

    def __post_init__(self) -> None:
        effective = effective_level(self.level, self.coercion)
        if effective < Level.INTERVAL:
            raise WrongValueError(
                expected="at least interval level for terms over numbers, or a coercion to it with a reason",
                got=f"level {effective}",
            )
        if self.level == Level.RATIO and self.domain.low < 0:
            raise WrongValueError(
                expected="a range that starts at 0 or above for ratio level",
                got=self.domain,
                remedy="Where values below 0 mean something, zero is not none: the level is interval.",
            )
        freeze(self, terms=self.terms)

    @property
    def measured(self) -> str:
        """The level in words, with its coercion."""
        return level_text(self.level, self.coercion)

    @property
    def scale(self) -> IntervalScale | RatioScale:
        """The operations on its values, at the effective level of measurement."""
        ratio = effective_level(self.level, self.coercion) == Level.RATIO
        return (RatioScale if ratio else IntervalScale)(
            variable=self.name, check=self.check, level=self.level, coercion=self.coercion, rank=float
        )

    def check(self, value: object) -> float:
        """Validate a user's value as a number of the domain.

        Raises:
            InputError: It is not a number of the domain.
        """
        if isinstance(value, (int, float)) and not isinstance(value, bool) and value in self.domain:
            return float(value)
        unit = f" {self.unit}" if self.unit else ""
        raise InputError(
            expected=f"{self.name} as a number in {self.domain}{unit}",
            got=shown(value),
            remedy="Leave it out where it is not known.",
        )


@dataclass(frozen=True, slots=True, kw_only=True)
class NominalVariable:
    """A nominal variable."""

    name: str
    kind: Literal["culture", "situation"]
    categories: tuple[str, ...]
    """Categories in declared order, each of which is also a term."""
    groups: Mapping[str, Categories] = field(default_factory=dict)
    """Additional terms that cover several categories."""
    labels: Mapping[str, str] = field(default_factory=dict)
    """Plain names of categories whose names are codes."""
    table: PopulationTable[Population] | None = None
    """Table whose keys are the categories; any name that it understands is accepted."""
    derived_from: Derivation | None = None
    reason: str = ""
    terms: Mapping[str, Categories] = field(init=False)
    level: Literal[Level.NOMINAL, Level.ORDINAL] = field(default=Level.NOMINAL, init=False)
    unit: None = field(default=None, init=False)
    coercion: None = field(default=None, init=False)

    def __post_init__(self) -> None:
        if not self.categories or len(set(self.categories)) < len(self.categories):
            raise WrongValueError(
                expected="at least one category and each only once", got=list(self.categories)
            )
        singles = {category: Categories(frozenset({category})) for category in self.categories}
        for name, group in self.groups.items():
            if name in singles or not (self.tells_culture or group.members <= singles.keys()):
                raise WrongValueError(
                    expected=f"a group {name} with a name of its own and only declared categories",
                    got=sorted(group.members),
                )
        freeze(self, groups=self.groups, labels=self.labels)
        terms = {**singles, **self.groups}
        made = CultureTerms(terms) if self.tells_culture else FrozenDict(terms)
        object.__setattr__(self, "terms", made)

    @property
    def tells_culture(self) -> bool:
        """Whether its values are cultures; then cultures other than the categories are also accepted."""
        fact = self.derived_from.fact if self.derived_from else self.name
        return fact == CULTURE or self.table is not None

    def naming(self, cultures: Iterable[str]) -> NominalVariable:
        """A copy of a culture variable with these cultures added to its categories."""
        more = (in_own_words(CULTURE, name, self.categories) for name in cultures if name not in self.groups)
        new = [name for name in dict.fromkeys(more) if name is not None and name not in self.categories]
        return replace(self, categories=(*self.categories, *new)) if new else self

    @property
    def measured(self) -> str:
        """The level in words."""
        return str(self.level)

    @property
    def first_number(self) -> int:
        """Number of the first category in a numeric column."""
        return 0

    @property
    def scale(self) -> NominalScale[str]:
        """The operations on its values."""
        return NominalScale(variable=self.name, check=self.check, level=self.level)

    def check(self, value: object) -> str:
        """Validate a user's value: a category, or the person's own word, see `in_own_words`.

        Raises:
            InputError: It is neither.
        """
        if isinstance(value, str):
            if value in self.categories:
                return value
            fact = CULTURE if self.tells_culture else self.name
            if (own := in_own_words(fact, value, self.categories)) is not None:
                return own
            if self.tells_culture:
                raise InputError(
                    expected=f"{self.name} as a country, a region, or what people call their culture",
                    got=shown(value),
                    remedy=NO_CODE,
                )
        raise InputError(
            expected=f"{self.name} as one of its {len(self.categories)} categories",
            got=shown(value),
            remedy=closest(str(value), self.categories, {label: key for key, label in self.labels.items()}),
        )


@dataclass(frozen=True, slots=True, kw_only=True)
class OrdinalVariable(NominalVariable):
    """An ordinal variable, whose ordered categories are terms: ISCED's levels of education.

    A group covers consecutive categories, such as `at least`, `at most` and `between`.
    """

    numbered_from: int | None = None
    """Number of the first category if they are commonly numbered; values may then be numbers."""
    level: Literal[Level.ORDINAL] = field(default=Level.ORDINAL, init=False)

    def __post_init__(self) -> None:
        NominalVariable.__post_init__(self)
        for name, group in self.groups.items():
            ranks = sorted(map(self.categories.index, group.members))
            if ranks and ranks != list(range(ranks[0], ranks[-1] + 1)):
                raise WrongValueError(
                    expected=f"a group {name} of consecutive categories: an order knows no other",
                    got=", ".join(self.categories[rank] for rank in ranks),
                )

    @property
    def first_number(self) -> int:
        """Number of the first category in a numeric column."""
        return self.numbered_from or 0

    @property
    def scale(self) -> OrdinalScale[str]:
        """The operations on its values."""
        return OrdinalScale(
            variable=self.name, check=self.check, level=self.level, rank=self.categories.index
        )

    def check(self, value: object) -> str:
        """Validate a user's value, by name or number, as one of the categories.

        Raises:
            InputError: It is not a category.
        """
        numbers = {} if self.numbered_from is None else dict(enumerate(self.categories, self.numbered_from))
        number = _whole(value)
        if number in numbers:
            return numbers[number]
        if number is not None and numbers:
            raise InputError(
                expected=f"{self.name} as a number from {min(numbers)} to {max(numbers)}, or a category",
                got=shown(value),
                remedy="Leave it out where it is not known.",
            )
        return NominalVariable.check(self, value)


def _whole(value: Any) -> int | None:
    """An integer, also if given as text or as 6.0; None for anything else."""
    try:
        return int(value) if not isinstance(value, bool) and float(value) == int(value) else None
    except (TypeError, ValueError, OverflowError):
        return None


Variable = NumericVariable | NominalVariable


def told_names(variables: Mapping[str, Variable]) -> frozenset[str]:
    """Names of all accepted inputs: variables, and facts from which variables are derived."""
    derivations = (variable.derived_from for variable in variables.values())
    return frozenset({*variables, *(one.fact for one in derivations if one)})
