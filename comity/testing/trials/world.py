"""A scenario in another world: the world's changes laid over the scenario, each with its own line."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace
from typing import TYPE_CHECKING, Any, TypeVar

from comity.scenario import Scenario, ScenarioFile
from comity_fis import InputError

if TYPE_CHECKING:
    from comity_fis.validation.yaml_file import YamlFile

Location = tuple[str | int, ...]
T = TypeVar("T")

OF_THE_FILE = ("schema_version", "name", "expect", "matrix", "markers")
"""Keys that are the same in every world of a scenario."""


def in_world(file: ScenarioFile, name: str) -> ScenarioFile:
    """The scenario in one of its worlds; errors in changed values name their own line.

    Raises:
        InputError: if the world changes keys of the whole file, or there is no such world.
    """
    changes = file.scenario.matrix.worlds[name]
    for key in OF_THE_FILE:
        if key in changes:
            raise InputError(
                expected="what is otherwise in the world",
                got=f"`{key}`, which is of the whole file",
                remedy="Write it outside, or another scenario file.",
                where=file.where("matrix", "worlds", name, key),
            )
    there = _laid_over(file.file, name, changes)
    return ScenarioFile(there, there.check(Scenario))


def _laid_over(file: YamlFile, name: str, changes: Mapping[str, Any]) -> YamlFile:
    at: Location = ("matrix", "worlds", name)
    replaced = frozenset(_replaced(changes))

    def places(written: Mapping[Location, T]) -> dict[Location, T]:
        stays = {
            place: mark
            for place, mark in written.items()
            if not any(place[:n] in replaced for n in range(1, len(place) + 1))
        }
        return stays | {place[3:]: mark for place, mark in written.items() if place[:3] == at and place[3:]}

    data = _merged(file.data, changes)
    return replace(file, data=data, lines=places(file.lines), spans=places(file.spans))


def _replaced(changes: Mapping[str, Any], at: Location = ()) -> Iterator[Location]:
    """Places whose value is replaced as a whole."""
    for key, new in changes.items():
        if isinstance(new, Mapping):
            yield from _replaced(new, (*at, key))
        else:
            yield (*at, key)


def _merged(written: Any, changes: Any) -> Any:
    if not (isinstance(written, Mapping) and isinstance(changes, Mapping)):
        return changes
    return {
        **written,
        **{key: _merged(written[key], new) if key in written else new for key, new in changes.items()},
    }
