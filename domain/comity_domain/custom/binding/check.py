"""Checks that a binding names existing actions, arguments, objects, functions, parameters and categories."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

from comity_domain.custom.binding.binding import ActionBinding, Binding, FluentBinding
from comity_domain.custom.binding.names import BoundNames
from comity_domain.custom.binding.option_check import check_option
from comity_domain.custom.binding.people import BoundPeople
from comity_domain.custom.binding.persons import can_be_people, first_named, strangers
from comity_domain.custom.binding.refusal import BindingRefusedError, Location, refused
from comity_domain.custom.reading.reading import CustomProblem
from comity_fis import NominalParameter
from comity_fis.listing import listed

if TYPE_CHECKING:
    from unified_planning.model import Fluent, Type


def check_binding(own: CustomProblem, binding: Binding, people: BoundPeople) -> None:
    """Reject unknown names, which would silently bind nothing.

    Raises:
        BindingRefusedError: At the first unknown name.
    """
    _Check(own, people).all(binding)


@dataclass(frozen=True, slots=True)
class _Check(BoundNames):
    def all(self, binding: Binding) -> None:
        problem = self.own.problem
        self.once(self.people.known, ("people",))
        self.once(binding.actions, ("actions",))
        self.once(binding.fluents, ("fluents",))
        for name in self.people.known:
            objects = (one.name for one in problem.all_objects)
            self.known(name, objects, "an object of the problem", ("people", name))
        for name, action in binding.actions.items():
            actions = (one.name for one in problem.actions)
            self.known(name, actions, "an action of the domain", ("actions", name))
            self.action(name, action)
        for name, fluent in binding.fluents.items():
            self.fluent(name, fluent)
        self.everybody_matters(binding)

    def everybody_matters(self, binding: Binding) -> None:
        """Reject a person that no binding can reach, whose profile would silently have no effect."""
        bound = [self.types(name)[action.person.lower()] for name, action in binding.actions.items()]
        bound += [self.function(name).signature[0].type for name in binding.fluents]
        reached = {one.name for type_ in bound for one in self.own.problem.objects(type_)}
        for name in self.people.known:
            if bound and name.lower() not in reached:
                raise refused(
                    ("people", name),
                    "an object that a `person` of the binding may be",
                    name,
                    "Remove it, or bind an action or a function whose argument it may be.",
                )

    def types(self, action: str) -> dict[str, Type]:
        """Types of the arguments of an existing action, by name."""
        declared = self.own.problem.action(action.lower())
        return {parameter.name: parameter.type for parameter in declared.parameters}

    def function(self, name: str) -> Fluent:
        """An existing function."""
        return self.own.problem.fluent(name.lower())

    def action(self, name: str, action: ActionBinding) -> None:
        place: Location = ("actions", name)
        types = self.types(name)
        self.argument(action.person, types, name, (*place, "person"))
        self.person(f"?{action.person}", types[action.person.lower()], types, (*place, "person"))
        self.once(action.options, (*place, "options"))
        for i, parameter in enumerate(action.parameters):
            self.parameter(parameter, (*place, "parameters", i))
        for argument, option in action.options.items():
            inside = (*place, "options", argument)
            self.argument(argument, types, name, inside)
            if argument.lower() == action.person.lower():
                raise refused(inside, "an argument beside the person", argument, "Name another.")
            check_option(self, argument, option, types[argument.lower()], inside)

    def fluent(self, name: str, fluent: FluentBinding) -> None:
        place = ("fluents", name)
        functions = [one.name for one in self.own.problem.fluents if not one.type.is_bool_type()]
        self.known(name, functions, "a function of the domain", place)
        function = self.function(name)
        if function.arity != 1:
            remedy = "Bind a function such as (distance_mm ?p - person)."
            raise refused(place, "a function of one argument, the person", name, remedy)
        argument = function.signature[0]
        self.person(f"?{argument.name} of {name}", argument.type, {}, place)
        self.parameter(fluent.parameter, (*place, "parameter"))
        if isinstance(self.people.rulebook.parameters[fluent.parameter], NominalParameter):
            got = f"{fluent.parameter}, which is a word"
            raise refused((*place, "parameter"), "a numeric parameter", got, "Name another.")

    def person(self, bound: str, type_: Type, others: Mapping[str, Type], place: Location) -> None:
        """Reject an argument that may be a non-person: it would silently be an unknown person."""
        if not (no_people := strangers(self.own, self.people, type_)):
            return
        better = listed((f"?{name}" for name in can_be_people(self.own, self.people, others)), "or")
        instead = f"Bind {better}" if better else "Bind another"
        raise BindingRefusedError(
            place,
            expected=f"an argument that is always a person, as {first_named(tuple(self.people.known))}",
            got=f"{bound}, which may be {first_named(no_people)}",
            remedy=f"{instead}; a person among them belongs under `people` (profile: unknown).",
        )
