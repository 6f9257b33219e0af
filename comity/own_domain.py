"""A domain of the user's own, its people inferred and its binding checked: ready to be planned."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from comity.binding_file import BindingFile, BoundPerson
from comity.library import looks_like_a_file
from comity.profile import NOBODY, Declared, Profile, load_profile
from comity.values import infer_for, refuse_unknown
from comity_domain.own import Bound, Kind, OptionRefusedError, OwnProblem, People, bind, read_own
from comity_fis import InputError, NominalParameter, Rulebook, closest, load_rulebook
from comity_fis.yaml_file import YamlFile, read_yaml

if TYPE_CHECKING:
    from comity.binding_file import BoundAction
    from comity_fis import Inference


def bound_domain(domain: Path, problem: Path, binding: Path | None = None) -> Bound:
    """Read a domain and a problem, and bind them to people.

    Args:
        domain: A PDDL file.
        problem: A PDDL file for it.
        binding: A binding file; None plans the PDDL as it stands.

    Raises:
        InputError: with file, line and remedy, for whatever cannot be used.
    """
    own = read_own(domain, problem)
    if binding is None:
        return bind(own)
    file = read_yaml(binding)
    written = _Written(file, file.check(BindingFile), own)
    rulebook = written.rulebook()
    written.check(rulebook)
    try:
        bound = bind(own, written.binding.record(), written.people(rulebook))
    except OptionRefusedError as refusal:
        raise refusal.at(file.where(("actions", refusal.action, "options", refusal.argument))) from None
    except InputError as refusal:
        raise refusal.at(file.where(())) from None
    written.refuse_prices_without_costs(bound)
    return bound


@dataclass(frozen=True, slots=True)
class _Written:
    """A binding in its file, beside what it binds."""

    file: YamlFile
    binding: BindingFile
    own: OwnProblem

    def rulebook(self) -> Rulebook:
        name = self.binding.rulebook
        if not isinstance(name, str):
            return load_rulebook(self.file.part("rulebook"))
        beside = self.file.path.parent / name
        with self.file.placing("rulebook"):
            return load_rulebook(beside if looks_like_a_file(name, beside) else name)

    def people(self, rulebook: Rulebook) -> People:
        known = {}
        for name, person in self.binding.people.items():
            with self.file.placing("people", name):
                known[self.own.own_name("object", name)] = self._inferred(name, person, rulebook)
        return People(known, infer_for(NOBODY, rulebook))

    def _inferred(self, name: str, person: str | BoundPerson, rulebook: Rulebook) -> Inference:
        if isinstance(person, str):
            return infer_for(self._load(person, "people", name), rulebook)
        refuse_unknown(person.situation, rulebook, f"the situation of {name}")
        place = ("people", name, "profile")
        if isinstance(person.profile, Profile):
            declared = Declared(person.profile, self.file.part(*place))
        else:
            declared = self._load(person.profile, *place)
        return infer_for(declared, rulebook, situation=person.situation)

    def _load(self, profile: str, *place: str) -> Declared:
        return load_profile(profile, beside=self.file.path.parent, where=self.file.where(place))

    def check(self, rulebook: Rulebook) -> None:
        """Refuse names that nothing bears."""
        problem = self.own.problem
        objects = [one.name for one in problem.all_objects]
        for name in self.binding.people:
            self._known("object", name, objects, "an object of the problem", "people", name)
        for name, action in self.binding.actions.items():
            actions = [one.name for one in problem.actions]
            self._known("action", name, actions, "an action of the domain", "actions", name)
            self._check_action(name, action, rulebook)
        functions = {one.name: one for one in problem.fluents if not one.type.is_bool_type()}
        for name, fluent in self.binding.fluents.items():
            place = ("fluents", name)
            self._known("function", name, functions, "a function of the domain", *place)
            if functions[self.own.own_name("function", name)].arity != 1:
                raise self._refused("a function of one argument, the person", repr(name), _ONE_PERSON, *place)
            self._parameter(fluent.parameter, rulebook, *place, "parameter")
            if isinstance(rulebook.parameters[fluent.parameter], NominalParameter):
                got = f"{fluent.parameter}, which is a word"
                raise self._refused("a numeric parameter", got, "Name another.", *place, "parameter")

    def _check_action(self, name: str, action: BoundAction, rulebook: Rulebook) -> None:
        declared = self.own.problem.action(self.own.own_name("action", name))
        arguments = {parameter.name: parameter for parameter in declared.parameters}
        self._argument(action.person, arguments, name, "actions", name, "person")
        for i, parameter in enumerate(action.parameters):
            self._parameter(parameter, rulebook, "actions", name, "parameters", i)
        for argument, option in action.options.items():
            place = ("actions", name, "options", argument)
            self._argument(argument, arguments, name, *place)
            if argument.lower() == action.person.lower():
                raise self._refused("an argument beside the person", repr(argument), "Name another.", *place)
            self._parameter(option.parameter, rulebook, *place, "parameter")
            possible = [one.name for one in self.own.problem.objects(arguments[argument.lower()].type)]
            for one in option.objects:
                self._known(
                    "object", one, possible, f"an object that ?{argument} may be", *place, "objects", one
                )
            parameter_ = rulebook.parameters[option.parameter]
            if isinstance(parameter_, NominalParameter):
                named = {self.own.own_name("object", one): meaning for one, meaning in option.objects.items()}
                for one in possible:
                    meaning = named.get(one, self.own.as_written(one).lower())
                    if isinstance(meaning, str) and meaning not in parameter_.terms:
                        raise self._refused(
                            f"a category of {option.parameter} for the object {self.own.as_written(one)}",
                            repr(meaning),
                            f"{closest(meaning, parameter_.terms)} Say under `objects` what it stands for; "
                            "`null` is nothing to like or dislike.",
                            *place,
                        )

    def _argument(self, argument: str, known: Iterable[str], action: str, *place: str) -> None:
        if argument.lower() not in known:
            remedy = closest(argument.lower().lstrip("?"), known)
            raise self._refused(f"an argument of the action {action}", repr(argument), remedy, *place)

    def _parameter(self, name: str, rulebook: Rulebook, *place: str | int) -> None:
        if name not in rulebook.parameters:
            remedy = closest(name, rulebook.parameters)
            raise self._refused(f"a parameter of the rulebook {rulebook.name}", repr(name), remedy, *place)

    def _known(self, kind: Kind, name: str, known: Iterable[str], what: str, *place: str) -> None:
        if self.own.own_name(kind, name) not in known:
            words = [self.own.as_written(one) for one in known]
            raise self._refused(what, repr(name), closest(name, words), *place)

    def refuse_prices_without_costs(self, bound: Bound) -> None:
        """Numeric and durative engines do not add up costs of actions: a weight would silently be ignored."""
        for name, action in self.binding.actions.items():
            if action.options and not bound.classical:
                raise self._refused(
                    "options only in a classical domain",
                    "a domain whose actions take time, or whose numbers change or are compared",
                    "Remove `options`; `parameters` and `fluents` work in every domain.",
                    *("actions", name, "options"),
                )

    def _refused(self, expected: str, got: str, remedy: str, *place: str | int) -> InputError:
        return InputError(expected=expected, got=got, remedy=remedy, where=self.file.where(place))


_ONE_PERSON = "Bind a function such as (distance_mm ?p - person)."
