"""What another profile or rulebook changes in a plan, and why."""

from __future__ import annotations

from typing import TYPE_CHECKING

from comity.answers.plan import ChoiceChangeAnswer, DiffAnswer, ParameterChangeAnswer, StepCostChangeAnswer
from comity.report.plans.cost_change import cost_changes
from comity.report.text import number, words
from comity.report.values.inference import because

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from rich.console import RenderableType

    from comity.preparation import PlannedEpisode
    from comity_domain import Plan, PlanStep
    from comity_fis import Inference

SAME = 1e-9
"""Numbers nearer to each other are the same, relative to the larger one of them and 1."""


def plan_diff(before: PlannedEpisode, after: PlannedEpisode) -> DiffAnswer:
    """The answer of `comity plan --diff`.

    Args:
        before: The scenario as it is written.
        after: The same with other profiles, or another rulebook.
    """
    return DiffAnswer(
        cost=(before.plan.cost, after.plan.cost),
        order=(_order(before.plan), _order(after.plan)),
        parameters=tuple(_parameters(before.values, after.values)),
        choices=tuple(_choices(before.plan, after.plan)),
        costs=tuple(cost_changes(before, after)),
    )


def diff_text(
    diff: DiffAnswer, *, against: str = "the scenario as it is written", plain: bool = False
) -> Iterator[RenderableType]:
    """The same, for a person to read.

    Args:
        diff: The answer.
        against: With what it compares.
        plain: Whether a step's arguments are all its own, as in PDDL, and none is the robot or the person.
    """
    from rich.padding import Padding

    yield f"\nAgainst {against}"
    if diff.cost is not None:
        cost, now = diff.cost
        yield f"  cost {cost} → {now}" if cost != now else f"  cost {cost}, as before"
    order, then = (", ".join(people) or "nobody" for people in diff.order)
    yield f"  order {order} → {then}" if order != then else f"  order {order}, as before"
    for change in diff.parameters:
        values = (number(value, change.unit) for value in (change.before, change.after))
        yield Padding(f"{change.person}: {words(change.parameter)} {' → '.join(values)}", (0, 0, 0, 2))
        yield Padding(f"before: {change.because_before}", (0, 0, 0, 6))
        yield Padding(f"now: {change.because_after}", (0, 0, 0, 6))
    for choice in diff.choices:
        ways = (", ".join(map(words, way)) if way else "not done" for way in (choice.before, choice.after))
        yield Padding(f"{choice.person}: {choice.action} {' → '.join(ways)}", (0, 0, 0, 2))
        yield Padding(choice.because, (0, 0, 0, 6))
    if not (diff.parameters or diff.choices):
        yield "  no parameter and no choice is another one"
    yield from _costs(diff, plain=plain)


def _costs(diff: DiffAnswer, *, plain: bool) -> Iterator[RenderableType]:
    """What the difference of the costs is made of; nothing where no step costs anything else."""
    from rich.padding import Padding

    if not diff.costs or diff.cost is None:
        return
    cost, now = diff.cost
    yield f"\nWhat costs more or less, {now - cost:+} in all"
    for step in diff.costs:
        yield Padding(f"{_named(step, plain=plain)}   {step.cost[0]} → {step.cost[1]}", (0, 0, 0, 2))
        for part in step.parts:
            yield Padding(f"{part.part} {part.before} → {part.after}: {part.because}", (0, 0, 0, 6))


def _named(step: StepCostChangeAnswer, *, plain: bool) -> str:
    """`Reach_user(guest: front)`, where both plans have it with both choices."""
    if plain:
        whole = (f"{step.action}({', '.join(way)})" for way in (step.before, step.after) if way is not None)
        return " → ".join(dict.fromkeys(whole))
    ways = [", ".join(way[2:]) for way in (step.before, step.after) if way is not None]
    return f"{step.action}({', '.join(step.people)}: {' → '.join(dict.fromkeys(ways))})"


def _order(plan: Plan) -> tuple[str, ...]:
    return tuple(step.person for step in plan.steps if step.action == "Reach_user")


def _parameters(
    before: Mapping[str, Inference], after: Mapping[str, Inference]
) -> Iterator[ParameterChangeAnswer]:
    for person, values in before.items():
        others = after[person]
        for name, value in values.parameters.items():
            other = others.parameters.get(name)
            if other is not None and not same(value.value, other.value):
                yield ParameterChangeAnswer(
                    person=person,
                    parameter=name,
                    before=value.value,
                    after=other.value,
                    unit=value.unit,
                    because_before=because(value, values.inputs),
                    because_after=because(other, others.inputs),
                )


def _choices(before: Plan, after: Plan) -> Iterator[ChoiceChangeAnswer]:
    """Sides and greetings by person: a company that is greeted at once is a greeting of each of them."""
    was, is_ = _chosen(before), _chosen(after)
    for person, action in dict.fromkeys((*was, *is_)):
        old, new = was.get((person, action)), is_.get((person, action))
        if old is not None and new is not None and old[0] == new[0]:
            continue
        step = new[1] if new is not None else None
        yield ChoiceChangeAnswer(
            person=person,
            action=action,
            before=old[0] if old else None,
            after=new[0] if new else None,
            because=step.why.text if step else "no step of the plan does it any more",
        )


def _chosen(plan: Plan) -> dict[tuple[str, str], tuple[tuple[str, ...], PlanStep]]:
    """What is chosen for each person, and the step that says why."""
    return {
        (person, "greeting" if step.action.startswith("Greet_") else step.action): (step.arguments[2:], step)
        for step in plan.steps
        for person in step.people
    }


def same(one: float | str, other: float | str) -> bool:
    """Whether two values are the same word, or numbers that nobody can tell apart."""
    if isinstance(one, str) or isinstance(other, str):
        return one == other
    return abs(one - other) <= SAME * max(1.0, abs(one), abs(other))
