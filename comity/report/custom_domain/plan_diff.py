"""Changes of a custom-domain plan due to other profiles, rules or another date, with reasons."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Iterator, Sequence
from typing import TYPE_CHECKING

from comity.answers.plan import ChoiceChangeAnswer, DiffAnswer, ParameterChangeAnswer, StepCostChangeAnswer
from comity.report.plans.cost_change import step_change
from comity.report.plans.plan_diff import same
from comity.report.values.inference import because

if TYPE_CHECKING:
    from comity_domain import PlanStep
    from comity_domain.custom import Bound, CustomPlan

Planned = tuple["Bound", "CustomPlan"]
Owned = tuple["PlanStep", str | None]
"""A step, and the person whose preferences are bound to it."""
Pair = tuple[Owned | None, Owned | None]


def custom_diff(before: Planned, after: Planned) -> DiffAnswer:
    """The answer of `comity plan --domain ... --diff`.

    Args:
        before: The binding as written.
        after: The binding with other profiles, another rulebook or another date.
    """
    pairs = _pairs(before[1], after[1])
    return DiffAnswer(
        cost=(before[1].plan.cost, after[1].plan.cost) if after[1].tells_costs else None,
        order=(_order(before[1]), _order(after[1])),
        parameters=tuple(_parameters(before[0], after[0])),
        choices=tuple(_choices(pairs)),
        costs=tuple(_costs(pairs)),
    )


def _order(found: CustomPlan) -> tuple[str, ...]:
    return tuple(dict.fromkeys(person for person in found.whose if person is not None))


def _parameters(before: Bound, after: Bound) -> Iterator[ParameterChangeAnswer]:
    """Changed parameters used by the binding, for all people with a profile."""
    assert before.people is not None
    assert after.people is not None
    bound = before.binding
    used = [name for action in bound.actions.values() for name in action.parameters]
    used += [option.parameter for action in bound.actions.values() for option in action.options.values()]
    used += [fluent.parameter for fluent in bound.fluents.values()]
    for person in dict.fromkeys((*before.people.known, *after.people.known)):
        was, is_ = before.people[person], after.people[person]
        for name in dict.fromkeys(used):
            if name in is_.parameters and not same(was[name].value, is_[name].value):
                yield ParameterChangeAnswer(
                    person=person,
                    parameter=name,
                    before=was[name].value,
                    after=is_[name].value,
                    unit=was[name].unit,
                    because_before=because(was[name], was.inputs),
                    because_after=because(is_[name], is_.inputs),
                )


def _pairs(before: CustomPlan, after: CustomPlan) -> list[Pair]:
    """Steps of both plans, paired with the most similar step of the other plan."""
    old = list(zip(before.plan.steps, before.whose, strict=True))
    new = list(zip(after.plan.steps, after.whose, strict=True))
    pairs: list[Pair] = []
    for alike in (_as_it_is, _for_whom):
        pairs += _matched(old, new, alike)
    return [*pairs, *((None, step) for step in new), *((step, None) for step in old)]


def _as_it_is(owned: Owned) -> object:
    return owned[0].action, owned[0].arguments


def _for_whom(owned: Owned) -> object:
    return owned[0].action, owned[1]


def _matched(old: list[Owned], new: list[Owned], alike: Callable[[Owned], object]) -> Iterator[Pair]:
    """Matching pairs, removed from both lists, in the order of the new plan."""
    waiting = defaultdict[object, list["Owned"]](list)
    for owned in old:
        waiting[alike(owned)].append(owned)
    for owned in tuple(new):
        if was := waiting[alike(owned)]:
            new.remove(owned)
            old.remove(was[0])
            yield was.pop(0), owned


def _choices(pairs: Sequence[Pair]) -> Iterator[ChoiceChangeAnswer]:
    for old, new in pairs:
        step, person = new or old or (None, None)
        if step is None or (old and new and old[0].arguments == new[0].arguments):
            continue
        yield ChoiceChangeAnswer(
            person=person or "nobody's",
            action=step.action,
            before=old[0].arguments if old else None,
            after=new[0].arguments if new else None,
            because=new[0].why.text if new else "no step of the plan does it any more",
        )


def _costs(pairs: Sequence[Pair]) -> Iterator[StepCostChangeAnswer]:
    for old, new in pairs:
        _, person = new or old or (None, None)
        people = (person,) if person else ()
        yield from step_change(old[0] if old else None, new[0] if new else None, people, _because)


def _because(part: str, old: PlanStep | None, new: PlanStep | None) -> str:
    if old is None:
        return "not done before"
    if new is None:
        return "not done any more"
    if part != "domain":
        return f"before, {old.why.chosen}; now, {new.why.chosen}"
    if old.arguments != new.arguments:
        return "the domain's own cost of the other objects"
    return "the domain's own cost reads a function that a person's parameter fills"
