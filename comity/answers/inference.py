"""What `comity infer` and `comity convert` answer: values, and what each is made of."""

from __future__ import annotations

from collections.abc import Mapping
from datetime import date
from typing import Annotated, Literal

from pydantic import Field

from comity.answers.base import Answer
from comity_fis.inference.value import Origin

Fact = float | str | tuple[float, float] | Mapping[str, float] | None


class FactPartAnswer(Answer):
    """A fact in one of several cultures."""

    part: str
    share: float
    value: Fact


class MixedFactAnswer(Answer):
    """A fact that differs between the cultures of one person."""

    mixed: tuple[FactPartAnswer, ...]


Inputs = Annotated[
    Mapping[str, Fact | MixedFactAnswer],
    Field(description="Null: not disclosed. Two numbers: anything between them."),
]


class ContributionAnswer(Answer):
    """One step on the way to a value."""

    origin: Origin
    value: float | str = Field(description="The first one is the start, every further number a difference.")
    text: str


class PartAnswer(Answer):
    """What one of several cultures alone would give."""

    name: str
    share: float = Field(description="Of the whole; the shares of all parts sum to 1.")
    value: float | str


class FiredRuleAnswer(Answer):
    """A rule that fired."""

    number: int
    rule: str
    strength: float


class ShiftAnswer(Answer):
    """By how much the situation moved a value."""

    value: float = Field(description="In the parameter's unit.")
    rules: tuple[FiredRuleAnswer, ...]


class ValueAnswer(Answer):
    """The value of one parameter for one person."""

    value: float | str
    unit: str | None
    spread: float | None = Field(description="Standard deviation of people around the value, in the unit.")
    origin: Origin
    contributions: tuple[ContributionAnswer, ...]
    desirability: Mapping[str, float] | None = Field(description="By category; null for a numeric parameter.")
    curve: tuple[tuple[float, float], ...] | None = Field(
        default=None,
        description="Desirability over a numeric parameter's range: points that lines join.",
    )
    note: str
    parts: tuple[PartAnswer, ...] = Field(
        default=(), description="Of several cultures: what each alone would give, where that differs."
    )


class ParameterAnswer(ValueAnswer):
    """The same with the rules that fired, as one of many."""

    rules: tuple[FiredRuleAnswer, ...]
    shift: ShiftAnswer | None = Field(default=None, description="Null where the situation moves nothing.")


class CoercionAnswer(Answer):
    """A variable that is used above its own level of measurement."""

    to: Literal["interval", "ratio"]
    reason: str


class InferAnswer(Answer):
    """`comity infer --json`."""

    rulebook: str
    mode: Literal["exact", "matlab", "skfuzzy"]
    inputs: Inputs
    parameters: Mapping[str, ParameterAnswer]
    coercions: Mapping[str, CoercionAnswer] = Field(
        default={}, description="By variable, as the rulebook declares them."
    )
    notes: tuple[str, ...] = Field(default=(), description="About the inputs, such as a missing score.")
    at: date | None = Field(default=None, description="The day of the facts; null where none depends on it.")


class OtherwiseAnswer(Answer):
    """What would stand under another condition."""

    value: float | str
    origin: Origin
    note: str


class ConvertAnswer(Answer):
    """`comity convert --json`."""

    source: str
    file: str
    rulebook: str
    variables: int
    parameters: int
    rules: int = Field(description="As written; a rule may become several.")
    changed: tuple[str, ...] = Field(description="What is there in another form, or was chosen.")
    lost: tuple[str, ...] = Field(description="What the new file cannot say to a program.")
    inputs_tried: int
    largest_differences: Mapping[str, float] = Field(
        description="By parameter, in its unit, between the rulebook and the file read back."
    )


class GradeAnswer(Answer):
    """How far a rule can be trusted."""

    source: str
    evidence: str
    counter_evidence: str | None


class OffRuleAnswer(GradeAnswer):
    """A rule that is there to be read, and decides nothing."""

    number: int
    rule: str


class GradedRuleAnswer(FiredRuleAnswer, GradeAnswer):
    """A rule that fired, and how far it can be trusted."""


class GradedShiftAnswer(Answer):
    """By how much the situation moved a value, and how far the rules that said so can be trusted."""

    value: float = Field(description="In the parameter's unit.")
    rules: tuple[GradedRuleAnswer, ...]


class ShownValueAnswer(ValueAnswer):
    """A value with the rules behind it."""

    rules: tuple[GradedRuleAnswer, ...]
    shift: GradedShiftAnswer | None = Field(description="Null where the situation moves nothing.")
