"""Changes of a plan due to another profile or rulebook, with reasons."""

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
"""Numbers closer than this are equal, relative to the larger one of them and 1."""


def plan_diff(before: PlannedEpisode, after: PlannedEpisode) -> DiffAnswer:
    """The answer of `comity plan --diff`.

    Args:
        before: The scenario as written.
        after: The scenario with other profiles, or another rulebook.
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
    """The answer as text.

    Args:
        diff: The answer.
        against: What the plan is compared with.
        plain: Whether to show all arguments of a step, as in PDDL, without separating robot and person.
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
    """Cost difference by term; nothing if no step's costs differ."""
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
    """Name such as `Reach_user(guest: front)` if both plans have the step with the same choices."""
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
    """Sides and greetings by person; a joint greeting of a company counts for each of them."""
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
    """Choices for each person, and the step that explains them."""
    return {
        (person, "greeting" if step.action.startswith("Greet_") else step.action): (step.arguments[2:], step)
        for step in plan.steps
        for person in step.people
    }


def same(one: float | str, other: float | str) -> bool:
    """Whether two values are the same word, or numerically indistinguishable."""
    if isinstance(one, str) or isinstance(other, str):
        return one == other
    return abs(one - other) <= SAME * max(1.0, abs(one), abs(other))
