"""The robot's speech in a scenario: language of the site, wordings, and forms of address."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from comity.people.language import iso639
from comity_domain.problem.bound_parameters import GREETING_LANGUAGE
from comity_executor import Address, Phrasebook, Speaker, read_wordings
from comity_fis import InputError, NominalParameter, Where, closest
from comity_fis.validation.yaml_file import YamlFile, read_yaml

if TYPE_CHECKING:
    from comity.people.address import FormOfAddress
    from comity.people.profile import Profile
    from comity.scenario import ScenarioFile
    from comity_fis import Rulebook


def at_site(file: ScenarioFile, *, language: str | None = None, wordings: Iterable[str] = ()) -> ScenarioFile:
    """The scenario with another site language or additional wordings.

    Args:
        file: The scenario.
        language: Code or name; None: the scenario's language.
        wordings: Files that override the scenario's.

    Raises:
        InputError: A file is not a file of wordings, or there are no wordings in the language.
    """
    paths = [Path(one).absolute() for one in wordings]
    for path, name in zip(paths, wordings, strict=True):
        read_wordings(read_yaml(path, name))
    scenario = file.scenario
    update: dict[str, object] = {"wordings": (*scenario.wordings, *map(str, paths))}
    changed = replace(file, scenario=scenario.model_copy(update=update))
    if language is None:
        return changed
    try:
        phrasebook_of(changed).code_of(iso639(language))
    except InputError as error:
        raise error.at(Where("--site-language")) from None
    return replace(changed, scenario=changed.scenario.model_copy(update={"site_language": language}))


def phrasebook_of(file: ScenarioFile) -> Phrasebook:
    """The shipped languages, overridden by the scenario's own wordings.

    Raises:
        InputError: A file is missing or not a file of wordings.
    """
    return Phrasebook(tuple(read_wordings(one) for one in wordings_files(file)))


def wordings_files(file: ScenarioFile) -> tuple[YamlFile, ...]:
    """The files of the scenario's own wordings, in its order."""
    return tuple(_wordings_file(file, i) for i in range(len(file.scenario.wordings)))


def site_of(file: ScenarioFile, phrasebook: Phrasebook) -> str:
    """ISO 639-3 code of the site's language.

    Raises:
        InputError: There are no wordings in it.
    """
    said = file.scenario.site_language
    if said is None:
        return Speaker().site
    with file.file.placing("site_language"):
        return phrasebook.code_of(iso639(said))


def speaker_of(file: ScenarioFile, profiles: Mapping[str, Profile]) -> Speaker:
    """The speaker for a scenario.

    Args:
        file: The scenario.
        profiles: All profiles, by person.

    Raises:
        InputError: Its wordings or its language are invalid.
    """
    phrasebook = phrasebook_of(file)
    said = {name: address_of(profile.form_of_address) for name, profile in profiles.items()}
    addresses = {name: address for name, address in said.items() if address}
    return Speaker(phrasebook=phrasebook, site=site_of(file, phrasebook), addresses=addresses)


def address_of(said: FormOfAddress | str | None) -> Address | None:
    """A person's form of address, given in parts or in one word; None if not stated."""
    if said is None or isinstance(said, str):
        return Address(name=said) if said else None
    return Address(
        name=said.name,
        title=said.title,
        title_first=said.order == "title name",
        pronunciation=said.pronunciation,
    )


def require_words(rulebook: Rulebook, speaker: Speaker) -> None:
    """Reject a rulebook with a language that has no wordings.

    Raises:
        InputError: It has one.
    """
    parameter = rulebook.parameters.get(GREETING_LANGUAGE)
    if not isinstance(parameter, NominalParameter):
        return
    for category in parameter.categories:
        if category.name not in speaker.phrasebook:
            languages = ", ".join(speaker.phrasebook)
            raise InputError(
                expected=f"{GREETING_LANGUAGE} as one that the robot speaks ({languages})",
                got=repr(category.name),
                remedy=f"{closest(category.name, speaker.phrasebook.codes)} Or give a file of `wordings`.",
            )


def _wordings_file(file: ScenarioFile, i: int) -> YamlFile:
    written: Sequence[object] = file.scenario.wordings
    name = written[i]
    if not isinstance(name, str):
        return file.file.part("wordings", i)
    try:
        return read_yaml(file.folder / name, name)
    except InputError as error:
        raise error.at(file.where("wordings", i)) from None
