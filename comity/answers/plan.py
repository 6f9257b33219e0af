"""What `comity plan` answers: steps, their reasons, and what would be otherwise."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Literal

from pydantic import Field

from comity.answers.base import Answer
from comity.answers.inference import ContributionAnswer


class AlternativeAnswer(Answer):
    """Another way to do a step."""

    arguments: tuple[str, ...]
    extra_cost: int = Field(description="So much more than the plan, with the rest of it as it is [cm].")
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
    cost: int | None = Field(description="Null where the engine tells no costs.")
    cost_parts: Mapping[str, int] = Field(
        description="`travel`, `side`; or `greeting`, `nearness` of others, `waiting` of who has a priority; "
        "or `farewell`, or `skip`. In a custom domain `domain`, and each option such as `?how`."
    )
    origin: tuple[str, str] | None = Field(alias="from", description="Place and side that the robot leaves.")
    start_s: float | None = Field(default=None, description="Null where the plan is a mere order.")
    duration_s: float | None = None
    why: WhyAnswer


class UnreachableAnswer(Answer):
    """Somebody whom no plan can visit."""

    person: str
    reason: str


class CustomDomainAnswer(Answer):
    """What `comity plan --domain` planned."""

    domain: str
    problem: str
    cost_scale: int = Field(description="A cost of so much is 1 of the domain's own.")
    people: tuple[str, ...] = Field(description="Objects whose parameters were inferred from a profile.")
    renamed: Mapping[str, str] = Field(description="Names that the files of `--pddl` could not keep.")
    files: tuple[str, ...]
    metric_ignored: bool = Field(
        default=False, description="The engine did not look at the :metric: another plan may be better by it."
    )


class ConditionAnswer(Answer):
    """Something that stands in the way of a goal."""

    kind: Literal["hands", "noise", "consent", "setting", "side", "door", "deadline"]
    name: str = Field(description="What of that kind.")
    text: str


class FailureAnswer(Answer):
    """Why there is no plan."""

    reason: str
    remedy: str


class UnmetAnswer(Answer):
    """A goal that no plan meets."""

    person: str
    reason: str
    conditions: tuple[ConditionAnswer, ...] = Field(
        description="Without any one of them the goal could be met; where `together`, without all of them."
    )
    together: bool
    complete: bool = Field(
        default=True,
        description="False where the search for the conditions was cut off: there may be others, or fewer "
        "would do.",
    )


class NextInsteadAnswer(Answer):
    """Another person to go to at this step, all that follows being planned anew."""

    person: str
    extra_cost: int | None = Field(description="Null where a deadline or a route rules it out.")


class ContrastAnswer(Answer):
    """The best plan in which this person is reached from another side, all else planned anew."""

    side: str
    extra_cost: int | None = Field(description="Null where there is no such plan.")
    steps: tuple[str, ...] = Field(description="Its steps, such as `Reach_user(robot, johanna, left)`.")


class StepValueAnswer(Answer):
    """One parameter of a step for one person."""

    person: str
    parameter: str
    planned: float | str
    value: float | str = Field(description="What suits the person best; `planned` is what the step does.")
    unit: str | None
    contributions: tuple[ContributionAnswer, ...]
    because: str


class SkippingAnswer(Answer):
    """What leaving somebody out is weighed against: ways that are reckoned alike for everybody."""

    price: int = Field(description="What the scenario says that leaving them out costs, in cm.")
    serving: int | None = Field(
        description="What the ways, priorities and prices of all others would cost more if they were served; "
        "null where no plan serves them."
    )
    reason: str | None = Field(description="Why no plan serves them; null where one could.")


class WithoutAnswer(Answer):
    """The best plan without one choice of it: the engine was asked again, with that choice forbidden."""

    forbidden: str
    extra_cost: int | None = Field(description="Null where there is no such plan, or none was found.")
    proven: bool = Field(description="No plan without the choice costs less, or none is possible.")
    no_longer: tuple[str, ...] = Field(description="Steps of the plan that are not in that one.")
    instead: tuple[str, ...] = Field(description="Steps of that one that are not in the plan.")


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
    contrast: tuple[ContrastAnswer, ...] = Field(
        default=(), description="Of a `Reach_user`, up to 12 people; cheapest first."
    )
    skipping: SkippingAnswer | None = Field(default=None, description="Of a `Skip_visit`.")
    without: WithoutAnswer | None = Field(
        default=None, description="In a classical domain of the user's own."
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


class CostPartChangeAnswer(Answer):
    """One part of a step's cost that is another one."""

    part: str = Field(description="As in `cost_parts`.")
    before: int
    after: int
    because: str


class StepCostChangeAnswer(Answer):
    """A step that costs more or less, or is in one of the two plans only."""

    action: str
    people: tuple[str, ...]
    before: tuple[str, ...] | None = Field(description="Its arguments; null where it is not done.")
    after: tuple[str, ...] | None
    cost: tuple[int, int] = Field(description="0 where it is not done.")
    parts: tuple[CostPartChangeAnswer, ...] = Field(description="Those that differ: they add up to `cost`'s.")


class DiffAnswer(Answer):
    """`comity plan --as ... --diff`: against the scenario as it is written."""

    cost: tuple[int, int] | None = Field(description="Null where the engine tells no costs.")
    order: tuple[tuple[str, ...], tuple[str, ...]] = Field(
        description="Whom the robot goes to, before and after."
    )
    parameters: tuple[ParameterChangeAnswer, ...]
    choices: tuple[ChoiceChangeAnswer, ...]
    costs: tuple[StepCostChangeAnswer, ...] = Field(
        description="All that is not as dear as before: the differences add up to that of `cost`."
    )


class PlanFlipAnswer(Answer):
    """A factor of the weights at which another plan is cheaper."""

    weight: str = Field(
        description="`side`, `greeting` or `both`; in a custom domain an option, such as "
        "`greet ?how`, or `all`."
    )
    factor: float
    changes: tuple[str, ...] = Field(description="What that plan does otherwise.")


class StabilityAnswer(Answer):
    """How far the weights can change before another plan is cheaper."""

    lowest: float
    highest: float
    stable: bool = Field(description="Among the cheapest for every factor that was looked at.")
    flips: tuple[PlanFlipAnswer, ...] = Field(description="The nearest in each direction.")
    exact: bool = Field(default=True, description="False where a search was cut off: nearer ones may be.")


class ValidationAnswer(Answer):
    """A plan as a validator sees it that knows nothing of how it was found."""

    valid: bool = Field(description="Every action can be done in its turn, and all goals are reached.")
    reason: str = Field(description="What is wrong; empty where nothing is.")
    cost: int = Field(description="Of the actions together; who is left out at a price has none.")


class PlanAnswer(Answer):
    """`comity plan --json`."""

    scenario: str | None = Field(description="Null for a custom domain.")
    own: CustomDomainAnswer | None = None
    rulebook: str | None = Field(
        default=None,
        description="Whose rules decide; null without a plan, and for a custom domain.",
    )
    rulebook_reason: str | None = Field(default=None, description="Why that one.")
    solved: bool = Field(description="False where no plan meets the goals of those who can be served.")
    failure: FailureAnswer | None = Field(default=None, description="Null where `solved`.")
    engine: str = Field(
        description="`comity` for visits; the name that unified-planning has for the engine that solved a "
        "domain of the user's own; `none` where there is no plan."
    )
    optimal: bool = Field(description="Proven: no plan for those who are visited costs less.")
    reproducible: bool = Field(
        description="False where a limit of time or memory cut the search off, for a plan or for what stands "
        "in its way: another machine may find another answer."
    )
    killed: bool = Field(
        description="The engine was killed from outside; the plan is the best that it had found by then."
    )
    cost: int | None = Field(
        description="In centimetres of metre-equivalents, or as `own.cost_scale` says; null where there is "
        "no plan, or the engine tells no costs, as in numeric and durative domains."
    )
    bound: int | None = Field(
        description="No plan costs less; equal to the cost where the plan is optimal. Null like the cost."
    )
    gap: float | None = Field(
        description="The share of the cost that a better plan could at most save. Null like the cost."
    )
    steps: tuple[StepAnswer, ...]
    unreachable: tuple[UnreachableAnswer, ...] = Field(description="Whom no plan can serve.")
    unmet: tuple[UnmetAnswer, ...] = Field(description="Every goal that fails, with what stands in its way.")
    already: tuple[str, ...] = Field(description="Who was greeted before the start.")
    notes: tuple[str, ...] = Field(
        default=(),
        description="Behaviour parameters that no action reads, and people whom the sensor would not show "
        "from where the robot is to stand, or to whom something is said that they do not hear.",
    )
    validation: ValidationAnswer | None = Field(
        default=None, description="With `--validate`: what unified-planning's validator says of the plan."
    )
    stability: StabilityAnswer | None = Field(
        default=None, description="With `--stability`, up to 12 people; null beyond."
    )
    why: StepWhyAnswer | None = Field(default=None, description="With `--why STEP`.")
    diff: DiffAnswer | None = Field(default=None, description="With `--diff`.")
