"""A file flattened: every value by its place (path of keys), with its line.

An item of a list is identified by its name if all items have distinct names, else by its number from 1. A
list of plain values, such as a point, is one value.
"""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from comity_fis import Where

if TYPE_CHECKING:
    from comity_fis.errors import Location
    from comity_fis.validation.yaml_file import YamlFile

BETWEEN = " / "
"""Separator of the parts of a place: names contain spaces."""


@dataclass(frozen=True, slots=True)
class SourceFile:
    """A flattened file that a case reads."""

    leaves: Mapping[str, Any]
    """Plain JSON values by their place, `furniture / column 2 / circle_m`, in the order of places."""
    places: Mapping[str, Where]
    """Positions in the file of all leaves and their parents."""
    file: str

    def where(self, place: str) -> Where:
        """Position of a place, or of its closest existing parent."""
        while place and place not in self.places:
            place = place.rpartition(BETWEEN)[0]
        return self.places.get(place, Where(self.file))


def source_of(file: YamlFile, data: Any, prose: Sequence[str]) -> SourceFile:
    """Flatten a file.

    Args:
        file: The file.
        data: The part of its data that counts.
        prose: Keys of prose, which affects no computation.
    """
    found = list(_walked(data, prose))
    leaves = {place: json.loads(json.dumps(part, default=str)) for place, _, part in found if _is_leaf(part)}
    places = {place: file.where(location) for place, location, _ in found if location}
    return SourceFile(dict(sorted(leaves.items())), places, file.name)


def _walked(
    part: Any, prose: Sequence[str], place: str = "", location: Location = ()
) -> Iterator[tuple[str, Location, Any]]:
    """Every value and its parents, outermost first."""
    yield place, location, part
    if _is_leaf(part):
        return
    for called, key, inner in _parts(part):
        if not (key in prose and _is_words(inner)):
            yield from _walked(
                inner, prose, f"{place}{BETWEEN}{called}" if place else called, (*location, key)
            )


def _parts(part: Any) -> Iterator[tuple[str, str | int, Any]]:
    """The children of a part: name, key and value."""
    if isinstance(part, Mapping):
        yield from ((str(key), key, inner) for key, inner in part.items())
        return
    names = [str(item["name"]) for item in part if isinstance(item, Mapping) and "name" in item]
    if len(set(names)) == len(part):
        for number, (name, item) in enumerate(zip(names, part, strict=True)):
            yield name, number, {key: inner for key, inner in item.items() if key != "name"}
    else:
        yield from ((str(number), number - 1, item) for number, item in enumerate(part, 1))


def _is_leaf(part: Any) -> bool:
    if isinstance(part, Mapping):
        return not part
    return not isinstance(part, list) or not any(isinstance(item, Mapping | list) for item in part)


def _is_words(part: Any) -> bool:
    return isinstance(part, str) or (
        isinstance(part, Mapping) and all(isinstance(inner, str) for inner in part.values())
    )
