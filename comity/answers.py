"""The shape of every `--json` answer; `comity schema` prints these as JSON schemas."""

from __future__ import annotations

from collections.abc import Mapping
from datetime import date
from typing import Annotated, Literal

from pydantic import BaseModel, ConfigDict, Field

from comity_fis.signal import Signal
from comity_fis.value import Origin

Outcome = Literal["success", "partial", "failed", "stopped"]
Halt = Literal["preempted", "timed_out", "achieved_early", "parent_ended", "emergency"]


class Answer(BaseModel):
    """The base of all answers: frozen, and no key that is not declared here."""

    model_config = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False)


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


class ProfileAnswer(Answer):
    """`comity profile show --json`."""

    name: str
    place: Literal["shipped", "kept", "file"]
    file: str
    at: date | None = Field(description="The day of the facts; null where none depends on it.")
    declared: Mapping[str, object] = Field(description="The profile as it is written.")
    learnt: Mapping[str, object] | None = Field(description="What meetings taught, as it is kept.")
    rulebook: str
    inputs: Inputs
    notes: tuple[str, ...]
    parameters: Mapping[str, ShownValueAnswer]


class YearValueAnswer(Answer):
    """A parameter in one year."""

    value: float | str
    unit: str | None
    spread: float | None
    origin: Origin


class YearAnswer(Answer):
    """The end of one year of a life."""

    at: date
    changed: tuple[str, ...] = Field(description="Facts that are others than a year before.")
    inputs: Inputs
    parameters: Mapping[str, YearValueAnswer]


class LifeAnswer(Answer):
    """`comity profile show --years --json`."""

    name: str
    rulebook: str
    years: tuple[YearAnswer, ...]
    picture: str | None


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
    notes: tuple[str, ...] = Field(default=(), description="About the inputs, such as a missing score.")
    by_culture: tuple[ExplainedPartAnswer, ...] = Field(
        default=(), description="Of several cultures: each explained by itself, and no rules above."
    )


class ExplainedPartAnswer(Answer):
    """What one of several cultures gives."""

    name: str
    share: float
    explanation: ExplainAnswer


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
    because: str = Field(description="Its desirability and the rule behind that.")


class RuledOutAnswer(Answer):
    """A way to do a step that is not open at any cost."""

    arguments: tuple[str, ...]
    reason: str


class WhyAnswer(Answer):
    """Why a step is done this way."""

    text: str
    alternatives: tuple[AlternativeAnswer, ...]
    ruled_out: tuple[RuledOutAnswer, ...]


class StepAnswer(Answer):
    """One action of the plan."""

    action: str
    arguments: tuple[str, ...]
    people: tuple[str, ...] = Field(description="Whom it serves: several where a group is greeted at once.")
    parameters: Mapping[str, float | str]
    contributions: Mapping[str, tuple[ContributionAnswer, ...]] = Field(
        default={},
        description="By parameter that a rulebook decides: what suits best whom the robot stands before, and "
        "what that is made of. The word that is planned may be another one, for the moment or the price.",
    )
    cost: int
    cost_parts: Mapping[str, int] = Field(
        description="`travel`, `side`; or `greeting`, `nearness` of others, `waiting` of who has a priority; "
        "or `farewell`, or `skip`."
    )
    origin: tuple[str, str] | None = Field(alias="from", description="Place and side that the robot leaves.")
    start_s: float | None = Field(default=None, description="Null where the plan is a mere order.")
    duration_s: float | None = None
    why: WhyAnswer


class UnreachableAnswer(Answer):
    """Somebody whom no plan can visit."""

    person: str
    reason: str


class OwnDomainAnswer(Answer):
    """What `comity plan --domain` planned."""

    domain: str
    problem: str
    cost_scale: int = Field(description="A cost of so much is 1 of the domain's own.")
    people: tuple[str, ...] = Field(description="Objects whose parameters were inferred from a profile.")
    renamed: Mapping[str, str] = Field(description="Names that the files of `--pddl` could not keep.")
    files: tuple[str, ...]


class ConditionAnswer(Answer):
    """Something that stands in the way of a goal."""

    kind: Literal["hands", "noise", "consent", "setting", "side", "door", "deadline"]
    name: str = Field(description="What of that kind.")
    text: str


class UnmetAnswer(Answer):
    """A goal that no plan meets."""

    person: str
    reason: str
    conditions: tuple[ConditionAnswer, ...] = Field(
        description="Without any one of them the goal could be met; where `together`, without all of them."
    )
    together: bool


class NextInsteadAnswer(Answer):
    """Another person to go to at this step, all that follows being planned anew."""

    person: str
    extra_cost: int | None = Field(description="Null where a deadline or a route rules it out.")


class StepValueAnswer(Answer):
    """One parameter of a step for one person."""

    person: str
    parameter: str
    planned: float | str
    value: float | str = Field(description="What suits the person best; `planned` is what the step does.")
    unit: str | None
    contributions: tuple[ContributionAnswer, ...]
    because: str


class StepWhyAnswer(Answer):
    """`comity plan --why STEP`."""

    number: int
    step: StepAnswer
    values: tuple[StepValueAnswer, ...] = Field(
        description="Of each person whom the step serves, in the order of the parameters."
    )
    next_instead: tuple[NextInsteadAnswer, ...] = Field(
        description="Empty for a greeting, and beyond 12 people."
    )


class ParameterChangeAnswer(Answer):
    """A person's parameter that is another one."""

    person: str
    parameter: str
    before: float | str
    after: float | str
    unit: str | None
    because_before: str
    because_after: str


class ChoiceChangeAnswer(Answer):
    """A step that is done otherwise; null where it is not done."""

    person: str
    action: str
    before: tuple[str, ...] | None
    after: tuple[str, ...] | None
    because: str


class DiffAnswer(Answer):
    """`comity plan --as ... --diff`: against the scenario as it is written."""

    cost: tuple[int, int]
    order: tuple[tuple[str, ...], tuple[str, ...]] = Field(
        description="Whom the robot goes to, before and after."
    )
    parameters: tuple[ParameterChangeAnswer, ...]
    choices: tuple[ChoiceChangeAnswer, ...]


class PlanFlipAnswer(Answer):
    """A factor of the weights at which another plan is cheaper."""

    weight: Literal["side", "greeting", "both"]
    factor: float
    changes: tuple[str, ...] = Field(description="What that plan does otherwise.")


class StabilityAnswer(Answer):
    """How far the weights can change before another plan is cheaper."""

    lowest: float
    highest: float
    stable: bool = Field(description="Among the cheapest for every factor that was looked at.")
    flips: tuple[PlanFlipAnswer, ...] = Field(description="The nearest in each direction.")


class PlanAnswer(Answer):
    """`comity plan --json`."""

    scenario: str | None = Field(description="Null for a domain of the user's own.")
    own: OwnDomainAnswer | None = None
    solved: bool = Field(description="False where no plan meets the goals of those who can be served.")
    engine: str
    optimal: bool = Field(description="Proven: no plan for those who are visited costs less.")
    reproducible: bool
    cost: int = Field(description="In centimetres of metre-equivalents, or as `own.cost_scale` says.")
    bound: int = Field(description="No plan costs less; equal to the cost where the plan is optimal.")
    gap: float = Field(description="The share of the cost that a better plan could at most save.")
    steps: tuple[StepAnswer, ...]
    unreachable: tuple[UnreachableAnswer, ...] = Field(description="Whom no plan can serve.")
    unmet: tuple[UnmetAnswer, ...] = Field(description="Every goal that fails, with what stands in its way.")
    already: tuple[str, ...] = Field(description="Who was greeted before the start.")
    stability: StabilityAnswer | None = Field(
        default=None, description="With `--stability`, up to 12 people; null beyond."
    )
    why: StepWhyAnswer | None = Field(default=None, description="With `--why STEP`.")
    diff: DiffAnswer | None = Field(default=None, description="With `--diff`.")


PlanStatus = Literal["rebound", "replanned", "not_replanned"]
"""What becomes of a plan under way."""


class ActAnswer(Answer):
    """One utterance or gesture, as it was done."""

    act: str = Field(description="`utter`, a gesture's name, `pick_up` or `hand_over`.")
    start_s: float
    end_s: float = Field(description="When it ended, or was broken off.")
    text: str | None = Field(description="What was said; null for a gesture.")
    volume: float | None = Field(description="Of an utterance, 0 to 1.")
    rate: float | None = Field(description="Of an utterance, as a fraction of the normal rate.")
    amplitude: float | None = Field(description="Of a gesture, 0 to 1.")
    thing: str | None = Field(default=None, description="What was picked up or handed over.")
    stopped: bool = Field(description="Whether it was broken off.")


class DeedAnswer(Answer):
    """One thing on the agenda of a visit."""

    action: str
    arguments: tuple[str, ...]
    done_s: float | None = Field(description="When it was done; null where it was not.")


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
    agenda: tuple[DeedAnswer, ...] = Field(
        default=(), description="What was to be done after the greeting, in order."
    )
    acts: tuple[ActAnswer, ...] = Field(default=(), description="Everything that was said and done.")
    together_with: str | None = Field(
        default=None, description="Before whom the robot stood, where it greeted a group at once."
    )
    reason: str | None = Field(description="Why the visit did not succeed.")
    noticed: Signal | None = Field(
        default=None, description="How the person took it; null where the robot did not attend to that."
    )


class SettledAnswer(Answer):
    """A value and what it is made of."""

    value: float | str
    unit: str | None
    spread: float | None
    origin: Origin
    contributions: tuple[ContributionAnswer, ...]
    parts: tuple[PartAnswer, ...]
    note: str


class AskAnswer(Answer):
    """`comity profile ask --json`."""

    name: str
    parameter: Literal["conversational_distance"]
    answer_m: float | None = Field(description="Null where it was left open, or taken back with `unknown`.")
    counts_as: Literal["setting", "observation"] | None = Field(
        description="Null where the question was left open."
    )
    at: date = Field(description="The day of the answer.")
    situation: Mapping[str, str | float] = Field(description="In which an observation counts.")
    value: SettledAnswer | None = Field(description="How near the robot comes from now on, and why.")


class PersonAnswer(Answer):
    """One person's parameters in a run."""

    notes: tuple[str, ...]
    parameters: Mapping[str, SettledAnswer]


class RevisionAnswer(Answer):
    """What became of the plan while it was under way."""

    t: float
    kind: PlanStatus = Field(
        description="rebound: the same choices with new numbers; replanned: another plan; not_replanned: the "
        "tree failed and no other plan took over, or the planner broke down."
    )
    because: tuple[str, ...] = Field(description="What changed, how that is known, and the numbers.")
    cost: int | None = Field(default=None, description="Of the plan from then on; null where there is none.")
    steps: tuple[StepAnswer, ...] = Field(default=(), description="What is left to do from then on.")
    unserved: Mapping[str, str] = Field(
        default={}, description="Who is left and cannot be served as things stand, and why."
    )


class DoorTurnAnswer(Answer):
    """A door that was opened or shut."""

    t: float
    door: str
    open: bool = Field(description="From then on.")


class RunAnswer(Answer):
    """`comity run --json`, and `run.json` in the run folder."""

    status: Literal["running", "done", "crashed"]
    outcome: Outcome | None
    scenario: str
    rulebook: str
    profiles: Mapping[str, str]
    at: date | None = Field(default=None, description="The day of the facts; null where none depends on it.")
    seed: int
    episode: str
    reproduce: str
    trace_sha256: str | None
    fingerprint: str
    simulated_s: float
    visits: tuple[VisitAnswer, ...]
    values: Mapping[str, PersonAnswer] = Field(
        default={}, description="By person: the parameters and what each is made of."
    )
    metrics: Mapping[str, float] = Field(
        description="Of the episode; `comity metrics` says what each means. What has no value is left out."
    )
    figures: Mapping[str, Mapping[str, float]] = Field(
        default={}, description="By person: how the robot stopped before them, and kept its distance."
    )
    revisions: tuple[RevisionAnswer, ...] = Field(
        default=(), description="What became of the plan while it was under way, in order."
    )
    doors: tuple[DoorTurnAnswer, ...] = Field(
        default=(), description="Every door that was opened or shut while it was under way, in order."
    )
    bytes_per_minute: Mapping[str, int] = Field(
        default={}, description="Of the trace, the readings and the frames, per simulated minute, by file."
    )
    files: tuple[str, ...]
    error: str | None = None


class MeetingAnswer(Answer):
    """One of many visits to the same person."""

    visit: int = Field(description="From 1.")
    days: int = Field(description="Since the first.")
    distance_liked_m: float = Field(description="The middle of what the simulated person likes; hidden.")
    distance_model_m: float = Field(description="What culture and situation give.")
    interval_m: tuple[float, float] = Field(
        description="Where the robot believed the liked distance with 90 % probability, before the visit."
    )
    distance_wanted_m: float = Field(description="Where the robot wanted to stop.")
    distance_reached_m: float | None
    error_m: float | None = Field(description="Reached minus liked.")
    shown: Signal | None = Field(description="What the simulated person truly did.")
    noticed: Signal | None = Field(description="What the robot noticed.")


class VisitsAnswer(Answer):
    """`comity visits --json`."""

    profile: str
    rulebook: str
    seed: int
    every_days: int
    likes_m: tuple[float, float] = Field(description="The simulated person's comfort interval.")
    method: Literal["episodes"] = Field(description="Every visit was an episode in the world.")
    known_before: int = Field(description="Observations remembered from earlier meetings.")
    remembered_as: str | None = Field(
        description="The name in the store, where --keep wrote it there; else null."
    )
    days_to_come: int = Field(description="Visits that were simulated on days after today.")
    visits: tuple[MeetingAnswer, ...]


class DrawAnswer(Answer):
    """What `comity draw` says."""

    file: str
    name: str
    kind: Literal["map", "scenario"]


class FigureAnswer(Answer):
    """One figure of a run."""

    run: str
    scenario: str
    rulebook: str
    seed: int
    person: str | None = Field(description="Null for a figure of the whole episode.")
    profile: str | None
    metric: str
    value: float
    unit: str = Field(description="1 for a share or a count.")


class DefinitionAnswer(Answer):
    """What a figure means."""

    unit: str
    means: str
    source: str


class MetricsAnswer(Answer):
    """`comity metrics --json`."""

    figures: tuple[FigureAnswer, ...] = Field(description="Run by run; what has no value is left out.")
    definitions: Mapping[str, DefinitionAnswer]


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
    status: Literal["running", "success", "failure", "halted"] | PlanStatus
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
    status: Literal["running", "done", "crashed"]
    bytes_per_minute: Mapping[str, int] = Field(
        default={}, description="Of a run that is done: the trace, the readings and the frames, by file."
    )
    events: tuple[EventAnswer, ...]
    why: tuple[ReasonAnswer, ...] | None = Field(default=None, description="With --why.")
    differences: tuple[DifferenceAnswer, ...] | None = Field(
        default=None, description="With --diff: the first in numbers, and the first in what was done."
    )
