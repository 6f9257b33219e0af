"""The shape of every `--json` answer; `comity schema` prints these as JSON schemas."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated, Literal

from pydantic import BaseModel, ConfigDict, Field

from comity_fis.value import Origin

Outcome = Literal["success", "partial", "failed", "stopped"]
Halt = Literal["preempted", "timed_out", "achieved_early", "parent_ended", "emergency"]


Inputs = Annotated[
    Mapping[str, float | str | tuple[float, float] | Mapping[str, float] | None],
    Field(description="Null: not disclosed. Two numbers: anything between them."),
]


class Answer(BaseModel):
    """The base of all answers: frozen, and no key that is not declared here."""

    model_config = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False)


class ContributionAnswer(Answer):
    """One step on the way to a value."""

    origin: Origin
    value: float | str = Field(description="The first one is the start, every further number a difference.")
    text: str


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
    shift: ShiftAnswer | None = Field(default=None, description="Null where the situation moves nothing.")
    note: str


class ParameterAnswer(ValueAnswer):
    """The same with the rules that fired, as one of many."""

    rules: tuple[FiredRuleAnswer, ...]


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


class GradedShiftAnswer(ShiftAnswer):
    """By how much the situation moved a value, and how far the rules that said so can be trusted."""

    rules: tuple[GradedRuleAnswer, ...]


class SourcedRuleAnswer(GradedRuleAnswer):
    """A rule that fired, what it did, and how far it can be trusted."""

    terms: tuple[str, ...] = Field(description="What it gives the parameter.")
    share: float | None = Field(description="Of the area of the output set; null for a nominal parameter.")
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


class ClusterCount(Answer):
    """How many clusters the data form."""

    radius: float = Field(description="Of the subtractive clustering, as a fraction of the data's range.")
    clusters: int


class FittedTermAnswer(Answer):
    """A term that data made."""

    centre: float
    squared_error: float = Field(description="Of the fit, summed over all values.")
    largest_error: float = Field(
        description="Off the degrees of c-means anywhere in the data's range, also between the values."
    )
    form: Literal["free", "held"] = Field(
        description="Free: the paper's fit to the values. Held: to one peak and heights of at most 1."
    )
    because: str | None = Field(description="What is wrong with the free fit; null where nothing is.")
    two_term_gaussian: tuple[tuple[float, float, float], ...] = Field(description="Height, centre, width.")


class FitAnswer(Answer):
    """`comity fit --json`."""

    file: str
    column: str
    values: int
    empty: int = Field(description="Cells that were skipped: empty, or NA.")
    low: float
    high: float
    radius: float
    clusters: tuple[ClusterCount, ...]
    radius_for_more: float | None = Field(description="The largest smaller radius with several clusters.")
    terms: Mapping[str, FittedTermAnswer] = Field(description="Empty where the data form one cluster.")
    variable: Mapping[str, object] | None = Field(description="As a rulebook file holds it.")
    files: tuple[str, ...]


class AlternativeAnswer(Answer):
    """Another way to do a step."""

    arguments: tuple[str, ...]
    extra_cost: int


class WhyAnswer(Answer):
    """Why a step is done this way."""

    text: str
    alternatives: tuple[AlternativeAnswer, ...]


class StepAnswer(Answer):
    """One action of the plan."""

    action: str
    arguments: tuple[str, ...]
    parameters: Mapping[str, float | str]
    cost: int
    origin: tuple[str, str] | None = Field(alias="from", description="Place and side that the robot leaves.")
    why: WhyAnswer


class UnreachableAnswer(Answer):
    """Somebody whom no plan can visit."""

    person: str
    reason: str


class PlanAnswer(Answer):
    """`comity plan --json`."""

    scenario: str
    engine: str
    optimal: bool
    reproducible: bool
    cost: int = Field(description="In centimetres of metre-equivalents.")
    steps: tuple[StepAnswer, ...]
    unreachable: tuple[UnreachableAnswer, ...]


class ActAnswer(Answer):
    """One utterance or gesture, as it was done."""

    act: str = Field(description="`utter` or a gesture's name.")
    start_s: float
    end_s: float = Field(description="When it ended, or was broken off.")
    text: str | None = Field(description="What was said; null for a gesture.")
    volume: float | None = Field(description="Of an utterance, 0 to 1.")
    rate: float | None = Field(description="Of an utterance, as a fraction of the normal rate.")
    amplitude: float | None = Field(description="Of a gesture, 0 to 1.")
    stopped: bool = Field(description="Whether it was broken off.")


class VisitAnswer(Answer):
    """What was wanted and what was reached at one person."""

    person: str
    profile: str
    outcome: str
    distance_wanted_m: float
    distance_reached_m: float | None = Field(description="Between the nearest points of the two bodies.")
    centre_distance_reached_m: float | None
    bearing_wanted_deg: float | None
    bearing_reached_deg: float | None
    facing_error_deg: float | None
    pose_free: bool | None = Field(
        description="Whether the wanted pose was free; null if the robot never chose one."
    )
    deviation_reason: str | None
    docked_at_s: float | None
    greeting: tuple[str, ...]
    acts: tuple[ActAnswer, ...] = Field(default=(), description="Everything that was said and done.")
    reason: str | None = Field(description="Why the visit did not succeed.")


class RunAnswer(Answer):
    """`comity run --json`, and `run.json` in the run folder."""

    status: Literal["running", "done", "crashed"]
    outcome: Outcome | None
    scenario: str
    rulebook: str
    profiles: Mapping[str, str]
    seed: int
    episode: str
    reproduce: str
    trace_sha256: str | None
    fingerprint: str
    simulated_s: float
    visits: tuple[VisitAnswer, ...]
    metrics: Mapping[str, float]
    files: tuple[str, ...]
    error: str | None = None


class CauseAnswer(Answer):
    """One link of the chain that ends in a cultural variable."""

    kind: str
    text: str
    value: float | str | None


class EventAnswer(Answer):
    """A node changed its status, or was halted."""

    t: float
    node: str
    path: int = Field(description="The node's place in the tree, in pre-order.")
    status: Literal["running", "success", "failure", "halted"]
    halt: Halt | None
    because: tuple[CauseAnswer, ...]


class ReasonAnswer(Answer):
    """Why a node is in its state."""

    event: EventAnswer = Field(description="What it did last.")
    switched_by: EventAnswer | None = Field(
        description="The leaf's result that led to it; null where the event has its own causes."
    )
    standing_on: tuple[EventAnswer, ...] = Field(
        description="Further results that have to stay as they are, the latest first."
    )
    because: tuple[CauseAnswer, ...] = Field(description="The chain of causes, nearest first.")


class DifferenceAnswer(Answer):
    """The first difference between two runs."""

    t: float
    in_behaviour: bool = Field(description="False where only the numbers behind the same event differ.")
    one: EventAnswer | None = Field(description="Null where that run had ended.")
    other: EventAnswer | None
    causes: tuple[tuple[CauseAnswer | None, CauseAnswer | None], ...] = Field(
        description="The links that differ, nearest first, side by side."
    )


class TraceAnswer(Answer):
    """`comity trace --json`."""

    episode: str
    events: tuple[EventAnswer, ...]
    why: tuple[ReasonAnswer, ...] | None = Field(default=None, description="With --why.")
    differences: tuple[DifferenceAnswer, ...] | None = Field(
        default=None, description="With --diff: the first in numbers, and the first in what was done."
    )
