"""Whether a binding names what there is: actions, arguments, objects, functions, parameters, categories."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

from comity_domain.own.binding import ActionBinding, Binding, FluentBinding, Option, OptionValue
from comity_domain.own.people import People
from comity_domain.own.persons import can_be_people, listed, strangers
from comity_domain.own.reading import Kind, OwnProblem
from comity_fis import NominalParameter, NumericParameter
from comity_fis.errors import WrongValueError, closest

if TYPE_CHECKING:
    from unified_planning.model import Fluent, Type

Location = tuple[str | int, ...]
"""The way to a value of a binding, as its file nests it."""


class BindingRefusedError(WrongValueError):
    """A binding that does not fit its domain.

    Args:
        location: The value's.
        expected: What would have been right.
        got: What came.
        remedy: What to do.
    """

    def __init__(self, location: Location, *, expected: str, got: object, remedy: str) -> None:
        self.location = location
        super().__init__(expected=expected, got=got, remedy=remedy)


def check_binding(own: OwnProblem, binding: Binding, people: People) -> None:
    """Refuse a name that nothing bears; it would silently bind nothing.

    Raises:
        BindingRefusedError: at the first one.
    """
    _Check(own, people).all(binding)


@dataclass(frozen=True, slots=True)
class _Check:
    own: OwnProblem
    people: People

    def all(self, binding: Binding) -> None:
        problem = self.own.problem
        self.once(self.people.known, ("people",))
        self.once(binding.actions, ("actions",))
        self.once(binding.fluents, ("fluents",))
        for name in self.people.known:
            objects = (one.name for one in problem.all_objects)
            self.known("object", name, objects, "an object of the problem", ("people", name))
        for name, action in binding.actions.items():
            actions = (one.name for one in problem.actions)
            self.known("action", name, actions, "an action of the domain", ("actions", name))
            self.action(name, action)
        for name, fluent in binding.fluents.items():
            self.fluent(name, fluent)
        self.everybody_matters(binding)

    def everybody_matters(self, binding: Binding) -> None:
        """Refuse somebody whom nothing bound can be for: their profile would silently mean nothing."""
        bound = [self.types(name)[action.person.lower()] for name, action in binding.actions.items()]
        bound += [self.function(name).signature[0].type for name in binding.fluents]
        reached = {one.name for type_ in bound for one in self.own.problem.objects(type_)}
        for name in self.people.known:
            if bound and self.own.own_name("object", name) not in reached:
                raise _refused(
                    ("people", name),
                    "an object that a `person` of the binding may be",
                    name,
                    "Remove it, or bind an action or a function whose argument it may be.",
                )

    def types(self, action: str) -> dict[str, Type]:
        """Of the arguments of an action that is known."""
        declared = self.own.problem.action(self.own.own_name("action", action))
        return {parameter.name: parameter.type for parameter in declared.parameters}

    def function(self, name: str) -> Fluent:
        """One that is known."""
        return self.own.problem.fluent(self.own.own_name("function", name))

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
                raise _refused(inside, "an argument beside the person", argument, "Name another.")
            self.option(argument, option, types[argument.lower()], inside)

    def option(self, argument: str, option: Option, type_: Type, place: Location) -> None:
        self.parameter(option.parameter, (*place, "parameter"))
        possible = [one.name for one in self.own.problem.objects(type_)]
        self.once(option.objects, (*place, "objects"))
        for name in option.objects:
            what = f"an object that ?{argument} may be"
            self.known("object", name, possible, what, (*place, "objects", name))
        parameter = self.people.rulebook.parameters[option.parameter]
        if not isinstance(parameter, NominalParameter):
            for name, meaning in option.objects.items():
                _in_range(meaning, parameter, (*place, "objects", name))
            return
        for name, meaning in option.full(self.own, possible).objects.items():
            if isinstance(meaning, str) and meaning not in parameter.terms:
                remedy = closest(meaning, parameter.terms)
                raise _refused(
                    place,
                    f"a category of {option.parameter} for the object {self.own.as_written(name)}",
                    meaning,
                    f"{remedy} Say under `objects` what it stands for; `null` is nothing to like or dislike.",
                )

    def fluent(self, name: str, fluent: FluentBinding) -> None:
        place = ("fluents", name)
        functions = [one.name for one in self.own.problem.fluents if not one.type.is_bool_type()]
        self.known("function", name, functions, "a function of the domain", place)
        function = self.function(name)
        if function.arity != 1:
            remedy = "Bind a function such as (distance_mm ?p - person)."
            raise _refused(place, "a function of one argument, the person", name, remedy)
        argument = function.signature[0]
        self.person(f"?{argument.name} of {name}", argument.type, {}, place)
        self.parameter(fluent.parameter, (*place, "parameter"))
        if isinstance(self.people.rulebook.parameters[fluent.parameter], NominalParameter):
            got = f"{fluent.parameter}, which is a word"
            raise _refused((*place, "parameter"), "a numeric parameter", got, "Name another.")

    def once(self, names: Iterable[str], place: Location) -> None:
        """Refuse what differs in capitals only: PDDL does not tell them apart, and one would silently win."""
        seen: dict[str, str] = {}
        for name in names:
            if (first := seen.setdefault(name.lower(), name)) != name:
                remedy = "Keep one of them: PDDL does not tell capitals apart."
                raise _refused((*place, name), f"one of {first} and {name}", name, remedy)

    def person(self, bound: str, type_: Type, others: Mapping[str, Type], place: Location) -> None:
        """Refuse what may be an object that is nobody: it would silently be somebody unknown."""
        if not (nobody := strangers(self.own, self.people, type_)):
            return
        better = " or ".join(f"?{name}" for name in can_be_people(self.own, self.people, others))
        instead = f"Bind {better}" if better else "Bind another"
        raise BindingRefusedError(
            place,
            expected=f"an argument that is always somebody, as {listed(tuple(self.people.known))}",
            got=f"{bound}, which may be {listed(nobody)}",
            remedy=f"{instead}; whoever of them is a person belongs under `people` (profile: unknown).",
        )

    def argument(self, argument: str, known: Iterable[str], action: str, place: Location) -> None:
        if argument.lower() not in known:
            remedy = closest(argument.lower().lstrip("?"), known)
            raise _refused(place, f"an argument of the action {action}", argument, remedy)

    def parameter(self, name: str, place: Location) -> None:
        rulebook = self.people.rulebook
        if name not in rulebook.parameters:
            remedy = closest(name, rulebook.parameters)
            raise _refused(place, f"a parameter of the rulebook {rulebook.name}", name, remedy)

    def known(self, kind: Kind, name: str, known: Iterable[str], what: str, place: Location) -> None:
        names = list(known)
        if self.own.own_name(kind, name) not in names:
            raise _refused(place, what, name, closest(name, map(self.own.as_written, names)))


def refuse_options(binding: Binding, beyond: str) -> None:
    """Refuse all options: engines of numeric and durative domains do not add up costs of actions.

    Args:
        binding: Any.
        beyond: What is more than classical about the domain, in words.

    Raises:
        BindingRefusedError: at the first one, which would silently have no weight.
    """
    for name in _with_options(binding):
        raise _refused(
            ("actions", name, "options"),
            "options only in a classical domain",
            f"options beside {beyond}",
            "Remove one of the two; `parameters` and `fluents` work in every domain.",
        )


def _with_options(binding: Binding) -> Iterator[str]:
    return (name for name, action in binding.actions.items() if action.options)


def _in_range(meaning: OptionValue, parameter: NumericParameter, place: Location) -> None:
    """Refuse numbers that the parameter never has: nobody could like them."""
    low = min(parameter.rules.low, parameter.ask.low)
    high = max(parameter.rules.high, parameter.ask.high)
    ends = meaning if isinstance(meaning, tuple) else (meaning,)
    for end in ends:
        if isinstance(end, int | float) and not low <= end <= high:
            raise BindingRefusedError(
                place,
                expected=f"numbers from {low:g} to {high:g} {parameter.unit}, which {parameter.name} can be",
                got=f"{end:g}",
                remedy=f"Measure in {parameter.unit}, and keep to what the parameter can be.",
            )


def _refused(place: Location, expected: str, got: str, remedy: str) -> BindingRefusedError:
    return BindingRefusedError(place, expected=expected, got=repr(got), remedy=remedy)
