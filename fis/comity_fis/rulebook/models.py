"""Schema of a rulebook file: the keys and their types.

References between parts are checked when the rulebook is built from the models (`rulebook_file`).
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from math import inf
from typing import Annotated, Literal, NamedTuple

from pydantic import (
    AfterValidator,
    BaseModel,
    BeforeValidator,
    ConfigDict,
    Discriminator,
    Field,
    StringConstraints,
    Tag,
    ValidationInfo,
    field_validator,
    model_validator,
)

from comity_fis.errors import MOST_NAMED, WrongValueError, closest
from comity_fis.listing import listed
from comity_fis.membership.function import (
    Bump,
    Categories,
    Complement,
    NumericMembership,
    Singleton,
    Trapezoid,
    TwoTermGaussian,
)
from comity_fis.membership.interval import Interval
from comity_fis.rulebook.curved_models import MatlabShapesModel
from comity_fis.rules.methods import (
    Aggregation,
    Conjunction,
    Defuzzification,
    Disjunction,
    Implication,
    Methods,
)
from comity_fis.rules.rule import Condition, Evidence, Source
from comity_fis.scores.population_table import Population, PopulationTable, Score
from comity_fis.scores.shipped import INDIVIDUALISM
from comity_fis.variables.measurement import Coercion, Level
from comity_fis.variables.parameter import Category, NominalParameter, NumericParameter
from comity_fis.variables.shift import Shift
from comity_fis.variables.variable import (
    Derivation,
    NominalVariable,
    NumericVariable,
    OrdinalVariable,
    Partition,
    Shapes,
)

LARGEST = 1e12
"""Maximum magnitude of any number: above any quantity a robot meets, with a cube far from overflow."""

MAX_RULES = 20_000
MAX_NAMES = 1_000
"""Maximum number of variables, of parameters, and of categories."""

MAX_TERMS = 100
"""Maximum number of terms of a numeric variable or parameter."""

Number = Annotated[float, Field(strict=True, allow_inf_nan=False, ge=-LARGEST, le=LARGEST)]
Words = Annotated[str, StringConstraints(min_length=1, strip_whitespace=True)]


def _plain(name: object) -> object:
    if isinstance(name, str) and not re.match(NAME_PATTERN, name):
        raise WrongValueError(
            expected="a name without quotes, line breaks, or spaces at its ends",
            got=repr(name),
            remedy="Write at least one character, and leave these out.",
        )
    return name


NAME_PATTERN = r"^[^'\"\s]([^'\"\n\r]*[^'\"\s])?$"
LONGEST_NAME = 80
Name = Annotated[
    str, BeforeValidator(_plain), StringConstraints(pattern=NAME_PATTERN, max_length=LONGEST_NAME)
]
"""Names that are not plain words are quoted in rules, so they may contain spaces but no quotes."""


def _fits(build: Callable[[list[float]], object]) -> AfterValidator:
    """Let the record built from the numbers validate them."""

    def checked(numbers: list[float]) -> list[float]:
        build(numbers)
        return numbers

    return AfterValidator(checked)


Ends = Annotated[list[Number], Field(min_length=2, max_length=2), _fits(lambda ends: Interval(*ends))]
Corners = Annotated[
    list[Number], Field(min_length=4, max_length=4), _fits(lambda corners: Trapezoid(*corners))
]
BumpNumbers = Annotated[
    list[Number], Field(min_length=3, max_length=3), _fits(lambda numbers: Bump(*numbers))
]


class _Model(BaseModel):
    model_config = ConfigDict(extra="forbid", frozen=True)


class TermModel(MatlabShapesModel):
    """One membership function: exactly one of the shapes."""

    trapezoid: Corners | None = None
    two_term_gaussian: Annotated[list[BumpNumbers], Field(min_length=2, max_length=2)] | None = None
    """Two bumps: height, centre and width of each."""
    singleton: Number | None = None
    """The one value with degree 1."""
    complement: TermModel | None = None
    """1 minus another shape."""

    @model_validator(mode="after")
    def _one_shape(self) -> TermModel:
        shapes = [name for name in type(self).model_fields if getattr(self, name) is not None]
        if len(shapes) != 1:
            raise WrongValueError(
                expected="one shape, such as trapezoid or two_term_gaussian",
                got=listed(shapes) or "none",
            )
        return self

    def build(self) -> NumericMembership:
        """The membership function."""
        if self.trapezoid is not None:
            return Trapezoid(*self.trapezoid)
        if self.two_term_gaussian is not None:
            first, second = self.two_term_gaussian
            return TwoTermGaussian(Bump(*first), Bump(*second))
        if self.singleton is not None:
            return Singleton(self.singleton)
        return Complement(self.complement.build()) if self.complement else self.curved()


class CoercionModel(_Model):
    """A declared treatment of a variable at a higher level of measurement."""

    to: Literal["interval", "ratio"]
    reason: Words

    def build(self) -> Coercion:
        """The coercion."""
        return Coercion(Level[self.to.upper()], self.reason)


TableName = Annotated[str, StringConstraints(min_length=1, max_length=1000)]
"""`individualism`, or the path of a CSV file."""


class Tables(NamedTuple):
    """The tables that one variable names, loaded."""

    scores: PopulationTable[Score] | None = None
    """The scores that the variable is derived from."""
    populations: PopulationTable[Population] | None = None
    """The populations that are its categories."""


NO_TABLES = Tables()


class DerivationModel(_Model):
    """How a value is derived if the profile does not state it."""

    fact: Name
    table: TableName | None = Field(
        None,
        description="The table that gives a culture its score: individualism, or a CSV file with a column "
        "country, relative to this file. None: the fact itself, under another name.",
    )
    column: Words | None = Field(
        None,
        description="The heading of the scores in a CSV file; None: the only one, or the variable's.",
    )

    @model_validator(mode="after")
    def _column_of_a_file(self) -> DerivationModel:
        if self.column is not None and self.table in (None, INDIVIDUALISM):
            raise WrongValueError(
                expected="`column` beside a CSV file as `table`",
                got=f"table {self.table}" if self.table else "no table",
                remedy="Name the file, or leave `column` out.",
            )
        return self

    def build(self, table: PopulationTable[Score] | None) -> Derivation:
        """The derivation."""
        return Derivation(self.fact, table)


class PartitionModel(_Model):
    """How terms were obtained from data."""

    data: Words
    radius: Number
    centres: list[Number]
    squared_errors: list[Number]
    method: Words
    largest_errors: list[Number] = []
    held: dict[Name, Words] = {}

    def build(self) -> Partition:
        """The record of the partition."""
        return Partition(
            self.data,
            self.radius,
            tuple(self.centres),
            tuple(self.squared_errors),
            self.method,
            tuple(self.largest_errors),
            self.held,
        )


class _VariableModel(_Model):
    kind: Literal["culture", "situation"]
    derived_from: DerivationModel | None = None
    reason: Words
    """Reason for the domain and the terms: a source, or that it is our choice."""


class NumericVariableModel(_VariableModel):
    """A numeric variable."""

    level: Literal["ordinal", "interval", "ratio"]
    range: Ends
    unit: Words | None = None
    coercion: CoercionModel | None = None
    terms: Annotated[dict[Name, TermModel], Field(max_length=MAX_TERMS)]
    """Terms; empty if no rule reads the variable."""
    shapes: Shapes
    partition: PartitionModel | None = None

    def build(self, name: str, tables: Tables = NO_TABLES) -> NumericVariable:
        """The variable."""
        return NumericVariable(
            name=name,
            kind=self.kind,
            level=Level[self.level.upper()],
            domain=Interval(*self.range),
            terms={term: model.build() for term, model in self.terms.items()},
            unit=self.unit,
            coercion=self.coercion.build() if self.coercion else None,
            derived_from=self.derived_from.build(tables.scores) if self.derived_from else None,
            partition=self.partition.build() if self.partition else None,
            shapes=self.shapes,
            reason=self.reason,
        )


class NominalVariableModel(_VariableModel):
    """A nominal variable."""

    level: Literal["nominal"]
    categories: Annotated[list[Name], Field(max_length=MAX_NAMES)] = []
    categories_from: TableName | None = Field(
        None, description="A table whose countries and regions are categories: as for derived_from."
    )
    groups: dict[Name, list[Name]] = {}

    def build(self, name: str, tables: Tables = NO_TABLES) -> NominalVariable:
        """The variable."""
        rows = tables.populations.rows if tables.populations else ()
        variable = NominalVariable(
            name=name,
            kind=self.kind,
            categories=(*self.categories, *(row.key for row in rows)),
            groups={group: Categories(frozenset(members)) for group, members in self.groups.items()},
            labels={row.key: row.name for row in rows if row.key != row.name},
            table=tables.populations,
            derived_from=self.derived_from.build(tables.scores) if self.derived_from else None,
            reason=self.reason,
        )
        grouped = [member for members in self.groups.values() for member in members]
        return variable.naming(grouped) if variable.tells_culture else variable


class OrdinalVariableModel(_VariableModel):
    """An ordinal variable."""

    level: Literal["ordinal"]
    categories: list[Name]
    """Categories from first to last."""
    numbered_from: Annotated[int, Field(strict=True)] | None = None
    """Number of the first category, if they are commonly numbered."""
    groups: dict[Name, Annotated[list[Name], Field(min_length=1)]] = {}
    """Terms that cover several consecutive categories."""

    def build(self, name: str, tables: Tables = NO_TABLES) -> OrdinalVariable:
        """The variable."""
        return OrdinalVariable(
            name=name,
            kind=self.kind,
            categories=tuple(self.categories),
            groups={group: Categories(frozenset(members)) for group, members in self.groups.items()},
            numbered_from=self.numbered_from,
            derived_from=self.derived_from.build(tables.scores) if self.derived_from else None,
            reason=self.reason,
        )


def _form(written: object) -> str | None:
    """Selects the model of a variable: ordinal values may be words, or numbers coerced to a higher level."""
    if not isinstance(written, Mapping) or "level" not in written:
        return None
    if written["level"] in ("interval", "ratio") or written.keys() & {"range", "terms"}:
        return "interval"
    return "ordinal" if written["level"] == "ordinal" else "nominal"


VariableModel = Annotated[
    Annotated[NumericVariableModel, Tag("interval")]
    | Annotated[OrdinalVariableModel, Tag("ordinal")]
    | Annotated[NominalVariableModel, Tag("nominal")],
    Discriminator(
        _form,
        custom_error_type="no_level",
        custom_error_message="Variable should have a level",
    ),
]


class SafeModel(_Model):
    """Safety limits; a missing end sets no limit."""

    at_least: Number | None = None
    at_most: Number | None = None

    def build(self) -> Interval:
        """The limits."""
        low = -inf if self.at_least is None else self.at_least
        return Interval(low, inf if self.at_most is None else self.at_most)


class ShiftModel(_Model):
    """How far the situation may shift a parameter, as linguistic terms."""

    range: Ends
    terms: Annotated[dict[Name, TermModel], Field(min_length=1, max_length=MAX_TERMS)]
    shapes: Shapes
    reason: Words

    def build(self) -> Shift:
        """The shift."""
        return Shift(
            range=Interval(*self.range),
            terms={term: model.build() for term, model in self.terms.items()},
            shapes=self.shapes,
            reason=self.reason,
        )


class NumericReasons(_Model):
    """Reason for these numbers: a source, or that they are our choice."""

    ranges: Words
    terms: Words
    neutral: Words
    spread: Words


class NumericParameterModel(_Model):
    """A numeric parameter."""

    kind: Literal["action", "behaviour"]
    level: Literal["interval", "ratio"]
    unit: Words
    measured: Literal["surface", "centre"] | None = None
    rules: Ends
    ask: Ends
    safe: SafeModel = SafeModel()
    terms: Annotated[dict[Name, TermModel], Field(max_length=MAX_TERMS)]
    """Terms; empty if no rule concludes the parameter."""
    shapes: Shapes
    neutral: Number
    spread: Number
    shift: ShiftModel | None = None
    """Shift by rules over situation variables."""
    reasons: NumericReasons

    @field_validator("neutral")
    @classmethod
    def _in_range(cls, neutral: float, others: ValidationInfo) -> float:
        """Checked here as well as in the parameter, so that the error names this line."""
        rules = Interval(*others.data["rules"]) if "rules" in others.data else None
        if rules and neutral not in rules:
            raise WrongValueError(
                expected=f"a neutral value in the rules' range {rules}",
                got=f"{neutral:g}",
                remedy="Give a number in this range.",
            )
        return neutral

    def build(self, name: str) -> NumericParameter:
        """The parameter."""
        return NumericParameter(
            name=name,
            kind=self.kind,
            unit=self.unit,
            rules=Interval(*self.rules),
            ask=Interval(*self.ask),
            safe=self.safe.build(),
            terms={term: model.build() for term, model in self.terms.items()},
            neutral=self.neutral,
            spread=self.spread,
            measured=self.measured,
            shapes=self.shapes,
            shift=self.shift.build() if self.shift else None,
            reasons=self.reasons.model_dump(),
        )


class NominalReasons(_Model):
    """Reasons for these categories and the neutral one."""

    categories: Words
    neutral: Words


class NominalParameterModel(_Model):
    """A nominal parameter."""

    kind: Literal["action", "behaviour"]
    level: Literal["nominal"]
    categories: Annotated[list[Name], Field(min_length=1, max_length=MAX_NAMES)]
    requires: dict[Name, Words] = {}
    """Condition that must be known to hold before a category is permitted."""
    neutral: Name
    reasons: NominalReasons

    @field_validator("neutral", mode="before")
    @classmethod
    def _permitted(cls, neutral: object, others: ValidationInfo) -> object:
        """Checked here as well as in the parameter, so that the error names this line."""
        guarded = others.data.get("requires", {})
        known = [category for category in others.data.get("categories", ()) if category not in guarded]
        if known and neutral not in known:
            raise WrongValueError(
                expected=f"a neutral category that is always permitted ({', '.join(known[:MOST_NAMED])})",
                got=repr(neutral),
                remedy=closest(str(neutral), known),
            )
        return neutral

    def build(self, name: str, guards: Mapping[str, Condition]) -> NominalParameter:
        """The parameter; `guards` are the conditions in `requires`, parsed."""
        return NominalParameter(
            name=name,
            kind=self.kind,
            categories=tuple(Category(category, guards.get(category)) for category in self.categories),
            neutral=self.neutral,
            reasons=self.reasons.model_dump(),
        )


class SourceModel(_Model):
    """A publication or a decision that rules are based on."""

    citation: Words
    verified: Words
    found: Words | None = None
    """The finding."""
    measured: Words | None = None
    """How it was measured, and with which participants."""

    def build(self, key: str) -> Source:
        """The source."""
        return Source(key, self.citation, self.verified, self.found or "", self.measured or "")


class RuleModel(_Model):
    """One rule with its evidence."""

    rule: Words
    sources: Annotated[list[Name], Field(min_length=1)]
    evidence: Evidence
    counter_evidence: Words | None = None
    note: Words | None = None
    weight: Annotated[Number, Field(gt=0, le=1)] = 1.0
    """Factor on the firing strength of the rule, in (0, 1]."""
    enabled: Annotated[bool, Field(strict=True)] = True
    """False: the rule is documented but has no effect."""
    finding: Name | None = None
    """Key of the finding that the rule states."""


class MethodsModel(_Model):
    """Inference methods, with MATLAB's names."""

    conjunction: Conjunction = "min"
    disjunction: Disjunction = "max"
    implication: Implication = "min"
    aggregation: Aggregation = "max"
    defuzzification: Defuzzification = "centroid"

    def build(self) -> Methods:
        """The methods."""
        return Methods(**self.model_dump())


class RulebookModel(_Model):
    """One rulebook."""

    schema_version: Literal[1]
    name: Name
    description: Words
    sources: Annotated[dict[Name, SourceModel], Field(min_length=1)]
    variables: Annotated[dict[Name, VariableModel], Field(min_length=1, max_length=MAX_NAMES)]
    parameters: Annotated[
        dict[Name, Annotated[NumericParameterModel | NominalParameterModel, Field(discriminator="level")]],
        Field(min_length=1, max_length=MAX_NAMES),
    ]
    methods: MethodsModel = MethodsModel()
    rules: Annotated[list[RuleModel], Field(min_length=1, max_length=MAX_RULES)]
