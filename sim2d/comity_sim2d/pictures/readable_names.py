"""Substitutes for names that no available font can write: numbers, explained in one line."""

from __future__ import annotations

import logging
import re
import unicodedata
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from functools import cache
from itertools import count
from typing import NamedTuple, TypeVar

from comity_sim2d.frames import Frames
from comity_sim2d.maps.place_map import PlaceMap
from comity_sim2d.pictures.lettering import lacking
from comity_sim2d.pictures.ring import Ring
from comity_sim2d.robot.acts import ActEvent
from comity_sim2d.scene.area import Area, Location
from comity_sim2d.scene.room import Furniture
from comity_sim2d.scene.scene import Scene

Part = TypeVar("Part", Furniture, Area, Location)


class PictureContent(NamedTuple):
    """The content of a picture."""

    scene: Scene
    frames: Frames
    rings: tuple[Ring, ...]
    events: tuple[ActEvent, ...]
    names: Mapping[str, str]
    """Substitutes for names that no font can write."""

    @property
    def words(self) -> list[str]:
        """All text that may be written, except headlines."""
        said = [event.words for event in self.events]
        return [*names_in(self.scene), *said, *(ring.label or "" for ring in self.rings)]


def readable(
    scene: Scene, frames: Frames, rings: Sequence[Ring] = (), events: Sequence[ActEvent] = ()
) -> PictureContent:
    """The same content with substitutes for unwritable names, also in speech."""
    names = substitutes(scene, things_in(events))
    return PictureContent(
        _scene_with(scene, names) if names else scene,
        replace(frames, entities=tuple(names.get(name, name) for name in frames.entities)),
        tuple(_ring_with(names, ring) for ring in rings),
        tuple(_event_with(names, event) for event in events),
        names,
    )


def legible(text: str, names: Mapping[str, str]) -> str:
    """A text with names replaced, and `…` for letters that no available font has."""
    for name in sorted(names, key=len, reverse=True):
        text = text.replace(name, names[name])
    boxes = lacking(text)
    return re.sub(f"[{re.escape(boxes)}]+(?: +[{re.escape(boxes)}]+)*", "…", text) if boxes else text


def things_in(events: Iterable[ActEvent]) -> tuple[str, ...]:
    """The carried objects, each once."""
    return tuple(dict.fromkeys(event.thing for event in events if event.thing is not None))


def _ring_with(names: Mapping[str, str], ring: Ring) -> Ring:
    label = None if ring.label is None else legible(ring.label, names)
    return replace(ring, person=names.get(ring.person, ring.person), label=label)


def _event_with(names: Mapping[str, str], event: ActEvent) -> ActEvent:
    text = None if event.text is None else legible(event.text, names)
    thing = None if event.thing is None else names.get(event.thing, event.thing)
    return replace(event, person=names.get(event.person, event.person), text=text, thing=thing)


def names_in(place: Scene | PlaceMap) -> list[str]:
    """The names of everything that has one."""
    things = [*(piece.name for piece in place.furniture), *(area.name for area in place.areas)]
    places = [location.name for location in place.locations]
    people = [place.robot.name, *(each.name for each in place.people)] if isinstance(place, Scene) else []
    return [*people, *things, *places]


def with_names(place: Scene | PlaceMap, names: Mapping[str, str]) -> Scene | PlaceMap:
    """A place with names replaced."""
    if isinstance(place, Scene):
        return _scene_with(place, names)
    return replace(
        place,
        furniture=_renamed(place.furniture, names),
        areas=_renamed(place.areas, names),
        locations=_renamed(place.locations, names),
    )


def _scene_with(scene: Scene, names: Mapping[str, str]) -> Scene:
    people = tuple(replace(each, name=names.get(each.name, each.name)) for each in scene.people)
    groups = tuple(
        replace(group, members=tuple(names.get(name, name) for name in group.members))
        for group in scene.groups
    )
    return replace(
        scene,
        robot=replace(scene.robot, name=names.get(scene.robot.name, scene.robot.name)),
        people=people,
        groups=groups,
        furniture=_renamed(scene.furniture, names),
        areas=_renamed(scene.areas, names),
        locations=_renamed(scene.locations, names),
    )


def _renamed(parts: Sequence[Part], names: Mapping[str, str]) -> tuple[Part, ...]:
    return tuple(replace(each, name=names.get(each.name, each.name)) for each in parts)


def substitutes(place: Scene | PlaceMap, things: Sequence[str] = ()) -> dict[str, str]:
    """Substitutes for names that cannot be written, by name; explained once each.

    `person 2` is the second person, `furniture 2` the second piece of furniture, and likewise for rooms,
    named places and carried objects.
    """
    people = [each.name for each in place.people] if isinstance(place, Scene) else []
    named = {
        "person": people,
        "furniture": [piece.name for piece in place.furniture],
        "room": [area.name for area in place.areas],
        "place": [location.name for location in place.locations],
        "thing": things,
    }
    numbered = [("robot", place.robot.name)] if isinstance(place, Scene) else []
    numbered += [(f"{kind} {i}", name) for kind, names in named.items() for i, name in enumerate(names, 1)]
    taken, found = set(names_in(place)), dict[str, str]()
    for called, name in numbered:
        if name not in found and (missing := lacking(name)):
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
