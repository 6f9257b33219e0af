"""A custom domain ready for planning: people's parameters inferred, the binding checked."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from datetime import date
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from comity.parameters.consent import in_this_meeting
from comity.parameters.values import Facts, infer_for, refuse_unknown
from comity.people.profile import Declared, Profile, day_for, load_profile
from comity.specification.binding_file import BindingFile, BoundPerson
from comity_domain.custom import (
    BindingRefusedError,
    Bound,
    BoundPeople,
    CustomPlan,
    CustomProblem,
    PlanningClock,
    bind,
    in_one_process,
    planned,
    read_custom,
)
from comity_fis import InputError, Rulebook, Where, load_rulebook, unknown_word
from comity_fis.validation.name_or_path import looks_like_a_file
from comity_fis.validation.yaml_file import YamlFile, read_yaml

if TYPE_CHECKING:
    from comity_domain.custom import Location
    from comity_fis import Inference


@dataclass(frozen=True, slots=True)
class Others:
    """Overrides of a binding."""

    profiles: Mapping[str, str]
    """Profiles, by person."""
    rulebook: str | None = None
    at: date | None = None


AS_WRITTEN = Others({})


def bound_domain(
    domain: Path, problem: Path, binding: Path | None = None, others: Others = AS_WRITTEN
) -> Bound:
    """Read a domain and a problem, and bind them to people.

    Args:
        domain: A PDDL file.
        problem: A PDDL file for it.
        binding: A binding file; None plans the PDDL as it stands.
        others: Other profiles, another rulebook or another day than the binding's.

    Raises:
        InputError: with file, line and remedy, for whatever cannot be used.
    """
    own = read_custom(domain, problem)
    try:
        return bind(own) if binding is None else _bound(own, binding, others)
    except InputError as refusal:
        raise refusal.at(Where(str(problem))) from None


def plan_domain(
    domain: Path,
    problem: Path,
    binding: Path | None = None,
    others: Others = AS_WRITTEN,
    *,
    engine: str | None = None,
    time_limit_s: float = 30.0,
) -> CustomPlan:
    """Read, bind and plan in a separate process, which is ended at its limit.

    Args:
        domain: As for `bound_domain`.
        problem: As for `bound_domain`.
        binding: As for `bound_domain`.
        others: As for `bound_domain`.
        engine: The name of an engine in unified-planning; None takes one that fits.
        time_limit_s: Wall-clock time for everything, > 0 [s]; there is an answer at most 5 s later.

    Raises:
        InputError: with file, line and remedy, for whatever cannot be used.
        PlanningFailed: There is no plan, or none was found within the limit.
    """
    call = partial(_planned, (domain, problem, binding, others), engine, PlanningClock(time_limit_s))
    return in_one_process(call, limit_s=time_limit_s)


def _planned(
    files: tuple[Path, Path, Path | None, Others], engine: str | None, clock: PlanningClock
) -> CustomPlan:
    return planned(replace(bound_domain(*files), engine=engine), clock)


def _bound(own: CustomProblem, path: Path, others: Others) -> Bound:
    file = read_yaml(path)
    written = _Written(file, file.check(BindingFile), others)
    _refuse_strangers(own, written.binding, others)
    people = written.people(written.rulebook())
    try:
        return bind(own, written.binding.record(), people)
    except BindingRefusedError as refusal:
        raise refusal.at(written.where(refusal.location)) from None


def _refuse_strangers(own: CustomProblem, binding: BindingFile, others: Others) -> None:
    known = {own.as_written(one.name): one for one in own.problem.all_objects}
    types = {one.type for name, one in known.items() if name.lower() in map(str.lower, binding.people)}
    people = [name for name, one in known.items() if not types or one.type in types]
    for name in others.profiles:
        if name.lower() not in map(str.lower, known):
            raise unknown_word("an object of the problem", name, people, where=Where("--as"))


@dataclass(frozen=True, slots=True)
class _Written:
    """A binding in its file."""

    file: YamlFile
    binding: BindingFile
    others: Others

    def where(self, location: Location) -> Where:
        """Of a value of the binding; who is only named with `--as` stands there."""
        kind, *name = location[:2]
        stated = (one.lower() for one in self.binding.people)
        if kind == "people" and name and str(name[0]).lower() not in stated:
            return Where("--as")
        return self.file.where(location)

    def rulebook(self) -> Rulebook:
        if self.others.rulebook is not None:
            try:
                return load_rulebook(self.others.rulebook)
            except InputError as refusal:
                raise refusal.at(Where("--rulebook")) from None
        name = self.binding.rulebook
        if not isinstance(name, str):
            return load_rulebook(self.file.part("rulebook"))
        beside = self.file.path.parent / name
        with self.file.placing("rulebook"):
            return load_rulebook(beside if looks_like_a_file(name, beside) else name)

    def people(self, rulebook: Rulebook) -> BoundPeople:
        others = {name.lower(): profile for name, profile in self.others.profiles.items()}
        known = {}
        for name, person in self.binding.people.items():
            with self.file.placing("people", name):
                known[name] = self._inferred(name, person, rulebook, others.pop(name.lower(), None))
        for name, profile in self.others.profiles.items():
            if name.lower() in others:
                known[name] = self._on_the_day(_other(profile), rulebook)
        return BoundPeople(known, rulebook)

    def _inferred(
        self, name: str, person: str | BoundPerson, rulebook: Rulebook, other: str | None
    ) -> Inference:
        situation = person.situation if isinstance(person, BoundPerson) else None
        if situation:
            refuse_unknown(situation, rulebook, f"the situation of {name}")
        declared = self._declared(name, person) if other is None else _other(other)
        return self._on_the_day(declared, rulebook, situation)

    def _declared(self, name: str, person: str | BoundPerson) -> Declared:
        if isinstance(person, str):
            return self._load(person, "people", name)
        place = ("people", name, "profile")
        if isinstance(person.profile, Profile):
            return Declared(person.profile, self.file.part(*place))
        return self._load(person.profile, *place)

    def _on_the_day(
        self, declared: Declared, rulebook: Rulebook, situation: Facts | None = None
    ) -> Inference:
        day = day_for(self.others.at or self.binding.at, declared.profile)
        told, stored = in_this_meeting(situation or {}, declared.profile, day)
        values = infer_for(declared, rulebook, situation=told, at=day)
        return replace(values, notes=(*values.notes, *stored)) if stored else values

    def _load(self, profile: str, *place: str) -> Declared:
        return load_profile(profile, beside=self.file.path.parent, where=self.file.where(place))


def _other(profile: str) -> Declared:
    return load_profile(profile, where=Where("--as"))
