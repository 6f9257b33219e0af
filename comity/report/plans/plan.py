"""A plan: its steps, values and reasons."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from comity.answers.plan import FailureAnswer, PlanAnswer, StepAnswer, UnreachableAnswer, WhyAnswer
from comity.parameters.perception import NOTE_OF_SAY
from comity.parameters.unread import notes_of_unread
from comity.report.plans.proof import quality
from comity.report.plans.side import SIDES
from comity.report.plans.step_values import contributions_of, origin_in_words
from comity.report.text import number, words
from comity_domain.problem.bound_parameters import BEARING, DISTANCE, SPEED
from comity_executor import other_parameters
from comity_sim2d.senses.sight import too_short_for

if TYPE_CHECKING:
    from collections.abc import Iterator

    from rich.console import RenderableType

    from comity.answers.plan import Unmet
    from comity.planning.diagnosis import GoalsUnmet
    from comity.preparation import PlannedEpisode
    from comity.scenario import ScenarioFile
    from comity_domain import Plan, PlanStep
    from comity_fis import Inference
    from comity_sim2d import RobotBody


def plan_answer(prepared: PlannedEpisode) -> PlanAnswer:
    """The answer of `comity plan --json`, and `plan.json` in the run folder."""
    plan = prepared.plan
    return PlanAnswer(
        scenario=prepared.file.scenario.name,
        rulebook=prepared.rulebook.name,
        rulebook_reason=prepared.chosen.why,
        solved=True,
        **quality_of(plan),
        cost=plan.cost,
        bound=plan.bound,
        gap=plan.gap,
        steps=steps_answer(plan, prepared.values),
        unreachable=tuple(
            UnreachableAnswer(person=person, reason=reason)
            for person, reason in prepared.asked.unreachable.items()
        ),
        unmet=prepared.unmet,
        already=_already(prepared.file),
        notes=(
            *notes_of_unread(prepared.rulebook),
            *_unverified(plan, prepared.scene.robot),
            *_unheard(plan, prepared.values),
        ),
    )


def quality_of(plan: Plan) -> dict[str, Any]:
    """The engine that found a plan, and what is proven about its optimality."""
    return {name: getattr(plan, name) for name in ("engine", "optimal", "reproducible", "killed")}


def _unverified(plan: Plan, robot: RobotBody) -> Iterator[str]:
    """People whom the sensor cannot see from the target distance, with the reason."""
    for step in plan.steps:
        distance_m = step.parameters.get(DISTANCE)
        if step.action == "Reach_user" and isinstance(distance_m, float):
            reason = too_short_for(robot.sensor, robot.radius_m + distance_m)
            if reason is not None:
                yield f"{step.person}: {reason}"


def _unheard(plan: Plan, values: Mapping[str, Inference]) -> Iterator[str]:
    """People to whom something is to be said, and who do not hear."""
    visited = {name for step in plan.steps for name in step.people}
    for name, inferred in values.items():
        if name in visited and NOTE_OF_SAY in inferred.notes:
            yield f"{name}: {NOTE_OF_SAY}"


def steps_answer(plan: Plan, values: Mapping[str, Inference]) -> tuple[StepAnswer, ...]:
    """The steps of a plan, each with the contributions of its values.

    Args:
        plan: The plan.
        values: Values that the plan was made with, by person.
    """
    return tuple(
        replace(
            step_answer(step, values[step.person]), other_parameters=other_parameters(values[step.person])
        )
        for step in plan.steps
    )


def step_answer(step: PlanStep, values: Inference | None) -> StepAnswer:
    """A step, with the contributions of its values if they are a person's."""
    return StepAnswer(
        action=step.action,
        arguments=step.arguments,
        people=step.people,
        parameters=step.parameters,
        contributions=contributions_of(step.parameters, values),
        cost=step.cost,
        cost_parts=step.cost_parts,
        from_=step.origin,
        why=WhyAnswer(text=step.why.text, alternatives=step.why.alternatives, ruled_out=step.why.ruled_out),
    )


def no_plan(*, reproducible: bool) -> dict[str, Any]:
    """Plan fields of an answer without a plan.

    Args:
        reproducible: Whether the result is independent of limits.
    """
    quality = {"engine": "none", "optimal": False, "reproducible": reproducible, "killed": False}
    return {"solved": False, **quality, "cost": None, "bound": None, "gap": None, "steps": ()}


def no_plan_answer(file: ScenarioFile, failed: GoalsUnmet) -> PlanAnswer:
    """The answer without a plan."""
    return PlanAnswer(
        scenario=file.scenario.name,
        failure=FailureAnswer(reason=failed.reason, remedy=failed.remedy),
        **no_plan(reproducible=not failed.cut_off),
        unreachable=(),
        unmet=failed.unmet,
        already=_already(file),
    )


def _already(file: ScenarioFile) -> tuple[str, ...]:
    wanted = {goal.person for goal in file.scenario.goals}
    return tuple(fact.greeted for fact in file.scenario.already if fact.greeted in wanted)


ALTERNATIVES_SHOWN = 3
"""Number of alternatives shown, the cheapest; `--json` has all."""
SILENT = frozenset({"text", "thing", "place", "modality"})
"""Parameters that are already in the step's own line."""
UNITS = {
    DISTANCE: "m",
    "approach_direction": "deg",
    BEARING: "deg",
    SPEED: "m/s",
    "cap_s": "s",
}


def _below_the_headline(answer: PlanAnswer) -> Iterator[str]:
    """Lines below the headline: the rulebook, the validator's result, and how to read costs."""
    if answer.rulebook is not None:
        yield f"Rulebook {answer.rulebook}: {answer.rulebook_reason}."
    if (checked := answer.validation) is not None:
        said = "accepts it" if checked.valid else f"refuses it: {checked.reason}"
        yield f"The validator of unified-planning {said}, at a cost of {checked.cost}."
    yield "A cost of 1 is 1 cm of way: travel, and what a less desirable choice would be worth in travel."
    yield "What another choice costs more is with the rest of the plan as it is."


def plan_text(answer: PlanAnswer) -> Iterator[RenderableType]:
    """The answer as text."""
    from rich.padding import Padding

    skips = any(step.action == "Skip_visit" for step in answer.steps)
    proven = "no plan for those who are visited costs less" if skips else "no plan costs less"
    known = quality(answer, proven=proven)
    yield f"Plan for {answer.scenario}: {len(answer.steps)} steps, cost {answer.cost} ({known})"
    yield from _below_the_headline(answer)
    yield SIDES
    for i, step in enumerate(answer.steps, start=1):
        yield f"\n{i:3}. {step.action}({', '.join(step.arguments)})   cost {step.cost}"
        if values := ", ".join(_values(step)):
            yield Padding(values, (0, 0, 0, 5))
        yield Padding(step.why.text, (0, 0, 0, 5))
        for other in step.why.alternatives[:ALTERNATIVES_SHOWN]:
            yield Padding(
                f"or {', '.join(map(words, choice(other.arguments, step)))} for {other.extra_cost} more",
                (0, 0, 0, 7),
            )
        if hidden := step.why.alternatives[ALTERNATIVES_SHOWN:]:
            yield Padding(f"or {_others(len(hidden))}, from {hidden[0].extra_cost} more", (0, 0, 0, 7))
        if out := step.why.ruled_out:
            yield Padding(f"{len(out)} not possible now: --why {i} says why", (0, 0, 0, 7))
    if answer.notes:
        yield ""
    yield from (f"Note: {note}" for note in answer.notes)
    for person in answer.already:
        yield f"\n{person} was greeted already."
    for goal in answer.unmet:
        yield f"\n{goal.person} cannot be greeted: {goal.reason}."
        yield from _ways_out(goal)


def _others(count: int) -> str:
    return "1 other" if count == 1 else f"{count} others"


def choice(arguments: tuple[str, ...], step: StepAnswer) -> tuple[str, ...]:
    """Choices of an alternative step; includes the person before whom the robot stands, if different."""
    return arguments[2:] if arguments[1:2] == step.arguments[1:2] else arguments[1:]


def _ways_out(goal: Unmet) -> Iterator[str]:
    """Changes that would make a goal achievable, a line for each condition."""
    if not goal.conditions:
        yield "  No single thing would change that."
        return
    yield "  It would be possible" + (" only if all of this were so:" if goal.together else ":")
    yield from (f"    if {condition.text}" for condition in goal.conditions)


def _values(step: StepAnswer) -> Iterator[str]:
    """Parameters with units; the approach direction is combined with the resulting side."""
    for name, value in step.parameters.items():
        text, origin = number(value, UNITS.get(name)), origin_in_words(step, name)
        if name in SILENT:
            continue
        if name == "cap_s":
            yield f"{'at most ' if 'until' in step.parameters else ''}{value:g} s"
        elif name == "approach_direction":
            yield f"{words(name)} {text} off the front{origin}"
        elif name == BEARING:
            side = f"side {step.arguments[-1]}: " if "approach_direction" in step.parameters else ""
            yield f"{side}bearing {text}"
        else:
            yield f"{words(name)} {text}{origin}"
