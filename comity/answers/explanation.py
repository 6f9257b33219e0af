"""What `comity explain` answers: why a value is what it is, and what would change it."""

from __future__ import annotations

from typing import Literal

from pydantic import Field

from comity.answers.base import Answer
from comity.answers.inference import (
    GradedRuleAnswer,
    GradedShiftAnswer,
    Inputs,
    OffRuleAnswer,
    OtherwiseAnswer,
    ValueAnswer,
)
from comity.answers.wording import WordingAnswer
from comity_fis.inference.value import Origin


class SourcedRuleAnswer(GradedRuleAnswer):
    """A rule that fired, what it did, and how far it can be trusted."""

    terms: tuple[str, ...] = Field(description="What it gives the parameter.")
    share: float | None = Field(
        description="Of the output set's area, or of the strengths of a Sugeno system; null if nominal."
    )
    contribution: float | None = Field(
        description="In the unit; they add up to what the value set out from. Null if nominal."
    )
    without: OtherwiseAnswer = Field(description="If the rulebook did not have this rule.")


class RuleStrengthAnswer(Answer):
    """A rule and how far it holds."""

    number: int
    strength: float


class CategoryAnswer(Answer):
    """One value that a nominal parameter could have."""

    category: str
    desirability: float
    permitted: bool
    requires: str | None = Field(description="What must hold before it is permitted.")
    rules: tuple[RuleStrengthAnswer, ...] = Field(description="Those that speak for it, strongest first.")


class ReadAnswer(Answer):
    """Another parameter that the rules read."""

    parameter: str
    value: float | str
    unit: str | None
    origin: Origin


class DerivativeAnswer(Answer):
    """How the value answers to a small change of one number, in its unit per unit of the input."""

    input: str
    at: float
    unit: str | None = Field(description="Of the input.")
    derivative: float | None = Field(description="Null at a kink, where the sides differ, or at a jump.")
    below: float | None = Field(description="From smaller values; null at the domain's end or at a jump.")
    above: float | None = Field(description="From larger values; null at the domain's end or at a jump.")
    kink: bool
    jumps: tuple[Literal["below", "above"], ...]
    flat: bool
    flat_over: tuple[float, float] | None = Field(description="Where around `at` the value stays the same.")


class AlternativeInputAnswer(Answer):
    """What one other statement about the person would give."""

    input: str
    now: float | str | None = Field(description="Null: not disclosed.")
    given: float | tuple[str, ...] = Field(description="A number, or all categories that give the same.")
    value: float | str
    origin: Origin
    leading: tuple[str, ...]
    flips: bool = Field(description="Whether something else leads then.")


class FlipAnswer(Answer):
    """The nearest number of an input at which something else leads."""

    input: str
    now: float
    to: float
    change: float = Field(description="Relative to the input's range.")
    leading: tuple[str, ...] = Field(description="Empty where no rule fires any more.")
    value: float | str


class ExplainAnswer(ValueAnswer):
    """`comity explain --json`."""

    rulebook: str
    parameter: str
    inputs: Inputs
    shift: GradedShiftAnswer | None = Field(
        default=None, description="Null where the situation moves nothing."
    )
    leading: tuple[str, ...] = Field(description="What the strongest rules give; several where they tie.")
    rules: tuple[SourcedRuleAnswer, ...]
    off: tuple[OffRuleAnswer, ...] = Field(description="Rules about it that are off: they were not asked.")
    categories: tuple[CategoryAnswer, ...] = Field(description="Of a nominal parameter.")
    reads: tuple[ReadAnswer, ...]
    derivatives: tuple[DerivativeAnswer, ...]
    alternatives: tuple[AlternativeInputAnswer, ...]
    flips: tuple[FlipAnswer, ...] = Field(description="Smallest change first.")
    without_setting: OtherwiseAnswer | None = Field(description="Null where the person asked for nothing.")
    notes: tuple[str, ...] = Field(default=(), description="About the inputs, such as a missing score.")
    wordings: tuple[WordingAnswer, ...] = Field(
        default=(), description="Of a parameter of the words: what the robot says to such a person."
    )
    by_culture: tuple[ExplainedPartAnswer, ...] = Field(
        default=(), description="Of several cultures: each explained by itself, and no rules above."
    )


class ExplainedPartAnswer(Answer):
    """What one of several cultures gives."""

    name: str
    share: float
    explanation: ExplainAnswer
