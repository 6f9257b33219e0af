"""What every action costs for every combination of objects, liking included, and what is ruled out."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction
from typing import TYPE_CHECKING

from comity_domain.own.binding import ActionBinding, Binding
from comity_domain.own.cost import (
    Values,
    arguments_in,
    evaluated,
    groundings,
    initial_numbers,
    objects_for,
    own_costs,
)
from comity_domain.own.liking import Liking, OptionRefusedError, likings
from comity_domain.own.reading import OwnProblem
from comity_fis.errors import InputError, WrongValueError

if TYPE_CHECKING:
    from unified_planning.model import Action, FNode

    from comity_fis.value import Inference

MOST_SCALE = 1_000_000


@dataclass(frozen=True, slots=True)
class Row:
    """One combination of objects that is not ruled out."""

    cost: int
    """As the planner counts it."""
    likings: Mapping[str, Liking] = field(default_factory=dict)
    """Of the person, by option argument."""


@dataclass(frozen=True, slots=True)
class Table:
    """One action."""

    arguments: tuple[str, ...]
    """Those that decide, in the action's order."""
    rows: Mapping[tuple[str, ...], Row]
    """By the objects for `arguments`; what is ruled out is not there."""
    complete: bool
    """Nothing is ruled out."""


@dataclass(frozen=True, slots=True)
class People:
    """Whose parameters there are."""

    known: Mapping[str, Inference]
    """By the object's name in the problem."""
    anybody: Inference
    """Of whom nothing is known."""

    def __getitem__(self, name: str) -> Inference:
        return self.known.get(name, self.anybody)


def tables(own: OwnProblem, binding: Binding, people: People | None) -> Mapping[str, Table]:
    """The table of every action, by its name in the problem.

    Raises:
        InputError: a cost below 0, or more combinations than can be written out.
        OptionRefusedError: an option that cannot be priced.
    """
    formulas, values = own_costs(own.problem), initial_numbers(own.problem)
    bound = {own.own_name(name): name for name in binding.actions}
    return {
        action.name: _table(
            own, action, formulas[action.name], values, bound.get(action.name), binding, people
        )
        for action in own.problem.actions
    }


def natural_scale(own: OwnProblem) -> int:
    """The least factor that makes the domain's own costs whole numbers.

    Raises:
        InputError: if it is too large for the planner.
    """
    values, scale = initial_numbers(own.problem), 1
    for name, formula in own_costs(own.problem).items():
        action = own.problem.action(name)
        for assignment in groundings(own.problem, action, arguments_in(formula, action)):
            scale = math.lcm(scale, (evaluated(formula, assignment, values) or Fraction(0)).denominator)
    if scale > MOST_SCALE:
        raise InputError(
            expected="costs that are multiples of 0.000001",
            got="finer ones",
            remedy="Round the costs in the problem.",
        )
    return scale


def _table(
    own: OwnProblem,
    action: Action,
    formula: FNode | None,
    values: Values,
    bound_as: str | None,
    binding: Binding,
    people: People | None,
) -> Table:
    bound = None if bound_as is None else binding.actions[bound_as]
    base = formula if bound is None or bound.base is None else None
    own_arguments = arguments_in(base, action)
    if bound is None or bound_as is None or people is None:
        liked: dict[str, Mapping[str, Mapping[str, Liking]]] = {}
        deciding: Sequence[str] = own_arguments
    else:
        liked = _liked(own, action, bound_as, bound, people)
        chosen = {*own_arguments, bound.person.lower(), *(name.lower() for name in bound.options)}
        deciding = [one.name for one in action.parameters if one.name in chosen]
    rows: dict[tuple[str, ...], Row] = {}
    count = 0
    for assignment in groundings(own.problem, action, deciding):
        count += 1
        fixed = None if bound is None or bound.base is None else Fraction(bound.base)
        cost = evaluated(formula, assignment, values) if fixed is None else fixed
        if cost is None:
            continue  # a function without a value: PDDL has no such action
        seen = {} if bound is None else _seen(liked, bound.person.lower(), assignment)
        if all(one.permitted for one in seen.values()):
            total = float(cost) + sum(one.dislike for one in seen.values())
            rows[tuple(assignment.values())] = Row(_whole(total * binding.cost_scale, action, own), seen)
    return Table(tuple(deciding), rows, complete=len(rows) == count)


def _liked(
    own: OwnProblem, action: Action, bound_as: str, bound: ActionBinding, people: People
) -> dict[str, Mapping[str, Mapping[str, Liking]]]:
    """By argument and person, how they see each object."""
    persons = [one.name for one in objects_for(own.problem, action, bound.person.lower())]
    found: dict[str, Mapping[str, Mapping[str, Liking]]] = {}
    for argument, option in bound.options.items():
        meanings = {own.own_name(name): meaning for name, meaning in option.objects.items()}
        objects = [one.name for one in objects_for(own.problem, action, argument.lower())]
        full = {name: meanings.get(name, own.as_written(name).lower()) for name in objects}
        renamed = replace(option, objects=full)
        by_person = {}
        for person in persons:
            try:
                by_person[person] = likings(renamed, objects, people[person][option.parameter])
            except WrongValueError as error:
                whose = WrongValueError(
                    expected=f"for {own.as_written(person)} {error.expected}",
                    got=error.got,
                    remedy=error.remedy,
                )
                raise OptionRefusedError(bound_as, argument, whose) from None
        found[argument.lower()] = by_person
    return found


def _seen(
    liked: Mapping[str, Mapping[str, Mapping[str, Liking]]], person: str, assignment: Mapping[str, str]
) -> dict[str, Liking]:
    return {
        argument: by_person[assignment[person]][assignment[argument]] for argument, by_person in liked.items()
    }


def _whole(cost: float, action: Action, own: OwnProblem) -> int:
    if not 0.0 <= cost < 1e9:
        raise InputError(
            expected="costs from 0 to 1000000000",
            got=f"{cost:g} for {own.as_written(action.name)}",
            remedy="Planners add costs up and look for the least: state them as numbers from 0 up.",
        )
    return round(cost)
