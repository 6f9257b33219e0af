"""Names that no font here can write: a picture calls these people by number, and one line says who is who."""

from __future__ import annotations

import logging
import unicodedata
from collections.abc import Mapping, Sequence
from dataclasses import replace
from functools import cache
from typing import NamedTuple

from comity_sim2d.acts import ActEvent
from comity_sim2d.frames import Frames
from comity_sim2d.lettering import lacking
from comity_sim2d.place_map import PlaceMap
from comity_sim2d.ring import Ring
from comity_sim2d.scene import Scene


class Shown(NamedTuple):
    """What a picture shows."""

    scene: Scene
    frames: Frames
    rings: tuple[Ring, ...]
    events: tuple[ActEvent, ...]

    @property
    def words(self) -> list[str]:
        """All that may be written, but for the headlines."""
        said = [event.words for event in self.events]
        return [*names_in(self.scene), *said, *(ring.label or "" for ring in self.rings)]


def readable(
    scene: Scene, frames: Frames, rings: Sequence[Ring] = (), events: Sequence[ActEvent] = ()
) -> Shown:
    """The same, with numbers for names that would be boxes."""
    names = substitutes([person.name for person in scene.people])
    if not names:
        return Shown(scene, frames, tuple(rings), tuple(events))
    return Shown(
        with_names(scene, names),
        replace(frames, entities=tuple(names.get(name, name) for name in frames.entities)),
        tuple(replace(ring, person=names.get(ring.person, ring.person)) for ring in rings),
        tuple(replace(event, person=names.get(event.person, event.person)) for event in events),
    )


def names_in(place: Scene | PlaceMap) -> list[str]:
    """Of whatever has one."""
    things = [*(piece.name for piece in place.furniture), *(area.name for area in place.areas)]
    places = [location.name for location in place.locations]
    people = [place.robot.name, *(each.name for each in place.people)] if isinstance(place, Scene) else []
    return [*people, *things, *places]


def with_names(scene: Scene, names: Mapping[str, str]) -> Scene:
    """A scene whose people are called otherwise."""
    people = tuple(replace(each, name=names.get(each.name, each.name)) for each in scene.people)
    groups = tuple(
        replace(group, members=tuple(names.get(name, name) for name in group.members))
        for group in scene.groups
    )
    return replace(scene, people=people, groups=groups)


def substitutes(people: Sequence[str]) -> dict[str, str]:
    """By name, what to write for those who cannot be written: `person 2` for the second; said once each."""
    found: dict[str, str] = {}
    for number, name in enumerate(people, 1):
        if missing := lacking(name):
            called = f"person {number}"
            while called in people:
                called += "'"
            found[name] = called
            _say(name, called, missing)
    return found


@cache
def _say(name: str, called: str, missing: str) -> None:
    kind = unicodedata.name(missing[0], "such letters").split()[0].capitalize()
    font = {"Cjk": "Noto Sans CJK", "Hiragana": "Noto Sans CJK", "Katakana": "Noto Sans CJK"}.get(kind)
    emoji = unicodedata.category(missing[0]) == "So"
    install = font or ("Noto Emoji" if emoji else f"Noto Sans {kind}")
    logging.getLogger("comity_sim2d").warning(
        "Pictures call %s %r: no font here has %r. A font such as %s helps.", name, called, missing, install
    )
