"""Roles: names that people of several scenarios share."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

from comity.study.study_file import VISITED, StudyFile
from comity_fis import InputError, closest, unknown_word

if TYPE_CHECKING:
    from comity.scenario import ScenarioFile
    from comity_fis.validation.yaml_file import YamlFile


def roles_of(file: YamlFile, written: StudyFile, name: str, scenario: ScenarioFile) -> dict[str, str]:
    """The people of one scenario, by role.

    Args:
        file: The study's file, for complaints.
        written: Its content.
        name: Name of the scenario in the study.
        scenario: The scenario.

    Raises:
        InputError: with the line, for a role without a person in the scenario.
    """
    people = scenario.scenario.people
    roles = {VISITED: (scenario.scenario.visited() or tuple(people))[0]}
    for role, persons in written.roles.items():
        place: tuple[str | int, ...] = ("roles", role)
        person = persons if isinstance(persons, str) else persons.get(name)
        if person is None:
            raise InputError(
                expected=f"a person of {name} for the role {role}",
                got="nothing",
                remedy=f"Add a line `{name}: ...`. {closest('', people)}",
                where=file.where(place),
            )
        if person not in people:
            place = place if isinstance(persons, str) else (*place, name)
            raise unknown_word(f"a person of {name}", person, people, where=file.where(place))
        roles[role] = person
    return roles


def located(path: str, roles: Mapping[str, str]) -> Sequence[str]:
    """Keys of a factor's path, with roles replaced by people.

    Args:
        path: Path in a study: `people.visited.posture`.
        roles: Roles of the scenario.
    """
    keys = path.split(".")
    if keys[0] == "people" and len(keys) > 1 and keys[1] in roles:
        keys[1] = roles[keys[1]]
    return keys
