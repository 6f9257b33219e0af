"""Why a goal cannot be met: blocking conditions, found by removing them one at a time."""

from __future__ import annotations

from collections.abc import Container, Iterator, Sequence
from dataclasses import dataclass, replace
from math import dist
from typing import TYPE_CHECKING

from comity.answers.plan import RelaxableCondition, Unmet
from comity.planning.agenda import against_agenda, places_for
from comity.planning.barring import opened
from comity.planning.elbow_room import with_elbow_room
from comity.planning.request import gap_to, others_who_bar, spots_of, why_unserved
from comity_domain import (
    Circumstances,
    PlanningFailed,
    Visitee,
    greetings,
    in_the_way,
    offers,
)
from comity_fis.listing import listed
from comity_sim2d import RouteMap
from comity_sim2d.pose import XY

if TYPE_CHECKING:
    from collections.abc import Callable

    from comity_fis import Inference
    from comity_sim2d import Scene

MOST_THINGS = 12
"""Doors, walls and pieces of furniture each: trying one costs about 0.1 s (our choice)."""


class GoalsUnmet(PlanningFailed):
    """No plan meets all goals, and why.

    Args:
        reason: As `PlanningFailed` takes it.
        remedy: Likewise.
        unmet: The goals that fail.
        cut_off: Whether a limit ended the search for a plan, or for what stands in its way.
    """

    def __init__(
        self, reason: str, *, remedy: str, unmet: tuple[Unmet, ...] = (), cut_off: bool = False
    ) -> None:
        self.unmet = unmet
        super().__init__(reason, remedy=remedy, cut_off=cut_off)


def in_words(goal: Unmet) -> str:
    """A goal that fails, and what would have to change, as a sentence."""
    link = " and if " if goal.together else ", or if "
    ways_out = link.join(condition.text for condition in goal.conditions)
    possible = f"; it would be possible if {ways_out}" if ways_out else ""
    return f"{goal.person}: {goal.reason}{possible}."


@dataclass(frozen=True, slots=True)
class UnservedCase:
    """A person who cannot be served, and how else things could be."""

    scene: Scene
    visitee: Visitee
    without_settings: Callable[[Sequence[str]], Inference]
    """The person's parameters, had they not asked for these."""
    settings: Sequence[str]


def diagnose(case: UnservedCase, reason: str) -> Unmet:
    """What stands in the way of one person's goal."""
    found = in_the_way(tuple(_conditions(case)), lambda lifted: _served(case, lifted))
    if found.any_of or found.all_of:
        return Unmet(case.visitee.name, reason, found.any_of or found.all_of, together=not found.any_of)
    otherwise = tuple(_wider(case)) or tuple(_walked_on(case))
    return Unmet(case.visitee.name, reason, otherwise, together=len(otherwise) != 1)


def _wider(case: UnservedCase) -> Iterator[RelaxableCondition]:
    """The gap that would have to be wider, and who else bars the way, where the robot gets nowhere."""
    scene, visitee = case.scene, case.visitee
    if spots_of(scene, RouteMap(scene), visitee):
        return
    others = {person.name for person in scene.people} - {visitee.name}
    alone = gap_to(scene.without(others), visitee)
    gap = alone or gap_to(scene, visitee)
    if gap is None or not gap.lacks_cm:
        return
    text = f"the gap {gap.where} were {gap.lacks_cm} cm wider"
    yield RelaxableCondition("gap", " and ".join(gap.people), text)
    for name in others_who_bar(scene, visitee) if alone else ():
        yield RelaxableCondition("side", name, f"{name} stood elsewhere")


def _walked_on(case: UnservedCase) -> Iterator[RelaxableCondition]:
    """That a person who walks comes to where the robot may stand, which it waits for."""
    name = case.visitee.name
    if case.scene.person(name).walk and not spots_of(case.scene, RouteMap(case.scene), case.visitee):
        yield RelaxableCondition("side", name, f"{name}, who walks, came to another place")


def _conditions(case: UnservedCase) -> Iterator[RelaxableCondition]:
    """All that could be otherwise and bears on what fails; the person's own wishes are put back first."""
    visitee, name = case.visitee, case.visitee.name
    nowhere = not spots_of(case.scene, RouteMap(case.scene), visitee)
    places = places_for(case.scene, RouteMap(case.scene), [visitee])
    hindered = against_agenda(visitee, places) is not None
    speechless = not greetings(visitee.values, visitee.now)
    for setting in case.settings:
        if speechless if setting.startswith("greeting_") else nowhere:
            yield RelaxableCondition(
                "setting", setting, f"{name} did not ask for {setting.replace('_', ' ')}"
            )
    if speechless or hindered:
        yield from _of_the_moment(name, visitee.now)
    if nowhere or None in places.values():
        yield from _of_the_place(name, case.scene)


def _of_the_moment(name: str, now: Circumstances) -> Iterator[RelaxableCondition]:
    if now.noisy or now.noise_db is not None:
        yield RelaxableCondition("noise", "noise", f"it were quiet around {name}")
    if now.robot_carries:
        yield RelaxableCondition("hands", "robot", f"the robot did not carry {now.robot_carries}")
    if now.person_carries:
        yield RelaxableCondition("hands", name, f"{name} did not carry {now.person_carries}")
    if now.withheld:
        needed = listed(dict.fromkeys(now.withheld.values())).replace("_", " ")
        otherwise = "did not ask for no touch" if now.wants_no_touch else f"said that {needed}"
        yield RelaxableCondition("consent", "consent", f"{name} {otherwise}")


def _of_the_place(name: str, scene: Scene) -> Iterator[RelaxableCondition]:
    """What stands around a person, the nearest first; on a map, nobody takes walls down to get in."""
    at = scene.person(name).xy
    shut = sorted((door for door in scene.doors if not door.is_open), key=lambda door: dist(door.start, at))
    for door in shut[:MOST_THINGS]:
        yield RelaxableCondition("door", door.name, f"the door {door.name!r} were open")
    for i, wall in enumerate(() if scene.doors else scene.walls[:MOST_THINGS]):
        yield RelaxableCondition(
            "side", f"wall {i + 1}", f"the wall from {wall.start} to {wall.end} were not there"
        )
    for thing in sorted(scene.furniture, key=lambda thing: _gap_m(at, thing.corners))[:MOST_THINGS]:
        yield RelaxableCondition("side", thing.name, f"{thing.name} were not there")
    for person in scene.people:
        if person.name != name:
            yield RelaxableCondition("side", person.name, f"{person.name} stood elsewhere")


def _gap_m(at: XY, corners: Sequence[XY]) -> float:
    return min(dist(at, corner) for corner in corners)


def _served(case: UnservedCase, lifted: Sequence[RelaxableCondition]) -> bool:
    """Whether a person could be served without these conditions."""
    wishes, others = [], set[tuple[str, str]]()
    for condition in lifted:
        if condition.kind == "setting":
            wishes.append(condition.name)
        others.add((condition.kind, condition.name))
    visitee = replace(
        case.visitee,
        values=case.without_settings(wishes) if wishes else case.visitee.values,
        now=_lighter(case.visitee, others),
    )
    kept = {offer.place for offer in offers(visitee.agenda)}
    scene = _emptier(case.scene, {name for kind, name in others if kind == "side"} - kept)
    scene = opened(scene, (name for kind, name in others if kind == "door"))
    route_map = RouteMap(scene)
    places = places_for(scene, route_map, [visitee])
    spots = spots_of(scene, route_map, visitee)
    return why_unserved(scene, with_elbow_room(scene, visitee, spots), spots, places) is None


def _lighter(visitee: Visitee, lifted: Container[tuple[str, str]]) -> Circumstances:
    now = visitee.now
    quiet = ("noise", "noise") in lifted
    return replace(
        now,
        noisy=now.noisy and not quiet,
        noise_db=None if quiet else now.noise_db,
        robot_carries=None if ("hands", "robot") in lifted else now.robot_carries,
        person_carries=None if ("hands", visitee.name) in lifted else now.person_carries,
        presumes_consent=("consent", "consent") in lifted,
    )


def _emptier(scene: Scene, removed: Container[str]) -> Scene:
    return replace(
        scene.without(removed),
        walls=tuple(wall for i, wall in enumerate(scene.walls) if f"wall {i + 1}" not in removed),
        furniture=tuple(thing for thing in scene.furniture if thing.name not in removed),
    )
