"""A scenario under one condition, self-contained, so that it runs wherever it is sent."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from copy import deepcopy
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from comity.output.digest import digest_of
from comity.output.resolved import kept_tables
from comity.parameters.cast import rulebook_of
from comity.parameters.speaking import wordings_files
from comity.people.profile import Declared, Profile, load_profile
from comity.scenario import MapPlace, Scenario, ScenarioFile
from comity.simulation.place import written_map
from comity.study.overlay import laid_over
from comity.study.roles import located
from comity_fis import (
    InputError,
    Rulebook,
    load_rulebook,
    read_rulebook,
    shipped_rulebooks,
    unknown_word,
)
from comity_fis.errors import Location
from comity_fis.validation.yaml_file import YamlFile, dump_yaml

if TYPE_CHECKING:
    from datetime import date

    from comity.study.design import StudyCondition

ABOUT_TESTS = ("expect", "matrix", "markers", "about")
"""Keys of a scenario that no episode depends on."""
FILES = ("rulebook", "profile", "map")
"""Keys whose values may name a file next to the study."""


@dataclass(frozen=True, slots=True)
class EpisodeBase:
    """Shared input of all episodes of one scenario under one condition; plain values, to be sent anywhere."""

    scenario: Mapping[str, Any]
    """The scenario with its map, wordings and profiles written out, and without a rulebook."""
    called: str
    rulebook: str
    """A shipped name, or the text of a rulebook whose tables are named by absolute paths."""
    rulebook_name: str
    digest: str
    """Digest of all this by content, including the tables of the rulebook."""


def base_of(
    scenario: ScenarioFile,
    condition: StudyCondition,
    roles: Mapping[str, str],
    *,
    folder: Path,
    at: date | None,
) -> tuple[EpisodeBase, ScenarioFile]:
    """A scenario under a condition.

    Args:
        scenario: The scenario as written.
        condition: The values of the factors.
        roles: People of the scenario, by role.
        folder: Base folder of files named by factors.
        at: Date for dated facts; None for the scenario's.

    Returns:
        The input for workers, and the same scenario as a file, for checks.

    Raises:
        InputError: for a value that the scenario cannot have, a stored profile, or facts that need a date.
    """
    data = {key: part for key, part in scenario.file.data.items() if key not in ABOUT_TESTS}
    if at is not None:
        data["at"] = at.isoformat()
    for path, value in condition.values.items():
        keys = located(path, roles)
        _require_person(keys, data.get("people") or {}, roles)
        data = laid_over(data, keys, _beside(folder, keys[-1], value))
    file = replace(scenario.file, data=data, lines=dict.fromkeys(_places(data), 1), spans={})
    changed = ScenarioFile(file, file.check(Scenario))
    written = changed.scenario
    people = dict(_people(changed))
    data["people"] = {
        name: {**data["people"][name], "profile": profile} for name, (profile, _) in people.items()
    }
    if written.at is None and any(one.profile.depends_on_date for _, one in people.values()):
        raise InputError(
            expected="a day on which dated facts are taken",
            got="none",
            remedy="Write `at: 2026-01-31`, or another day, into the study.",
        )
    if isinstance(written.place, MapPlace) and isinstance(written.place.map, str):
        data["place"] = {**data["place"], "map": written_map(changed, written.place.map)[0].data}
    if written.wordings:
        data["wordings"] = [deepcopy(one.data) for one in wordings_files(changed)]
    source = rulebook_of(changed)
    book = load_rulebook(source)
    named, text, tables = _rulebook(source, book)
    data.pop("rulebook", None)
    digest = digest_of([data, text, tables])
    return EpisodeBase(data, written.name, named, book.name, digest), changed


def _require_person(keys: Sequence[str], people: Collection[str], roles: Collection[str]) -> None:
    """Refuse a path into an unknown person; only a whole person may be added."""
    if keys[0] == "people" and len(keys) > 2 and keys[1] not in people:
        known = dict.fromkeys((*people, *roles))
        raise unknown_word("a person or a role of the scenario", keys[1], known)


def _beside(folder: Path, key: str, value: Any) -> Any:
    """The absolute path of a file next to the study; any other value unchanged."""
    if key in FILES and isinstance(value, str) and value not in shipped_rulebooks():
        path = folder / value
        return str(path.absolute()) if path.is_file() else value
    return value


def _places(data: Any, at: Location = ()) -> Iterator[Location]:
    """Places of all values: messages refer to each by its key."""
    yield at
    parts = data.items() if isinstance(data, Mapping) else enumerate(data) if isinstance(data, list) else ()
    for key, part in parts:
        yield from _places(part, (*at, key))


def _people(file: ScenarioFile) -> Iterator[tuple[str, tuple[Any, Declared]]]:
    """Everyone's profile, as plain values and as parsed."""
    for name, person in file.scenario.people.items():
        if isinstance(person.profile, Profile):
            plain = file.file.data["people"][name].get("profile", {})
            yield name, (plain, Declared(person.profile, None))
            continue
        declared = load_profile(person.profile, beside=file.folder)
        if declared.kept_as is not None:
            raise InputError(
                expected=f"a shipped profile or a file for {name}",
                got=f"the stored profile {declared.kept_as}",
                remedy="Export it with `comity profile export NAME --pseudonym P01`, if the person agreed.",
            )
        assert declared.file is not None
        told = {key: part for key, part in declared.file.data.items() if key != "about"}
        yield name, (told, declared)


def _rulebook(source: YamlFile, book: Rulebook) -> tuple[str, str, list[str]]:
    """The rulebook's name for workers, its text, and the texts of its own tables."""
    name = source.path.stem
    if name in shipped_rulebooks() and read_rulebook(name).text == source.text:
        return name, source.text, []
    data, texts = deepcopy(source.data), []
    for (*way, key), (_, table) in kept_tables(book).items():
        place = data["variables"]
        for step in way:
            place = place[step]
        place[key] = str((source.path.parent / place[key]).absolute())
        texts.append(table.text)
    text = dump_yaml(data)
    return text, text, texts
