"""A planning problem with a binding compiled in, ready for a planner."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Literal

from comity_domain.custom.binding.binding import Binding
from comity_domain.custom.binding.check import check_binding
from comity_domain.custom.binding.option_check import refuse_options
from comity_domain.custom.binding.people import BoundPeople
from comity_domain.custom.costs.classical import Beyond, beyond_classical
from comity_domain.custom.costs.counter import counter_as_costs
from comity_domain.custom.costs.table import Table, natural_scale, tables
from comity_domain.custom.reading.reading import COST, CustomProblem

if TYPE_CHECKING:
    from unified_planning.model import Action, Fluent, FNode, InstantaneousAction, Problem

Numbers = Mapping[tuple[str, str], int]
"""Values of bound functions, keyed by function and object."""


@dataclass(frozen=True, slots=True)
class Bound:
    """A problem that is ready for planning."""

    own: CustomProblem
    binding: Binding
    people: BoundPeople | None
    problem: Problem
    """The problem for the planner, with one integer cost per action."""
    tables: Mapping[str, Table]
    """Cost tables by action; empty for a domain beyond classical planning."""
    beyond: Beyond | None
    """The feature beyond classical planning; None if only costs are numeric and actions take no time."""
    rulings: Mapping[str, str]
    """For each action with excluded combinations of objects, the added predicate that excludes them."""
    dropped: tuple[str, ...]
    """Functions used in the costs but left out of `problem` because their values are not integers."""
    engine: str | None = None
    """Name of the engine in unified-planning; None lets Comity choose a suitable one."""

    @property
    def classical(self) -> bool:
        """Whether only costs are numeric and actions take no time."""
        return self.beyond is None

    @property
    def cost_scale(self) -> int:
        """Planner cost units per unit of the domain's own cost."""
        return self.binding.cost_scale if self.classical else 1


def bind(own: CustomProblem, binding: Binding | None = None, people: BoundPeople | None = None) -> Bound:
    """Compile a binding into a problem.

    Args:
        own: The domain and the problem.
        binding: What comes from people's parameters; None plans the domain unchanged.
        people: Their inferred parameters; required with a binding.

    Raises:
        InputError: A cost is unsuitable for planners.
        BindingRefusedError: Part of the binding does not fit.
    """
    if binding is not None and people is None:
        raise ValueError("a binding needs people, if only the rulebook for those without a profile")
    own = replace(own, problem=counter_as_costs(own.problem))
    if binding is not None and people is not None:
        check_binding(own, binding, people)
    numbers = _numbers(own, binding, people) if binding and people else {}
    filled = replace(own, problem=_with_numbers(own.problem, numbers))
    if beyond := beyond_classical(filled.problem):
        refuse_options(binding or Binding(), f"{beyond.words} ({own.places.of(beyond.part)})")
        return Bound(filled, binding or Binding(), people, filled.problem, {}, beyond, {}, ())
    if binding is None:
        binding = Binding(cost_scale=natural_scale(filled))
    priced = tables(filled, binding, people)
    problem, rulings, dropped = _compiled(filled.problem, priced)
    return Bound(filled, binding, people, problem, priced, None, rulings, dropped)


def _numbers(own: CustomProblem, binding: Binding, people: BoundPeople) -> Numbers:
    """Each person's value of each bound function."""
    found = {}
    for written, bound in binding.fluents.items():
        name = written.lower()
        for person in own.problem.objects(own.problem.fluent(name).signature[0].type):
            value = people[own.as_written(person.name)][bound.parameter].number
            found[name, person.name] = round(value * bound.scale)
    return found


def _with_numbers(problem: Problem, numbers: Numbers) -> Problem:
    if not numbers:
        return problem
    filled = problem.clone()
    for (function, person), value in numbers.items():
        filled.set_initial_value(filled.fluent(function)(filled.object(person)), value)
    return filled


def _compiled(
    problem: Problem, priced: Mapping[str, Table]
) -> tuple[Problem, Mapping[str, str], tuple[str, ...]]:
    """The problem with one integer cost per action, without functions that are not integers."""
    from unified_planning.model import Problem as Empty
    from unified_planning.model.metrics import MinimizeActionCosts

    compiled = Empty(problem.name, problem.environment)
    dropped = _copy_fluents(problem, compiled)
    compiled.add_objects(problem.all_objects)
    for fluent, value in problem.explicit_initial_values.items():
        kept = compiled.fluent(fluent.fluent().name) if compiled.has_fluent(fluent.fluent().name) else None
        if kept is not None:
            compiled.set_initial_value(kept(*fluent.args), value)
    costs, rulings = {}, {}
    for action in problem.actions:
        if not action.effects:
            continue  # it never improves a plan, and Fast Downward rejects it
        priced_action, table = action.clone(), priced[action.name]
        if not table.complete:
            rulings[action.name] = _rule_out(priced_action, table, compiled)
        costs[priced_action] = _price(priced_action, table, compiled)
        compiled.add_action(priced_action)
    for goal in problem.goals:
        compiled.add_goal(goal)
    compiled.add_quality_metric(MinimizeActionCosts(costs, environment=problem.environment))
    return compiled, rulings, dropped


def priced_anew(problem: Problem, costs: Mapping[str, FNode]) -> Problem:
    """A copy with other action costs."""
    from unified_planning.model.metrics import MinimizeActionCosts

    problem.clear_quality_metrics()
    by_action = {problem.action(name): cost for name, cost in costs.items()}
    problem.add_quality_metric(MinimizeActionCosts(by_action, environment=problem.environment))
    return problem


def with_goals(problem: Problem, goals: Iterable[FNode]) -> Problem:
    """A copy with other goals."""
    copy = problem.clone()
    copy.clear_goals()
    for goal in goals:
        copy.add_goal(goal)
    return copy


def require(action: Action, conditions: Iterable[FNode]) -> None:
    """Replace an action's preconditions."""
    action.clear_preconditions()
    for condition in conditions:
        action.add_precondition(condition)


def _copy_fluents(problem: Problem, compiled: Problem) -> tuple[str, ...]:
    from unified_planning.model import Fluent

    types, dropped = problem.environment.type_manager, []
    fractions = {
        fluent.fluent().name
        for fluent, value in problem.explicit_initial_values.items()
        if value.is_real_constant() or (value.is_int_constant() and value.constant_value() < 0)
    }
    for fluent in problem.fluents:
        if fluent.type.is_bool_type():
            compiled.add_fluent(fluent, default_initial_value=False)
        elif fluent.name in fractions or fluent.name == COST:
            dropped.append(fluent.name)
        else:
            whole = Fluent(fluent.name, types.IntType(), fluent.signature, problem.environment)
            compiled.add_fluent(whole)
    return tuple(dropped)


def _rule_out(action: InstantaneousAction, table: Table, problem: Problem) -> str:
    """Add a precondition that holds for permitted combinations only; returns the name of its predicate."""
    allowed = new_fluent(f"allowed_{action.name}", "bool", action, table.arguments, problem)
    for objects in table.rows:
        problem.set_initial_value(allowed(*map(problem.object, objects)), True)
    action.add_precondition(allowed(*map(action.parameter, table.arguments)))
    return str(allowed.name)


def _price(action: InstantaneousAction, table: Table, problem: Problem) -> FNode:
    """The action's cost as one constant or one function term."""
    costs = {row.cost for row in table.rows.values()}
    if len(costs) < 2:
        return problem.environment.expression_manager.Int(min(costs, default=0))
    function = new_fluent(f"cost_of_{action.name}", "int", action, table.arguments, problem)
    for objects, row in table.rows.items():
        problem.set_initial_value(function(*map(problem.object, objects)), row.cost)
    return function(*map(action.parameter, table.arguments))


def new_fluent(
    wanted: str,
    kind: Literal["bool", "int"],
    action: Action,
    arguments: Iterable[str],
    problem: Problem,
    *,
    default: int | None = None,
) -> Fluent:
    """Add a predicate (default false) or a function over some arguments of an action to a problem.

    Args:
        wanted: Preferred name; changed if it is taken.
        kind: `bool` for a predicate, `int` for a function.
        action: The action that has the arguments.
        arguments: Names of the arguments.
        problem: The problem to extend.
        default: Default value of a function; None for no default.
    """
    from unified_planning.model import Fluent, Parameter

    environment, name = problem.environment, wanted
    while problem.has_name(name):
        name += "_"
    signature = [Parameter(one, action.parameter(one).type, environment) for one in arguments]
    types = environment.type_manager
    fluent = Fluent(name, types.BoolType() if kind == "bool" else types.IntType(), signature, environment)
    problem.add_fluent(fluent, default_initial_value=False if kind == "bool" else default)
    return fluent
