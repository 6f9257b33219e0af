"""Who takes part in a scenario: everybody's profile, the rules and the day, and the values that follow."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING

from comity.parameters.acquaintance import learnt_with, situation_of
from comity.parameters.consent import refuse_unguarded_contact
from comity.parameters.in_run import infer_in_run
from comity.parameters.speaking import require_words, speaker_of
from comity.parameters.values import refuse_unknown
from comity.people.profile import Declared, Profile, ProfileGiven, day_for, declared_by, load_profile
from comity.system.library import looks_like_a_file, require_file
from comity_fis import InputError, Where, closest, load_rulebook, read_rulebook, shipped_rulebooks

if TYPE_CHECKING:
    from datetime import date

    from comity.people.fact import Fact
    from comity.scenario import Person, ScenarioFile
    from comity_executor import Speaker
    from comity_fis import Inference, Learnt, Rulebook
    from comity_fis.validation.yaml_file import YamlFile


@dataclass(frozen=True, slots=True)
class Cast:
    """The people of a scenario, before it is known where they stand."""

    file: ScenarioFile
    rulebook_file: YamlFile
    rulebook: Rulebook
    rules_where: Where
    """Where the rulebook is named: the scenario's line, or the command line."""
    day: date | None
    """On which the facts are taken; None where none depends on it."""
    declared: Mapping[str, Declared]
    """By person."""
    learnt: Mapping[str, Mapping[str, Learnt]]
    """By person and parameter, of those with whom something was learnt."""
    speaker: Speaker
    """What the robot says, and how it addresses them."""

    def values(self) -> dict[str, Inference]:
        """Everybody's, by person.

        Raises:
            InputError: for a fact that the rulebook does not know or a wish that it does not grant.
        """
        return {name: self._values(name, declared) for name, declared in self.declared.items()}

    def values_wishing(self, name: str, settings: Mapping[str, Fact]) -> Inference:
        """One person's, had they these wishes instead of their own."""
        declared = self.declared[name]
        profile = declared.profile.model_copy(update={"settings": dict(settings)})
        return self._values(name, replace(declared, profile=profile))

    def _values(self, name: str, declared: Declared) -> Inference:
        person, book = self.file.scenario.people[name], self.rulebook
        try:
            refuse_unknown(person.situation, book, f"the situation of {name}")
            return infer_in_run(
                declared,
                book,
                situation=situation_of(person),
                at=self.day,
                learnt=self.learnt.get(name),
                site=self.speaker.site,
            )
        except InputError as error:
            raise error.at(self.file.where("people", name)) from None


def cast_of(
    file: ScenarioFile,
    *,
    profiles: Mapping[str, ProfileGiven] | None = None,
    rulebook: str | None = None,
    at: date | None = None,
    learnt: Mapping[str, Mapping[str, Learnt]] | None = None,
) -> Cast:
    """Load the profiles and the rulebook of a scenario.

    Args:
        file: The scenario.
        profiles: Other profiles than the scenario's, by person: shipped or stored names, files, or profiles
            written out.
        rulebook: Another rulebook than the scenario's: a shipped name or a file.
        at: Another day than the scenario's to take dated facts on.
        learnt: What earlier meetings taught, by person and parameter; None for what is remembered of them.

    Raises:
        InputError: if a profile or the rulebook cannot be used.
    """
    where = Where("--rulebook") if rulebook else file.where("rulebook")
    book_file = rulebook_of(file, rulebook)
    try:
        book = load_rulebook(book_file)
        refuse_unguarded_contact(book)
    except InputError as error:
        raise error.at(where) from None
    declared = _declared(file, profiles or {})
    day = day_for(at or file.scenario.at, *(each.profile for each in declared.values()))
    if learnt is None:
        learnt = learnt_with(file, tuple(profiles or ()), declared, book, day)
    speaker = speaker_of(file, {name: each.profile for name, each in declared.items()})
    try:
        require_words(book, speaker)
    except InputError as error:
        raise error.at(where) from None
    return Cast(file, book_file, book, where, day, declared, learnt, speaker)


def rulebook_of(file: ScenarioFile, other: str | None = None) -> YamlFile:
    """The file of a scenario's rulebook, or of another one, read and not yet checked.

    Raises:
        InputError: if there is none, or it is no YAML.
    """
    written = other or file.scenario.rulebook
    if not isinstance(written, str):
        return file.file.part("rulebook")
    where = Where("--rulebook") if other else file.where("rulebook")
    path = Path(written) if other else file.folder / written
    if written not in shipped_rulebooks() and looks_like_a_file(written, path):
        require_file("rulebook", path, written, where)
        written = str(path)
    try:
        return read_rulebook(written)
    except InputError as error:
        raise error.at(where) from None


def _declared(file: ScenarioFile, others: Mapping[str, ProfileGiven]) -> dict[str, Declared]:
    people = file.scenario.people
    if not isinstance(others, Mapping):
        raise InputError(
            expected="profiles by person",
            got=repr(others),
            remedy="Give a mapping such as {'guest': 'german_man'}.",
        )
    for name in others:
        if name not in people:
            raise InputError(
                expected=f"somebody of the scenario {file.scenario.name}",
                got=repr(name),
                remedy=closest(name, people),
                where=Where("--as"),
            )
    return {
        name: declared_by(others[name], called=name, where=Where("--as"))
        if name in others
        else _own_profile(file, name, person)
        for name, person in people.items()
    }


def _own_profile(file: ScenarioFile, name: str, person: Person) -> Declared:
    if isinstance(person.profile, Profile):
        return Declared(person.profile, file.file.part("people", name, "profile"))
    return load_profile(person.profile, beside=file.folder, where=file.where("people", name, "profile"))
