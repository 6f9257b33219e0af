"""What every action costs for every combination of objects, liking included, and what is ruled out."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from fractions import Fraction
from typing import TYPE_CHECKING

from comity_domain.own.binding import ActionBinding, Binding
from comity_domain.own.binding_check import BindingRefusedError
from comity_domain.own.cost import (
    Values,
    arguments_in,
    evaluated,
    groundings,
    initial_numbers,
    objects_for,
    own_costs,
)
from comity_domain.own.liking import Liking, likings
from comity_domain.own.people import People
from comity_domain.own.reading import OwnProblem
from comity_fis.errors import InputError, WrongValueError

if TYPE_CHECKING:
    from unified_planning.model import Action, FNode


MOST_SCALE = 1_000_000
MOST_COST = 10_000_000
"""Of one action, as the planner counts: it adds 200 of them up in 32 bits."""


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


def tables(own: OwnProblem, binding: Binding, people: People | None) -> Mapping[str, Table]:
    """The table of every action, by its name in the problem.

    Raises:
        InputError: a cost below 0, or more combinations than can be written out.
        BindingRefusedError: an option that cannot be priced.
    """
    pricing = _Pricing(own, binding.cost_scale, people, own_costs(own.problem), initial_numbers(own.problem))
    bound = {own.own_name("action", name): name for name in binding.actions}
    return {
        action.name: pricing.bound(action, bound[action.name], binding.actions[bound[action.name]])
        if action.name in bound
        else pricing.plain(action)
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


Likings = Mapping[str, Mapping[str, Mapping[str, Liking]]]
"""By option argument, person and object."""


@dataclass(frozen=True, slots=True)
class _Pricing:
    own: OwnProblem
    scale: int
    people: People | None
    formulas: Mapping[str, FNode | None]
    values: Values

    def plain(self, action: Action) -> Table:
        """The table of an action that nobody's preference is bound to."""
        formula = self.formulas[action.name]
        deciding = arguments_in(formula, action)
        rows, count = {}, 0
        for assignment in groundings(self.own.problem, action, deciding):
            count += 1
            cost = evaluated(formula, assignment, self.values)
            if cost is not None:  # PDDL has no action whose cost has no value
                rows[tuple(assignment.values())] = Row(self.whole(float(cost), action))
        return Table(deciding, rows, complete=len(rows) == count)

    def bound(self, action: Action, bound_as: str, binding: ActionBinding) -> Table:
        """The table of an action whose person likes its options more or less."""
        formula = self.formulas[action.name] if binding.base is None else None
        fixed = Fraction(binding.base or 0)
        likings = self.likings(action, bound_as, binding)
        person = binding.person.lower()
        chosen = {person, *likings, *arguments_in(formula, action)}
        deciding = tuple(one.name for one in action.parameters if one.name in chosen)
        rows, count = {}, 0
        for assignment in groundings(self.own.problem, action, deciding):
            count += 1
            cost = evaluated(formula, assignment, self.values)
            seen = {name: by[assignment[person]][assignment[name]] for name, by in likings.items()}
            if cost is not None and all(one.permitted for one in seen.values()):
                total = float(cost + fixed) + sum(one.dislike for one in seen.values())
                rows[tuple(assignment.values())] = Row(self.whole(total, action), seen)
        return Table(deciding, rows, complete=len(rows) == count)

    def likings(self, action: Action, bound_as: str, binding: ActionBinding) -> Likings:
        """How everybody who may be the action's person sees what may be chosen."""
        assert self.people is not None
        people = self.people
        persons = [one.name for one in objects_for(self.own.problem, action, binding.person.lower())]
        found = {}
        for argument, option in binding.options.items():
            objects = [one.name for one in objects_for(self.own.problem, action, argument.lower())]
            full = option.full(self.own, objects)
            try:
                found[argument.lower()] = {
                    person: likings(full, people[written][option.parameter], written)
                    for person in persons
                    if (written := self.own.as_written(person))
                }
            except WrongValueError as refusal:
                raise BindingRefusedError(
                    ("actions", bound_as, "options", argument),
                    expected=refusal.expected,
                    got=refusal.got,
                    remedy=refusal.remedy,
                ) from None
        return found

    def whole(self, cost: float, action: Action) -> int:
        """A cost as the planner counts it."""
        if not 0.0 <= cost * self.scale < MOST_COST:
            raise InputError(
                expected=f"costs from 0 to less than {MOST_COST // self.scale}",
                got=f"{cost:g} for {self.own.as_written(action.name)}",
                remedy="Planners look for the least sum: state costs as what is lost, from 0 up."
                if cost < 0.0
                else "Measure costs in a larger unit, such as metres instead of millimetres.",
            )
        return round(cost * self.scale)
