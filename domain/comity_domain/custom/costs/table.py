"""Cost of every action for every combination of objects, with preferences; excluded combinations."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from typing import TYPE_CHECKING

from comity_domain.custom.binding.binding import ActionBinding, Binding
from comity_domain.custom.binding.people import BoundPeople
from comity_domain.custom.binding.refusal import BindingRefusedError
from comity_domain.custom.costs.cost import (
    Assignment,
    Values,
    arguments_in,
    atoms_in,
    evaluated,
    groundings,
    initial_numbers,
    objects_for,
    own_costs,
)
from comity_domain.custom.costs.preference import Preference, preferences
from comity_domain.custom.reading.places import Atom
from comity_domain.custom.reading.reading import CustomProblem
from comity_fis.errors import InputError, Where, WrongValueError

if TYPE_CHECKING:
    from unified_planning.model import Action, FNode


MOST_SCALE = 1_000_000
MOST_COST = 10_000_000
"""Maximum cost of one action, in planner units: the planner adds up 200 of them in 32 bits."""


@dataclass(frozen=True, slots=True)
class CostRow:
    """A permitted combination of objects, with its cost."""

    cost: int
    """Total cost in planner units."""
    base: float
    """Cost without preferences, in units of the domain's own cost."""
    preferences: Mapping[str, Preference] = field(default_factory=dict)
    """The person's preferences, by option argument."""

    @property
    def preference_cost(self) -> float:
        """Sum of the preference costs, in units of the domain's own cost."""
        return sum(preference.preference_cost for preference in self.preferences.values())

    def parts(self) -> Mapping[str, int]:
        """Parts that add up to `cost`: `domain`, and one per option, by its argument."""
        exact = {"domain": self.base} | {
            f"?{name}": one.preference_cost for name, one in self.preferences.items()
        }
        total = sum(exact.values()) or 1.0
        counted = {name: self.cost * part / total for name, part in exact.items()}
        whole = {name: math.floor(part) for name, part in counted.items()}
        nearest = sorted(counted, key=lambda name: whole[name] - counted[name])
        for name in nearest[: self.cost - sum(whole.values())]:
            whole[name] += 1
        return whole


@dataclass(frozen=True, slots=True)
class Table:
    """The costs of one action."""

    arguments: tuple[str, ...]
    """The arguments that determine the cost, in the action's order."""
    rows: Mapping[tuple[str, ...], CostRow]
    """Costs by the objects for `arguments`; excluded combinations are missing."""
    unpriced: Mapping[tuple[str, ...], Atom | None]
    """Combinations without a cost, with the first function that has no value; None for a division by 0."""
    complete: bool
    """Whether no combination is excluded."""


def tables(own: CustomProblem, binding: Binding, people: BoundPeople | None) -> Mapping[str, Table]:
    """The table of every action, by its name in the problem.

    Raises:
        InputError: A cost is below 0, or there are too many combinations.
        BindingRefusedError: An option cannot be priced.
    """
    pricing = _Pricing(own, binding.cost_scale, people, own_costs(own.problem), initial_numbers(own.problem))
    bound = {name.lower(): name for name in binding.actions}
    return {
        action.name: pricing.table(action, bound.get(action.name, ""), binding.of(action.name))
        for action in own.problem.actions
    }


def natural_scale(own: CustomProblem) -> int:
    """The least factor that makes all of the domain's own costs whole numbers.

    Raises:
        InputError: The factor is too large for the planner.
    """
    values, scale = initial_numbers(own.problem), 1
    for name, formula in own_costs(own.problem).items():
        action = own.problem.action(name)
        where = own.places.of_cost(name)
        for assignment in groundings(own.problem, action, arguments_in(formula, action), where):
            cost = evaluated(formula, assignment, values) or Fraction(0)
            scale = math.lcm(scale, cost.denominator)
            if scale > MOST_SCALE:
                atoms = atoms_in(formula, assignment)
                finest = max(atoms, key=lambda atom: values[atom].denominator, default=None)
                raise InputError(
                    expected=f"costs that are multiples of {1 / MOST_SCALE:.6f}",
                    got=f"{float(cost):.15g} for {own.as_written(name)}",
                    remedy="Round it, or bind it with a `cost_scale`: the planner counts in whole numbers.",
                    where=own.places.numbers().get(finest, where) if finest else where,
                )
    return scale


Preferences = Mapping[str, Mapping[str, Mapping[str, Preference]]]
"""Preferences by option argument, person and object."""


@dataclass(frozen=True, slots=True)
class _Pricing:
    own: CustomProblem
    scale: int
    people: BoundPeople | None
    formulas: Mapping[str, FNode | None]
    values: Values

    def table(self, action: Action, bound_as: str = "", binding: ActionBinding | None = None) -> Table:
        """The cost table of an action.

        Args:
            action: The action.
            bound_as: Its name in the binding.
            binding: Its binding; None if it has none.
        """
        base = None if binding is None else binding.base
        formula, fixed = (self.formulas[action.name], 0.0) if base is None else (None, base)
        person = "" if binding is None else binding.person.lower()
        preferences = {} if binding is None else self.preferences(action, bound_as, binding)
        chosen = {person, *preferences, *arguments_in(formula, action)}
        deciding = tuple(one.name for one in action.parameters if one.name in chosen)
        rows, unpriced, count = {}, {}, 0
        for assignment in self.groundings(action, deciding):
            count += 1
            cost = evaluated(formula, assignment, self.values)
            if cost is None:  # PDDL gives no semantics to an action whose cost is undefined
                unpriced[tuple(assignment.values())] = self.missing(formula, assignment)
                continue
            seen = {name: by[assignment[person]][assignment[name]] for name, by in preferences.items()}
            if all(one.permitted for one in seen.values()):
                own = float(cost) + fixed
                total = own + sum(one.preference_cost for one in seen.values())
                if binding is not None and own * self.scale < MOST_COST <= total * self.scale:
                    raise _too_heavy(bound_as, binding, seen, MOST_COST / self.scale)
                price = self.whole(total, action, formula, assignment)
                rows[tuple(assignment.values())] = CostRow(price, own, seen)
        return Table(deciding, rows, unpriced, complete=len(rows) == count)

    def groundings(self, action: Action, deciding: Sequence[str]) -> Iterator[Assignment]:
        """Every combination of objects for the arguments that determine the cost."""
        return groundings(self.own.problem, action, deciding, self.own.places.of_cost(action.name))

    def missing(self, formula: FNode | None, assignment: Assignment) -> Atom | None:
        """The first function in a formula that has no value."""
        return next((atom for atom in atoms_in(formula, assignment) if atom not in self.values), None)

    def preferences(self, action: Action, bound_as: str, binding: ActionBinding) -> Preferences:
        """The preferences of every possible person of the action over its options."""
        assert self.people is not None
        people = self.people
        persons = objects_for(self.own.problem, action, binding.person.lower())
        found = {}
        for argument, option in binding.options.items():
            full = option.full(self.own, objects_for(self.own.problem, action, argument.lower()))
            try:
                found[argument.lower()] = {
                    person: preferences(full, people[written][option.parameter], written)
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

    def whole(self, cost: float, action: Action, formula: FNode | None, assignment: Assignment) -> int:
        """A cost in planner units."""
        if 0.0 <= cost * self.scale < MOST_COST:
            return round(cost * self.scale)
        names = ", ".join(map(self.own.as_written, assignment.values()))
        raise InputError(
            expected=f"costs from 0 to less than {MOST_COST / self.scale:g}",
            got=f"{cost:g} for {self.own.as_written(action.name)}" + (f" with {names}" if names else ""),
            remedy="Planners look for the least sum: state costs as what is lost, from 0 up."
            if cost < 0.0
            else "Measure costs in a larger unit, such as metres instead of millimetres, or bind them with a "
            "smaller `cost_scale`.",
            where=self.blamed(formula, assignment, lowest=cost < 0.0) or self.own.places.of_cost(action.name),
        )

    def blamed(self, formula: FNode | None, assignment: Assignment, *, lowest: bool) -> Where | None:
        """Location of the lowest or highest number that a cost reads; None if it reads none."""
        places = self.own.places.numbers()
        stated = [atom for atom in atoms_in(formula, assignment) if atom in places]
        by_value = sorted(stated, key=lambda atom: self.values[atom])
        return places[by_value[0 if lowest else -1]] if by_value else None


def _too_heavy(
    bound_as: str, binding: ActionBinding, seen: Mapping[str, Preference], limit: float
) -> BindingRefusedError:
    """The error for a weight that makes a cost too large for the planner."""
    worst = max(binding.options, key=lambda name: seen[name.lower()].preference_cost)
    return BindingRefusedError(
        ("actions", bound_as, "options", worst, "weight"),
        expected=f"a weight with which {bound_as} costs less than {limit:g}",
        got=f"{binding.options[worst].weight:g}",
        remedy="Give a smaller weight, or a smaller `cost_scale`.",
    )
