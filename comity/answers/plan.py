"""What `comity plan` answers: steps, their reasons, and what would be otherwise."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Literal

from comity_domain.classical.validation import Validation
from comity_domain.custom.forbidding import PlanWithout
from comity_domain.explanation.what_if import NextInstead
from comity_domain.plans.plan import Alternative, RuledOut
from comity_fis.inference.value import Contribution
from comity_fis.record import Record


@dataclass(frozen=True, slots=True, kw_only=True)
class WhyAnswer(Record):
    """Why a step is done this way."""

    text: str
    alternatives: tuple[Alternative, ...]
    ruled_out: tuple[RuledOut, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class StepAnswer(Record):
    """One action of the plan."""

    action: str
    arguments: tuple[str, ...]
    people: tuple[str, ...]
    """The people whom it serves: several where a group is greeted at once."""
    parameters: Mapping[str, float | str]
    contributions: Mapping[str, tuple[Contribution, ...]] = field(default_factory=dict)
    """By parameter that a rulebook decides: what suits the person the robot stands before, and what that is
    made of. The word that is planned may be another one, for the moment or the price."""
    other_parameters: Mapping[str, float | str] = field(default_factory=dict)
    """What else a rulebook decides for that person: a robot of the user's own receives it by these names,
    with each goal and act of the step."""
    cost: int | None
    """Null where the engine tells no costs."""
    cost_parts: Mapping[str, int]
    """`travel`, `side`; or `greeting`, `nearness` of others, `waiting` of who has a priority; or `farewell`,
    or `skip`. In a custom domain `domain`, and each option such as `?how`."""
    from_: tuple[str, str] | None
    """Place and side that the robot leaves."""
    start_s: float | None = None
    """Null where the plan is a mere order."""
    duration_s: float | None = None
    why: WhyAnswer


@dataclass(frozen=True, slots=True, kw_only=True)
class UnreachableAnswer(Record):
    """A person whom no plan can visit."""

    person: str
    reason: str


@dataclass(frozen=True, slots=True, kw_only=True)
class CustomDomainAnswer(Record):
    """What `comity plan --domain` planned."""

    domain: str
    problem: str
    cost_scale: int
    """A cost of so much is 1 of the domain's own."""
    people: tuple[str, ...]
    """Objects whose parameters were inferred from a profile."""
    renamed: Mapping[str, str]
    """Names that the files of `--pddl` could not keep."""
    files: tuple[str, ...]
    metric_ignored: bool = False
    """The engine did not look at the :metric: another plan may be better by it."""


@dataclass(frozen=True, slots=True)
class RelaxableCondition(Record):
    """Something that stands in the way of a goal."""

    kind: Literal["hands", "noise", "consent", "setting", "side", "door", "deadline", "gap"]
    name: str
    """What of that kind."""
    text: str


@dataclass(frozen=True, slots=True, kw_only=True)
class FailureAnswer(Record):
    """Why there is no plan."""

    reason: str
    remedy: str


@dataclass(frozen=True, slots=True)
class Unmet(Record):
    """A goal that no plan meets."""

    person: str
    reason: str
    conditions: tuple[RelaxableCondition, ...]
    """Without any one of them the goal could be met; where `together`, without all of them."""
    together: bool
    complete: bool = True
    """False where the search for the conditions was cut off: there may be others, or fewer would do."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ContrastAnswer(Record):
    """The best plan in which this person is reached from another side, all else replanned."""

    side: str
    extra_cost: int | None
    """Null where there is no such plan."""
    steps: tuple[str, ...]
    """Its steps, such as `Reach_user(robot, johanna, left)`."""


@dataclass(frozen=True, slots=True, kw_only=True)
class StepValueAnswer(Record):
    """One parameter of a step for one person."""

    person: str
    parameter: str
    planned: float | str
    value: float | str
    """What suits the person best; `planned` is what the step does."""
    unit: str | None
    contributions: tuple[Contribution, ...]
    because: str


@dataclass(frozen=True, slots=True, kw_only=True)
class SkippingAnswer(Record):
    """What leaving a person out is weighed against: ways that are computed alike for everybody."""

    price: int
    """What the scenario says that leaving them out costs, in cm."""
    serving: int | None
    """What the ways, priorities and prices of all others would cost more if they were served; null where no
    plan serves them."""
    reason: str | None
    """Why no plan serves them; null where one could."""


@dataclass(frozen=True, slots=True, kw_only=True)
class StepWhyAnswer(Record):
    """`comity plan --why STEP`."""

    number: int
    step: StepAnswer
    values: tuple[StepValueAnswer, ...]
    """Of each person whom the step serves, in the order of the parameters."""
    next_instead: tuple[NextInstead, ...]
    """Empty for a greeting, and beyond 12 people."""
    contrast: tuple[ContrastAnswer, ...] = ()
    """Of a `Reach_user`, up to 12 people; cheapest first."""
    skipping: SkippingAnswer | None = None
    """Of a `Skip_visit`."""
    without: PlanWithout | None = None
    """In a classical domain of the user's own."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ParameterChangeAnswer(Record):
    """A person's parameter that is another one."""

    person: str
    parameter: str
    before: float | str
    after: float | str
    unit: str | None
    because_before: str
    because_after: str


@dataclass(frozen=True, slots=True, kw_only=True)
class ChoiceChangeAnswer(Record):
    """A step that is done otherwise; null where it is not done."""

    person: str
    action: str
    before: tuple[str, ...] | None
    after: tuple[str, ...] | None
    because: str


@dataclass(frozen=True, slots=True, kw_only=True)
class CostPartChangeAnswer(Record):
    """One part of a step's cost that is another one."""

    part: str
    """As in `cost_parts`."""
    before: int
    after: int
    because: str


@dataclass(frozen=True, slots=True, kw_only=True)
class StepCostChangeAnswer(Record):
    """A step that costs more or less, or is in one of the two plans only."""

    action: str
    people: tuple[str, ...]
    before: tuple[str, ...] | None
    """Its arguments; null where it is not done."""
    after: tuple[str, ...] | None
    cost: tuple[int, int]
    """0 where it is not done."""
    parts: tuple[CostPartChangeAnswer, ...]
    """Those that differ: they add up to `cost`'s."""


@dataclass(frozen=True, slots=True, kw_only=True)
class DiffAnswer(Record):
    """`comity plan --as ... --diff`: against the scenario as it is written."""

    cost: tuple[int, int] | None
    """Null where the engine tells no costs."""
    order: tuple[tuple[str, ...], tuple[str, ...]]
    """People the robot goes to, before and after."""
    parameters: tuple[ParameterChangeAnswer, ...]
    choices: tuple[ChoiceChangeAnswer, ...]
    costs: tuple[StepCostChangeAnswer, ...]
    """All that is not as dear as before: the differences add up to that of `cost`."""


@dataclass(frozen=True, slots=True, kw_only=True)
class PlanFlipAnswer(Record):
    """A factor of the weights at which another plan is cheaper."""

    weight: str
    """`side`, `greeting` or `both`; in a custom domain an option, such as `greet ?how`, or `all`."""
    factor: float
    changes: tuple[str, ...]
    """What that plan does otherwise."""


@dataclass(frozen=True, slots=True, kw_only=True)
class StabilityAnswer(Record):
    """How far the weights can change before another plan is cheaper."""

    lowest: float
    highest: float
    stable: bool
    """Among the cheapest for every factor that was looked at."""
    flips: tuple[PlanFlipAnswer, ...]
    """The nearest in each direction."""
    exact: bool = True
    """False where a search was cut off: nearer ones may be."""


@dataclass(frozen=True, slots=True, kw_only=True)
class PlanAnswer(Record):
    """`comity plan --json`."""

    scenario: str | None
    """Null for a custom domain."""
    own: CustomDomainAnswer | None = None
    rulebook: str | None = None
    """Whose rules decide; null without a plan, and for a custom domain."""
    rulebook_reason: str | None = None
    """Why that one."""
    solved: bool
    """False where no plan meets the goals of those who can be served."""
    failure: FailureAnswer | None = None
    """Null where `solved`."""
    engine: str
    """`comity` for visits; the name that unified-planning has for the engine that solved a domain of the
    user's own; `none` where there is no plan."""
    optimal: bool
    """Proven: no plan for those who are visited costs less."""
    reproducible: bool
    """False where a limit of time or memory cut the search off, for a plan or for what stands in its way:
    another machine may find another answer."""
    killed: bool
    """The engine was killed from outside; the plan is the best that it had found by then."""
    cost: int | None
    """In centimetres of metre-equivalents, or as `own.cost_scale` says; null where there is no plan, or the
    engine tells no costs, as in numeric and durative domains."""
    bound: int | None
    """No plan costs less; equal to the cost where the plan is optimal. Null like the cost."""
    gap: float | None
    """The share of the cost that a better plan could at most save. Null like the cost."""
    steps: tuple[StepAnswer, ...]
    unreachable: tuple[UnreachableAnswer, ...]
    """People whom no plan can serve."""
    unmet: tuple[Unmet, ...]
    """Every goal that fails, with what stands in its way."""
    already: tuple[str, ...]
    """Who was greeted before the start."""
    notes: tuple[str, ...] = ()
    """Behaviour parameters that no action reads, and people whom the sensor would not show from where the
    robot is to stand, or to whom something is said that they do not hear."""
    validation: Validation | None = None
    """With `--validate`: what unified-planning's validator says of the plan."""
    stability: StabilityAnswer | None = None
    """With `--stability`, up to 12 people; null beyond."""
    why: StepWhyAnswer | None = None
    """With `--why STEP`."""
    diff: DiffAnswer | None = None
    """With `--diff`."""
