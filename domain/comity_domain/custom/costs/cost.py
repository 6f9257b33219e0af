"""The domain's own action costs: its formulas evaluated for every combination of objects."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from fractions import Fraction
from itertools import product
from math import prod
from typing import TYPE_CHECKING

from comity_fis.errors import InputError, Where

if TYPE_CHECKING:
    from unified_planning.model import Action, FNode, Problem

MAX_GROUNDED = 100_000
"""Maximum number of object combinations for the cost of one action."""

Assignment = Mapping[str, str]
"""Objects by the action's arguments."""


def own_costs(problem: Problem) -> Mapping[str, FNode | None]:
    """Cost formula of every action; None if it is free. Without a metric each action costs 1."""
    one = problem.environment.expression_manager.Int(1)
    metric = problem.quality_metrics[0] if problem.quality_metrics else None
    if metric is None or not metric.is_minimize_action_costs():
        return {action.name: one for action in problem.actions}
    return {action.name: metric.get_action_cost(action) for action in problem.actions}


def arguments_in(formula: FNode | None, action: Action) -> tuple[str, ...]:
    """The arguments of an action that its cost depends on, in the action's order."""
    read = [part for node in _fluents(formula) for part in node.args if part.is_parameter_exp()]
    found = {part.parameter().name for part in read}
    return tuple(parameter.name for parameter in action.parameters if parameter.name in found)


def functions_in(formula: FNode | None) -> frozenset[str]:
    """The functions that a formula reads."""
    return frozenset(node.fluent().name for node in _fluents(formula))


def _fluents(formula: FNode | None) -> list[FNode]:
    """The function terms in a formula, sorted alphabetically."""
    if formula is None:
        return []
    return sorted(formula.environment.free_vars_extractor.get(formula), key=str)


def groundings(
    problem: Problem, action: Action, arguments: Sequence[str], where: Where
) -> Iterator[dict[str, str]]:
    """Every combination of objects for the given arguments of an action.

    Args:
        problem: The problem that declares the objects.
        action: The action that has the arguments.
        arguments: The arguments to instantiate.
        where: Location of the action in its file.

    Raises:
        InputError: There are more than `MAX_GROUNDED` combinations.
    """
    pools = [objects_for(problem, action, argument) for argument in arguments]
    if prod(map(len, pools)) > MAX_GROUNDED:
        raise InputError(
            expected=f"at most {MAX_GROUNDED} combinations of objects in the cost of {action.name}",
            got=" times ".join(map(str, map(len, pools))),
            remedy="Let the cost depend on fewer arguments, or plan a smaller problem.",
            where=where,
        )
    for names in product(*pools):
        yield dict(zip(arguments, names, strict=True))


def objects_for(problem: Problem, action: Action, argument: str) -> list[str]:
    """The objects that an argument may be, by name."""
    return [one.name for one in problem.objects(action.parameter(argument).type)]


Values = Mapping[tuple[str, ...], Fraction]
"""Initial values of numeric functions, keyed by function and objects."""


def initial_numbers(problem: Problem) -> Values:
    """Numeric values of the initial state."""
    return {
        (fluent.fluent().name, *(argument.object().name for argument in fluent.args)): Fraction(
            value.constant_value()
        )
        for fluent, value in problem.explicit_initial_values.items()
        if value.is_int_constant() or value.is_real_constant()
    }


def evaluated(formula: FNode | None, assignment: Assignment, values: Values) -> Fraction | None:
    """Value of a formula; None if a function has no value or a divisor is 0."""
    if formula is None:
        return Fraction(0)
    if formula.is_int_constant() or formula.is_real_constant():
        return Fraction(formula.constant_value())
    if formula.is_fluent_exp():
        names = (_name(argument, assignment) for argument in formula.args)
        return values.get((formula.fluent().name, *names))
    parts = [evaluated(argument, assignment, values) for argument in formula.args]
    known = [part for part in parts if part is not None]
    return _computed(formula, known) if len(known) == len(parts) else None


def atoms_in(formula: FNode | None, assignment: Assignment) -> Iterator[tuple[str, ...]]:
    """The ground function terms in a formula: each function with its objects."""
    for node in _fluents(formula):
        yield (node.fluent().name, *(_name(argument, assignment) for argument in node.args))


def _computed(formula: FNode, parts: Sequence[Fraction]) -> Fraction | None:
    if formula.is_plus():
        return sum(parts, Fraction(0))
    if formula.is_times():
        return prod(parts, start=Fraction(1))
    if formula.is_minus():
        return parts[0] - parts[1]
    return parts[0] / parts[1] if parts[1] else None


def _name(argument: FNode, assignment: Assignment) -> str:
    if argument.is_parameter_exp():
        return assignment[argument.parameter().name]
    return str(argument.object().name)
