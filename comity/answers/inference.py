"""What `comity infer` and `comity convert` answer: values, and what each is made of."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from datetime import date
from typing import Literal

from comity_fis.inference.value import Contribution, Origin, PartValue
from comity_fis.record import Record

Fact = float | str | tuple[float, float] | Mapping[str, float] | None


@dataclass(frozen=True, slots=True, kw_only=True)
class FactPartAnswer(Record):
    """A fact in one of several cultures."""

    part: str
    share: float
    value: Fact


@dataclass(frozen=True, slots=True, kw_only=True)
class MixedFactAnswer(Record):
    """A fact that differs between the cultures of one person."""

    mixed: tuple[FactPartAnswer, ...]


Inputs = Mapping[str, Fact | MixedFactAnswer]
"""Null: not disclosed. Two numbers: anything between them."""


@dataclass(frozen=True, slots=True, kw_only=True)
class FiredRuleAnswer(Record):
    """A rule that fired."""

    number: int
    rule: str
    strength: float


@dataclass(frozen=True, slots=True, kw_only=True)
class ShiftAnswer(Record):
    """By how much the situation moved a value."""

    value: float
    """In the parameter's unit."""
    rules: tuple[FiredRuleAnswer, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class ValueAnswer(Record):
    """The value of one parameter for one person."""

    value: float | str
    unit: str | None
    spread: float | None
    """Standard deviation of people around the value, in the unit."""
    origin: Origin
    contributions: tuple[Contribution, ...]
    desirability: Mapping[str, float] | None
    """By category; null for a numeric parameter."""
    curve: tuple[tuple[float, float], ...] | None = None
    """Desirability over a numeric parameter's range: points that lines join."""
    note: str
    parts: tuple[PartValue, ...] = ()
    """Of several cultures: what each alone would give, where that differs."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ParameterAnswer(ValueAnswer):
    """The same with the rules that fired, as one of many."""

    rules: tuple[FiredRuleAnswer, ...]
    shift: ShiftAnswer | None = None
    """Null where the situation moves nothing."""


@dataclass(frozen=True, slots=True, kw_only=True)
class CoercionAnswer(Record):
    """A variable that is used above its own level of measurement."""

    to: Literal["interval", "ratio"]
    reason: str


@dataclass(frozen=True, slots=True, kw_only=True)
class InferAnswer(Record):
    """`comity infer --json`."""

    rulebook: str
    mode: Literal["exact", "matlab", "skfuzzy"]
    inputs: Inputs
    """Null: not disclosed. Two numbers: anything between them."""
    parameters: Mapping[str, ParameterAnswer]
    coercions: Mapping[str, CoercionAnswer] = field(default_factory=dict)
    """By variable, as the rulebook declares them."""
    notes: tuple[str, ...] = ()
    """About the inputs, such as a missing score."""
    at: date | None = None
    """The day of the facts; null where none depends on it."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ConvertAnswer(Record):
    """`comity convert --json`."""

    source: str
    file: str
    rulebook: str
    variables: int
    parameters: int
    rules: int
    """As written; a rule may become several."""
    changed: tuple[str, ...]
    """What is there in another form, or was chosen."""
    lost: tuple[str, ...]
    """What the new file cannot say to a program."""
    inputs_tried: int
    largest_differences: Mapping[str, float]
    """By parameter, in its unit, between the rulebook and the file read back."""


@dataclass(frozen=True, slots=True, kw_only=True)
class GradeAnswer(Record):
    """How far a rule can be trusted."""

    source: str
    evidence: str
    counter_evidence: str | None


@dataclass(frozen=True, slots=True, kw_only=True)
class OffRuleAnswer(GradeAnswer):
    """A rule that is there to be read, and decides nothing."""

    number: int
    rule: str


@dataclass(frozen=True, slots=True, kw_only=True)
class GradedRuleAnswer(GradeAnswer):
    """A rule that fired, and how far it can be trusted."""

    number: int
    rule: str
    strength: float


@dataclass(frozen=True, slots=True, kw_only=True)
class GradedShiftAnswer(Record):
    """By how much the situation moved a value, and how far the rules that said so can be trusted."""

    value: float
    """In the parameter's unit."""
    rules: tuple[GradedRuleAnswer, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class ShownValueAnswer(ValueAnswer):
    """A value with the rules behind it."""

    rules: tuple[GradedRuleAnswer, ...]
    shift: GradedShiftAnswer | None
    """Null where the situation moves nothing."""


@dataclass(frozen=True, slots=True, kw_only=True)
class SettledAnswer(Record):
    """A value and what it is made of."""

    value: float | str
    unit: str | None
    spread: float | None
    origin: Origin
    contributions: tuple[Contribution, ...]
    parts: tuple[PartValue, ...]
    note: str
