"""A problem with everything that a binding says built in, as a planner takes it."""

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
"""What functions are for people, by function and object."""


@dataclass(frozen=True, slots=True)
class Bound:
    """Ready to be planned."""

    own: CustomProblem
    binding: Binding
    people: BoundPeople | None
    problem: Problem
    """What the planner gets: one whole number for each action's cost."""
    tables: Mapping[str, Table]
    """By action; empty where the domain is more than classical."""
    beyond: Beyond | None
    """What is more than classical: nothing where only costs are numeric, and actions take no time."""
    rulings: Mapping[str, str]
    """By action, the predicate that was made up to rule out some of its combinations of objects."""
    dropped: tuple[str, ...]
    """Functions that are in the costs and not in `problem`, because they are no whole numbers."""
    engine: str | None = None
    """The one that is to plan, by its name in unified-planning; None where Comity takes one that fits."""

    @property
    def classical(self) -> bool:
        """Whether nothing but costs is numeric, and actions take no time."""
        return self.beyond is None

    @property
    def cost_scale(self) -> int:
        """A cost of so much is 1 of the domain's own."""
        return self.binding.cost_scale if self.classical else 1


def bind(own: CustomProblem, binding: Binding | None = None, people: BoundPeople | None = None) -> Bound:
    """Build a binding into a problem.

    Args:
        own: The domain and the problem.
        binding: What comes from people; None plans the domain as it is.
        people: Their parameters; needed with a binding.

    Raises:
        InputError: a cost that no planner takes.
        BindingRefusedError: something in the binding that does not fit.
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
    """The problem with one whole number per action's cost; functions that are not whole are left out."""
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
            continue  # no plan is better with it, and Fast Downward refuses it
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
    """The same problem with other costs, by action."""
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
    """A precondition that holds for what is not ruled out: the name of its predicate."""
    allowed = new_fluent(f"allowed_{action.name}", "bool", action, table.arguments, problem)
    for objects in table.rows:
        problem.set_initial_value(allowed(*map(problem.object, objects)), True)
    action.add_precondition(allowed(*map(action.parameter, table.arguments)))
    return str(allowed.name)


def _price(action: InstantaneousAction, table: Table, problem: Problem) -> FNode:
    """The action's cost as one constant or one function."""
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
    """A predicate, false by default, or a function over some arguments of an action, added to a problem.

    Args:
        wanted: Its name, as far as that is free.
        kind: Which of the two.
        action: With the arguments.
        arguments: Some of them.
        problem: Where it is added.
        default: Of a function; None where it has no value by default.
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
