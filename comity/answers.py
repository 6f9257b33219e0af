"""The shape of every `--json` answer; `comity schema` prints these as JSON schemas."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Literal

from pydantic import BaseModel, ConfigDict, Field

from comity_fis.value import Origin

Outcome = Literal["success", "partial", "failed", "stopped"]
Halt = Literal["preempted", "timed_out", "achieved_early", "parent_ended", "emergency"]


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


class ParameterAnswer(Answer):
    """The value of one parameter for one person."""

    value: float | str
    unit: str | None
    spread: float | None = Field(description="Standard deviation of people around the value, in the unit.")
    origin: Origin
    contributions: tuple[ContributionAnswer, ...]
    rules: tuple[FiredRuleAnswer, ...]
    desirability: Mapping[str, float] | None = Field(description="By category; null for a numeric parameter.")
    note: str


class InferAnswer(Answer):
    """`comity infer --json`."""

    rulebook: str
    mode: Literal["exact", "matlab", "skfuzzy"]
    inputs: Mapping[str, float | str | None] = Field(description="Null: not disclosed.")
    parameters: Mapping[str, ParameterAnswer]


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


class SourcedRuleAnswer(FiredRuleAnswer):
    """A rule that fired, and how far it can be trusted."""

    source: str
    evidence: str
    counter_evidence: str | None


class ExplainAnswer(ParameterAnswer):
    """`comity explain --json`."""

    rulebook: str
    parameter: str
    inputs: Mapping[str, float | str | None]
    rules: tuple[SourcedRuleAnswer, ...]


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


class TraceAnswer(Answer):
    """`comity trace --json`."""

    episode: str
    events: tuple[EventAnswer, ...]
