"""Alternatives to a step: other objects for its options with which the plan stays valid."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import islice, product
from math import prod
from typing import TYPE_CHECKING

from comity_domain.custom.costs.cost import objects_for
from comity_domain.custom.costs.table import CostRow
from comity_domain.custom.reading.reading import as_global
from comity_domain.custom.solving.bound import Bound
from comity_domain.custom.solving.solution import GroundAction

if TYPE_CHECKING:
    from unified_planning.model import Problem
    from unified_planning.plans import SequentialPlan

MOST_TRIED, MOST_ATOMS = 200, 100_000
"""Limits on the alternatives tried for a plan, each by a run of the validator; steps share them equally.

The first limits the runs, the second the possible atoms in all runs together, since the validator looks at
each of them (about 3 s).
"""
LONGEST_PLAN = 200
"""Maximum number of steps; no alternatives are tried for longer plans."""


def row_of(action: GroundAction, bound: Bound) -> CostRow | None:
    """The cost of a step; None if it is excluded."""
    table = bound.tables[action.name]
    return table.rows.get(tuple(argument_of(action, name, bound) for name in table.arguments))


def argument_of(action: GroundAction, name: str, bound: Bound) -> str:
    """The object for an argument."""
    names = [parameter.name for parameter in bound.problem.action(action.name).parameters]
    return action.arguments[names.index(name)]


def other_ways(
    index: int, actions: Sequence[GroundAction], options: Sequence[str], bound: Bound
) -> Iterator[tuple[GroundAction, int]]:
    """The step with other options, and the additional cost of the whole plan; cheapest first.

    A swap that invalidates the plan is tried once more throughout the plan: in every action with the same
    object for the same person.

    Args:
        index: Index of the step.
        actions: The plan.
        options: The arguments of the step that are options.
        bound: The planned problem.
    """
    cost = _cost(actions, bound)
    found = []
    for other in islice(_variants(actions[index], options, bound), tries(actions, bound)):
        for plan in (
            [*actions[:index], other, *actions[index + 1 :]],
            _everywhere(actions, actions[index], other),
        ):
            other_cost = _cost(plan, bound)
            if cost is not None and other_cost is not None and works(plan, bound):
                found.append((other, other_cost - cost))
                break
    yield from sorted(found, key=lambda pair: pair[1])


def tries(actions: Sequence[GroundAction], bound: Bound) -> int:
    """Number of alternatives to try per step of a plan; 0 if the plan or the problem is too large."""
    if len(actions) > LONGEST_PLAN:
        return 0
    return min(max(2, MOST_TRIED // len(actions)), MOST_ATOMS // (_atoms(bound.problem) * len(actions)))


def _atoms(problem: Problem) -> int:
    """Number of possible atoms of all predicates and functions, at least 1."""
    counts = {type_: len(list(problem.objects(type_))) for type_ in problem.user_types}
    return 1 + sum(
        prod(counts[parameter.type] for parameter in fluent.signature) for fluent in problem.fluents
    )


def works(actions: Sequence[GroundAction], bound: Bound) -> bool:
    """Whether a plan reaches all goals, by unified-planning's validator."""
    from unified_planning.engines import SequentialPlanValidator, ValidationResultStatus

    with as_global(bound.problem.environment):
        validator = SequentialPlanValidator()
        # It rejects functions without a value for some combination, but only a plan that uses one is invalid.
        validator.skip_checks = True
        result = validator.validate(bound.problem, as_plan(actions, bound))
    return bool(result.status == ValidationResultStatus.VALID)


def as_plan(actions: Sequence[GroundAction], bound: Bound) -> SequentialPlan:
    """The plan as a unified-planning plan."""
    from unified_planning.plans import ActionInstance, SequentialPlan

    problem = bound.problem
    return SequentialPlan(
        [
            ActionInstance(problem.action(one.name), tuple(map(problem.object, one.arguments)))
            for one in actions
        ],
        problem.environment,
    )


def _variants(action: GroundAction, options: Sequence[str], bound: Bound) -> Iterator[GroundAction]:
    """The step with every other permitted choice of its options."""
    declared = bound.problem.action(action.name)
    pools = [
        objects_for(bound.problem, declared, parameter.name) if parameter.name in options else [argument]
        for parameter, argument in zip(declared.parameters, action.arguments, strict=True)
    ]
    for arguments in product(*pools):
        other = replace(action, arguments=arguments)
        if other != action and row_of(other, bound) is not None:
            yield other


def _everywhere(
    actions: Sequence[GroundAction], was: GroundAction, becomes: GroundAction
) -> list[GroundAction]:
    changed = {old: new for old, new in zip(was.arguments, becomes.arguments, strict=True) if old != new}
    kept = {old for old, new in zip(was.arguments, becomes.arguments, strict=True) if old == new}
    return [
        replace(one, arguments=tuple(changed.get(name, name) for name in one.arguments))
        if kept & set(one.arguments)
        else one
        for one in actions
    ]


def _cost(actions: Sequence[GroundAction], bound: Bound) -> int | None:
    rows = [row_of(action, bound) for action in actions]
    known = [row.cost for row in rows if row is not None]
    return sum(known) if len(known) == len(rows) else None
