"""What `comity explain` answers: why a value is what it is, and what would change it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from comity.answers.inference import GradedRuleAnswer, GradedShiftAnswer, Inputs, OffRuleAnswer, ValueAnswer
from comity.answers.wording import WordingAnswer
from comity_fis.explanation.removal import Without
from comity_fis.inference.value import Origin
from comity_fis.record import Record


@dataclass(frozen=True, slots=True, kw_only=True)
class SourcedRuleAnswer(GradedRuleAnswer):
    """A rule that fired, what it did, and how far it can be trusted."""

    terms: tuple[str, ...]
    """What it gives the parameter."""
    share: float | None
    """Of the output set's area, or of the strengths of a Sugeno system; null if nominal."""
    contribution: float | None
    """In the unit; they add up to what the value set out from. Null if nominal."""
    without: Without
    """If the rulebook did not have this rule."""


@dataclass(frozen=True, slots=True, kw_only=True)
class RuleStrengthAnswer(Record):
    """A rule and how far it holds."""

    number: int
    strength: float


@dataclass(frozen=True, slots=True, kw_only=True)
class CategoryAnswer(Record):
    """One value that a nominal parameter could have."""

    category: str
    desirability: float
    permitted: bool
    requires: str | None
    """What must hold before it is permitted."""
    rules: tuple[RuleStrengthAnswer, ...]
    """Those that speak for it, strongest first."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ReadAnswer(Record):
    """Another parameter that the rules read."""

    parameter: str
    value: float | str
    unit: str | None
    origin: Origin


@dataclass(frozen=True, slots=True, kw_only=True)
class DerivativeAnswer(Record):
    """How the value answers to a small change of one number, in its unit per unit of the input."""

    input: str
    at: float
    unit: str | None
    """Of the input."""
    derivative: float | None
    """Null at a kink, where the sides differ, or at a jump."""
    below: float | None
    """From smaller values; null at the domain's end or at a jump."""
    above: float | None
    """From larger values; null at the domain's end or at a jump."""
    kink: bool
    jumps: tuple[Literal["below", "above"], ...]
    flat: bool
    flat_over: tuple[float, float] | None
    """Where around `at` the value stays the same."""


@dataclass(frozen=True, slots=True, kw_only=True)
class AlternativeInputAnswer(Record):
    """What one other statement about the person would give."""

    input: str
    now: float | str | None
    """Null: not disclosed."""
    given: float | tuple[str, ...]
    """A number, or all categories that give the same."""
    value: float | str
    origin: Origin
    leading: tuple[str, ...]
    flips: bool
    """Whether something else leads then."""


@dataclass(frozen=True, slots=True, kw_only=True)
class FlipAnswer(Record):
    """The nearest number of an input at which something else leads."""

    input: str
    now: float
    to: float
    change: float
    """Relative to the input's range."""
    leading: tuple[str, ...]
    """Empty where no rule fires any more."""
    value: float | str


@dataclass(frozen=True, slots=True, kw_only=True)
class ExplainAnswer(ValueAnswer):
    """`comity explain --json`."""

    rulebook: str
    parameter: str
    inputs: Inputs
    """Null: not disclosed. Two numbers: anything between them."""
    shift: GradedShiftAnswer | None = None
    """Null where the situation moves nothing."""
    leading: tuple[str, ...]
    """What the strongest rules give; several where they tie."""
    rules: tuple[SourcedRuleAnswer, ...]
    off: tuple[OffRuleAnswer, ...]
    """Rules about it that are off: they were not asked."""
    categories: tuple[CategoryAnswer, ...]
    """Of a nominal parameter."""
    reads: tuple[ReadAnswer, ...]
    derivatives: tuple[DerivativeAnswer, ...]
    alternatives: tuple[AlternativeInputAnswer, ...]
    flips: tuple[FlipAnswer, ...]
    """Smallest change first."""
    without_setting: Without | None
    """Null where the person asked for nothing."""
    notes: tuple[str, ...] = ()
    """About the inputs, such as a missing score."""
    wordings: tuple[WordingAnswer, ...] = ()
    """Of a parameter of the words: what the robot says to such a person."""
    by_culture: tuple[ExplainedPartAnswer, ...] = ()
    """Of several cultures: each explained by itself, and no rules above."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ExplainedPartAnswer(Record):
    """What one of several cultures gives."""

    name: str
    share: float
    explanation: ExplainAnswer
