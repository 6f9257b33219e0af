"""The planning request: people to visit, on which sides, and how far everything is apart."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from types import MappingProxyType
from typing import TYPE_CHECKING

from comity.parameters.perception import clash_of, wishes_of
from comity.planning.agenda import against_agenda, places_for
from comity.planning.barring import barring
from comity.planning.companies import companies
from comity.planning.elbow_room import with_elbow_room
from comity.planning.lengths import Lengths
from comity.planning.narrow_gap import NarrowGap, narrow_gap
from comity.planning.travel_distances import TravelDistances
from comity_domain import (
    Side,
    Spot,
    TakeLeave,
    Visitee,
    VisitRequest,
    distance_desirability,
    greetings,
    in_the_way,
    location,
    ruled_out,
    sides,
    widest_deg,
)
from comity_fis import Choice
from comity_fis.listing import listed, with_verb
from comity_fis.proxemics import PERSON_MARGIN_M
from comity_sim2d import RouteMap, Wish, choose_pose, pose_blocker, side_name, spot_pose
from comity_sim2d.navigation.docking import spots_beside
from comity_sim2d.pose import XY
from comity_sim2d.scene.surroundings import Surroundings

if TYPE_CHECKING:
    from comity_fis import Inference
    from comity_sim2d import DockingPose, Pose, Scene


MOST_MEASURED = 1
"""People to whom all ways are measured at once: a plan takes most of them anyway (our choice)."""
NO_GROUPS: Mapping[str, Sequence[str]] = MappingProxyType({})
NOBODY: Mapping[str, str] = MappingProxyType({})


@dataclass(frozen=True, slots=True)
class PlanningRequest:
    """A request that has a plan, and the people for whom there is none."""

    request: VisitRequest
    unreachable: Mapping[str, str]
    """People whom no plan can serve, whatever its order, with the reason; but those who may be left out."""
    places: Mapping[str, Pose]
    """Where the robot stands to fetch what is offered, by the place's name."""


def ask(
    scene: Scene,
    route_map: RouteMap,
    visitees: tuple[Visitee, ...],
    *,
    groups: Mapping[str, Sequence[str]] = NO_GROUPS,
    lost: Mapping[str, str] = NOBODY,
    attend_s: float = 0.0,
) -> PlanningRequest:
    """Measure the ways to everybody who is to be visited; of many people only bounds, to begin with.

    Args:
        scene: Where everybody stands.
        route_map: Its routes.
        visitees: People whom the goals name, with their parameters.
        groups: Who stands together, by a name.
        lost: Of whom it is not known where they are, and why; the scene need not have them.
        attend_s: How long the robot watches how each person takes its coming.
    """
    spots: dict[Spot, XY] = {}
    unreachable: dict[str, str] = {each.name: lost[each.name] for each in visitees if each.name in lost}
    kept = places_for(scene, route_map, visitees)
    served: list[Visitee] = []
    for visitee in visitees:
        if visitee.name in lost:
            continue
        found = spots_of(scene, route_map, visitee)
        with_room = with_elbow_room(scene, visitee, found)
        reason = why_unserved(scene, with_room, found, kept)
        if reason is None:
            spots.update(found)
            served.append(with_room)
        else:
            unreachable[visitee.name] = reason if found else f"{reason}{what_bars(scene, visitee)}"
    places = {name: pose for name, pose in kept.items() if pose is not None}
    spots.update({location(name): pose.xy for name, pose in places.items()})
    lengths = Lengths(scene, route_map, spots, _ways(scene, route_map, served, spots, places), attend_s)
    few = len(served) <= MOST_MEASURED
    travel, ways = lengths.travel(least=not few), lengths.ways(least=not few)
    request = VisitRequest(
        robot=scene.robot.name,
        visitees=tuple(served),
        travel=travel,
        companies=companies(
            groups, route_map, spots, {each.name: widest_deg(each.values) for each in served}
        ),
        durations_s={way: journey.seconds(attend_s) for way, journey in ways.items()},
        ways_m={way: journey.length_m for way, journey in ways.items()},
        blocked=_blocked(scene, served, spots),
        survey=None if few else lengths.survey(travel, ways),
        dropped_m={
            each.name: each.skip_m
            for each in visitees
            if each.name in unreachable and each.skip_m is not None
        },
    )
    must = {name: reason for name, reason in unreachable.items() if name not in request.dropped_m}
    return PlanningRequest(request, must, places)


def _ways(
    scene: Scene,
    route_map: RouteMap,
    visitees: Sequence[Visitee],
    spots: Mapping[Spot, XY],
    places: Mapping[str, Pose],
) -> TravelDistances | None:
    """The ways without culture, where something hangs on them."""
    if all(each.by_s is None and each.skip_m is None for each in visitees):
        return None
    own: dict[str, list[XY]] = {each.name: [] for each in visitees}
    for spot, xy in spots.items():
        if spot.place in own:
            own[spot.place].append(xy)
    return TravelDistances(scene, route_map, own, places)


def _blocked(scene: Scene, served: Sequence[Visitee], spots: Mapping[Spot, XY]) -> dict[Spot, str]:
    """What stands on the sides that people accept and the robot cannot come from."""
    shut = (
        (Spot(each.name, side.name), each.values["conversational_distance"].number, side.bearing_deg)
        for each in served
        for side in _accepted(each).values()
    )
    found = {spot: pose_blocker(scene, spot.place, *pose) for spot, *pose in shut if spot not in spots}
    return {spot: what for spot, what in found.items() if what is not None}


def why_unserved(
    scene: Scene, visitee: Visitee, spots: Mapping[Spot, XY], places: Mapping[str, Pose | None]
) -> str | None:
    """Why no plan can serve a person; None where one can.

    Args:
        scene: Where everybody stands.
        visitee: The person to greet.
        spots: Where the robot may stand before them.
        places: Where it may stand to fetch things.
    """
    clash = clash_of(wishes_of(visitee.values), hears=visitee.now.hears, sees=visitee.now.sees)
    if clash is not None:
        return f"{visitee.name} asked for what cannot be met: {clash.words}"
    if not spots:
        return _reason(scene, visitee)
    greets = not visitee.greeted or any(isinstance(task, TakeLeave) for task in visitee.agenda)
    if not greets or greetings(visitee.values, visitee.now):
        return against_agenda(visitee, places)
    against = [
        f"{greeting.words}: {reason}" for greeting, reason in ruled_out(visitee.values, visitee.now).items()
    ]
    return f"no greeting is possible for {visitee.name}: {'; '.join(against) or 'none is permitted'}"


def what_bars(scene: Scene, visitee: Visitee) -> str:
    """What keeps the robot from everywhere before a person, as the end of the reason; empty where not known.

    Args:
        scene: Where everybody stands.
        visitee: The person whom the robot cannot reach.
    """
    bar = barring(
        scene,
        visitee.name,
        [place for place, _ in _free_places(scene, visitee)],
        lambda other: bool(spots_of(other, RouteMap(other), visitee)),
    )
    return f"; {bar}" if bar else ""


def gap_to(scene: Scene, visitee: Visitee) -> NarrowGap | None:
    """The widest gap beside people that is too narrow for the robot to get to a person; None if none is."""
    goals = [place for place, _ in _free_places(scene, visitee)]
    return narrow_gap(scene, visitee.name, goals, beside_visited=True)


def others_who_bar(scene: Scene, visitee: Visitee) -> tuple[str, ...]:
    """The fewest others who bar every way to a person even if that person were not in the way themselves."""
    goals, start = [place for place, _ in _free_places(scene, visitee)], scene.robot.pose.xy

    def is_reached(gone: Sequence[str]) -> bool:
        ways = RouteMap(scene.without({visitee.name, *gone}))
        return any(ways.reaches(start, goal) for goal in goals)

    if is_reached(()):
        return ()
    found = in_the_way([other.name for other in scene.people if other.name != visitee.name], is_reached)
    return found.any_of[:1] or found.all_of


def _free_places(scene: Scene, visitee: Visitee) -> list[tuple[XY, str]]:
    """Where the robot could stand before a person, had it a way there, and on which side that is."""
    person, accepted = visitee.name, _accepted(visitee)
    if not accepted:
        return []
    tried = _wish(person, visitee.values, next(iter(accepted.values()))).candidates()
    pairs = [(distance, bearing) for distance, bearing in tried if side_name(bearing) in accepted]
    places = spots_beside(scene.person(person), scene.robot.radius_m, pairs)
    free = Surroundings.of(scene).are_free(places, visited=person).tolist()
    return [
        (place, side_name(bearing))
        for place, (_, bearing), is_free in zip(places, pairs, free, strict=True)
        if is_free
    ]


def spots_of(scene: Scene, route_map: RouteMap, visitee: Visitee) -> dict[Spot, XY]:
    """Where the robot may stand: each side whose own pose is free and reachable, or the best."""
    person, values = visitee.name, visitee.values
    start, distance = scene.robot.pose.xy, values["conversational_distance"].number
    accepted, ways = _accepted(visitee), route_map.to(person)
    found: dict[Spot, XY] = {}
    for side in accepted.values():
        xy = spot_pose(scene, person, distance, side.bearing_deg).xy
        if pose_blocker(scene, person, distance, side.bearing_deg) is None and ways.reaches(start, xy):
            found[Spot(person, side.name)] = xy
    if found or not accepted:
        return found
    pose = choose_pose(ways, start, _wish(person, values, next(iter(accepted.values()))))
    if pose is None or side_name(pose.bearing_deg) not in accepted:
        return {}
    return {Spot(person, side_name(pose.bearing_deg)): _xy(scene, person, pose)}


def _accepted(visitee: Visitee) -> Mapping[str, Side]:
    """The sides that the person accepts and the scenario does not rule out."""
    return {name: side for name, side in sides(visitee.values).items() if name not in visitee.not_from}


def _wish(person: str, values: Inference, side: Side) -> Wish:
    distance, direction = values["conversational_distance"], values["approach_direction"]
    assert not isinstance(direction.desirability, Choice)
    return Wish(
        person=person,
        distance_m=distance.number,
        bearing_deg=side.bearing_deg,
        distance_desirability=distance_desirability(distance, PERSON_MARGIN_M),
        direction_desirability=direction.desirability,
    )


def _xy(scene: Scene, person: str, pose: DockingPose) -> XY:
    return spot_pose(scene, person, pose.distance_m, pose.bearing_deg).xy


def _reason(scene: Scene, visitee: Visitee) -> str:
    person, distance = visitee.name, visitee.values["conversational_distance"].number
    accepted = _accepted(visitee).values()
    if not accepted and visitee.not_from:
        return f"the scenario rules out every side that {person} accepts ({', '.join(sides(visitee.values))})"
    blocked = {side.name: pose_blocker(scene, person, distance, side.bearing_deg) for side in accepted}
    free = {side for _, side in _free_places(scene, visitee)} if any(blocked.values()) else frozenset()
    seen = "" if visitee.now.hears else f" within {widest_deg(visitee.values):g} deg of where they face"
    why = "" if visitee.now.hears else ", who does not hear"
    return f"no free and reachable place{seen} before {person}{why}: {_told(blocked, free)}"


def _told(blocked: Mapping[str, str | None], free: Collection[str]) -> str:
    """Why each side is out of reach.

    Args:
        blocked: What stands at the place that the person would have, by side; None where no way leads there.
        free: Sides with any free place.
    """
    if not any(blocked.values()):
        return with_verb(blocked, "has no way to it", "have no way to them")
    words = [
        f"{side} is blocked by {what}" if what else f"{side} has no way to it"
        for side, what in blocked.items()
    ]
    elsewhere = [side for side, what in blocked.items() if what and side in free]
    more = f"; no way leads to other free places ({listed(elsewhere)})" if elsewhere else ""
    return ", ".join(words) + more
