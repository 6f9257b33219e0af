"""The people of a scenario: profiles, rulebook and day, and the parameters inferred from them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from comity.parameters.acquaintance import learnt_with, situation_of
from comity.parameters.consent import refuse_unguarded_contact
from comity.parameters.in_run import infer_in_run
from comity.parameters.margin import MARGIN_FACTS, reads_margin_facts
from comity.parameters.speaking import require_words, speaker_of
from comity.parameters.values import refuse_unknown
from comity.parameters.which_rulebook import ChosenRulebook, chosen_rulebook
from comity.people.profile import Declared, Profile, ProfileGiven, day_for, declared_by, load_profile
from comity.specification.goals import agenda_of
from comity_fis import InputError, Where, load_rulebook, unknown_word

if TYPE_CHECKING:
    from datetime import date

    from comity.people.fact import Fact
    from comity.scenario import PersonSpec, ScenarioFile
    from comity_executor import Speaker
    from comity_fis import Inference, Learnt, Rulebook
    from comity_fis.validation.yaml_file import YamlFile


@dataclass(frozen=True, slots=True)
class Cast:
    """The people of a scenario, without their positions."""

    file: ScenarioFile
    chosen: ChosenRulebook
    rulebook: Rulebook
    day: date | None
    """Day of the facts; None if none depends on it."""
    declared: Mapping[str, Declared]
    """Profiles by person."""
    learnt: Mapping[str, Mapping[str, Learnt]]
    """Learnt corrections by person and parameter, where there are any."""
    speaker: Speaker
    """The robot's wordings and forms of address."""

    def values(self) -> dict[str, Inference]:
        """Parameters of everybody, by person.

        Raises:
            InputError: The rulebook does not know a fact or does not grant a setting.
        """
        return {name: self._values(name, declared) for name, declared in self.declared.items()}

    def values_wishing(self, name: str, settings: Mapping[str, Fact]) -> Inference:
        """One person's parameters with other settings."""
        declared = self.declared[name]
        profile = declared.profile.model_copy(update={"settings": dict(settings)})
        return self._values(name, replace(declared, profile=profile))

    def values_told(self, name: str, declared: Declared, situation: Mapping[str, Fact]) -> Inference:
        """One person's parameters for a given profile and situation.

        Raises:
            InputError: The rulebook does not grant a setting.
        """
        return infer_in_run(
            declared,
            self.rulebook,
            situation=situation,
            at=self.day,
            learnt=self.learnt.get(name),
            site=self.speaker.site,
            agenda=agenda_of(self.file.scenario.goals, name),
            also=MARGIN_FACTS if reads_margin_facts(self.file.scenario) else (),
        )

    def _values(self, name: str, declared: Declared) -> Inference:
        person = self.file.scenario.people[name]
        try:
            refuse_unknown(person.situation, self.rulebook, f"the situation of {name}")
            return self.values_told(name, declared, situation_of(person))
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
        profiles: Profiles that replace the scenario's, by person: shipped or stored names, files, or their
            content.
        rulebook: A rulebook that replaces the scenario's: a shipped name or a file.
        at: A day that replaces the scenario's.
        learnt: Learnt corrections, by person and parameter; None: those in the store.

    Raises:
        InputError: A profile or the rulebook is invalid.
    """
    declared = _declared(file, profiles or {})
    chosen = chosen_rulebook(file, declared, rulebook)
    try:
        book = load_rulebook(chosen.file)
        refuse_unguarded_contact(book)
    except InputError as error:
        raise error.at(chosen.where) from None
    day = day_for(at or file.scenario.at, *(each.profile for each in declared.values()))
    if learnt is None:
        learnt = learnt_with(file, tuple(profiles or ()), declared, book, day)
    speaker = speaker_of(file, {name: each.profile for name, each in declared.items()})
    try:
        require_words(book, speaker)
    except InputError as error:
        raise error.at(chosen.where) from None
    return Cast(file, chosen, book, day, declared, learnt, speaker)


def rulebook_of(
    file: ScenarioFile, other: str | None = None, profiles: Mapping[str, ProfileGiven] | None = None
) -> YamlFile:
    """The file of the applicable rulebook, read but not validated.

    Args:
        file: The scenario.
        other: A rulebook that replaces the scenario's.
        profiles: Profiles that replace the scenario's: the choice may depend on the people.

    Raises:
        InputError: There is none, or it is not YAML.
    """
    is_named = other is not None or file.scenario.rulebook is not None
    return chosen_rulebook(file, {} if is_named else _declared(file, profiles or {}), other).file


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
            raise unknown_word(
                f"somebody of the scenario {file.scenario.name}", name, people, where=Where("--as")
            )
    return {
        name: declared_by(others[name], called=name, where=Where("--as"))
        if name in others
        else _own_profile(file, name, person)
        for name, person in people.items()
    }


def _own_profile(file: ScenarioFile, name: str, person: PersonSpec) -> Declared:
    if isinstance(person.profile, Profile):
        return Declared(person.profile, file.file.part("people", name, "profile"))
    return load_profile(person.profile, beside=file.folder, where=file.where("people", name, "profile"))
