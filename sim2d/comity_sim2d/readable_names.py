"""Names that no font here can write: pictures give people and furniture numbers, and one line says which."""

from __future__ import annotations

import logging
import unicodedata
from collections.abc import Mapping, Sequence
from dataclasses import replace
from functools import cache
from itertools import count
from typing import NamedTuple

from comity_sim2d.acts import ActEvent
from comity_sim2d.frames import Frames
from comity_sim2d.lettering import lacking
from comity_sim2d.place_map import PlaceMap
from comity_sim2d.ring import Ring
from comity_sim2d.scene import Furniture, Scene


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
    """The same, with numbers for names that would be boxes, also where they are said."""
    names = substitutes(scene)
    if not names:
        return Shown(scene, frames, tuple(rings), tuple(events))
    return Shown(
        _scene_with(scene, names),
        replace(frames, entities=tuple(names.get(name, name) for name in frames.entities)),
        tuple(replace(ring, person=names.get(ring.person, ring.person)) for ring in rings),
        tuple(_event_with(names, event) for event in events),
    )


def _event_with(names: Mapping[str, str], event: ActEvent) -> ActEvent:
    text = event.text
    if text is not None:
        for name in sorted(names, key=len, reverse=True):
            text = text.replace(name, names[name])
    return replace(event, person=names.get(event.person, event.person), text=text)


def names_in(place: Scene | PlaceMap) -> list[str]:
    """Of whatever has one."""
    things = [*(piece.name for piece in place.furniture), *(area.name for area in place.areas)]
    places = [location.name for location in place.locations]
    people = [place.robot.name, *(each.name for each in place.people)] if isinstance(place, Scene) else []
    return [*people, *things, *places]


def with_names(place: Scene | PlaceMap, names: Mapping[str, str]) -> Scene | PlaceMap:
    """A place whose people and furniture are called otherwise."""
    if isinstance(place, Scene):
        return _scene_with(place, names)
    return replace(place, furniture=_renamed(place.furniture, names))


def _scene_with(scene: Scene, names: Mapping[str, str]) -> Scene:
    people = tuple(replace(each, name=names.get(each.name, each.name)) for each in scene.people)
    groups = tuple(
        replace(group, members=tuple(names.get(name, name) for name in group.members))
        for group in scene.groups
    )
    return replace(scene, people=people, groups=groups, furniture=_renamed(scene.furniture, names))


def _renamed(furniture: Sequence[Furniture], names: Mapping[str, str]) -> tuple[Furniture, ...]:
    return tuple(replace(each, name=names.get(each.name, each.name)) for each in furniture)


def substitutes(place: Scene | PlaceMap) -> dict[str, str]:
    """By name, what to write for those who cannot be written; said once each.

    `person 2` is the second person, `furniture 2` the second piece of furniture.
    """
    people = place.people if isinstance(place, Scene) else ()
    numbered = [(f"person {i}", each.name) for i, each in enumerate(people, 1)]
    numbered += [(f"furniture {i}", each.name) for i, each in enumerate(place.furniture, 1)]
    taken, found = set(names_in(place)), dict[str, str]()
    for called, name in numbered:
        if missing := lacking(name):
            found[name] = called + "'" * next(n for n in count() if called + "'" * n not in taken)
            _say(name, found[name], missing)
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
