"""A domain of the user's own, its people inferred and its binding checked: ready to be planned."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from comity.binding_file import BindingFile, BoundPerson
from comity.library import looks_like_a_file
from comity.profile import Declared, Profile, day_for, load_profile
from comity.values import Facts, infer_for, refuse_unknown
from comity_domain.own import BindingRefusedError, Bound, OwnProblem, People, bind, read_own
from comity_fis import InputError, Rulebook, Where, load_rulebook
from comity_fis.yaml_file import YamlFile, read_yaml

if TYPE_CHECKING:
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
    try:
        return bind(own) if binding is None else _bound(own, binding)
    except InputError as refusal:
        raise refusal.at(Where(str(problem))) from None


def _bound(own: OwnProblem, path: Path) -> Bound:
    file = read_yaml(path)
    written = _Written(file, file.check(BindingFile))
    people = written.people(written.rulebook())
    try:
        return bind(own, written.binding.record(), people)
    except BindingRefusedError as refusal:
        raise refusal.at(file.where(refusal.location)) from None


@dataclass(frozen=True, slots=True)
class _Written:
    """A binding in its file."""

    file: YamlFile
    binding: BindingFile

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
                known[name] = self._inferred(name, person, rulebook)
        return People(known, rulebook)

    def _inferred(self, name: str, person: str | BoundPerson, rulebook: Rulebook) -> Inference:
        if isinstance(person, str):
            return self._on_the_day(self._load(person, "people", name), rulebook)
        refuse_unknown(person.situation, rulebook, f"the situation of {name}")
        place = ("people", name, "profile")
        if isinstance(person.profile, Profile):
            declared = Declared(person.profile, self.file.part(*place))
        else:
            declared = self._load(person.profile, *place)
        return self._on_the_day(declared, rulebook, person.situation)

    def _on_the_day(
        self, declared: Declared, rulebook: Rulebook, situation: Facts | None = None
    ) -> Inference:
        day = day_for(self.binding.at, declared.profile)
        return infer_for(declared, rulebook, situation=situation, at=day)

    def _load(self, profile: str, *place: str) -> Declared:
        return load_profile(profile, beside=self.file.path.parent, where=self.file.where(place))
