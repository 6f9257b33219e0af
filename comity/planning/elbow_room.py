"""Space for a gesture: no wall or body may be within its reach, in front of or next to the robot."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace
from math import dist, pi
from typing import TYPE_CHECKING

from comity_domain import FORWARDS, Spot, Visitee, reach_of
from comity_fis import Choice
from comity_sim2d import Pose
from comity_sim2d.pose import XY, direction_to
from comity_sim2d.scene.obstacles import floor_plan

if TYPE_CHECKING:
    from shapely.geometry.base import BaseGeometry

    from comity_sim2d import Scene
    from comity_sim2d.scene.obstacles import FloorPlan

EXACT_M = 1e-6


def with_elbow_room(scene: Scene, visitee: Visitee, spots: Mapping[Spot, XY]) -> Visitee:
    """The same person without the gestures that would hit a wall, a shut door or a person.

    Furniture does not count: how high it is is not known, and people greet each other across a counter.

    A gesture is out where that is so at any of the sides from which the plan may have the robot come: sides
    and gestures are weighed independently of each other.

    Args:
        scene: Where everybody and everything is.
        visitee: The person to greet.
        spots: Where the robot may stand before them.
    """
    reach_m = {gesture: reach_of(gesture, visitee.now.reach_m) for gesture in sorted(_gestures(visitee))}
    plan = floor_plan(scene).bare
    hits: dict[str, str] = {}
    for spot, xy in spots.items():
        for gesture, far_m in reach_m.items() if _is_narrow(scene, plan, xy, max(reach_m.values())) else ():
            stands = Pose(*xy, direction_to(xy, scene.person(spot.place).xy))
            swept = _swept(stands, scene.robot.radius_m, far_m, forwards=gesture in FORWARDS)
            but = spot.place if gesture in visitee.now.touches else None
            found = min(_things(swept, scene, xy, but), default=None) if far_m > 0.0 else None
            if found is not None:
                hits.setdefault(gesture, _in_words(found, spot, far_m))
    return replace(visitee, now=replace(visitee.now, hits=hits)) if hits else visitee


def _is_narrow(scene: Scene, plan: FloorPlan, xy: XY, reach_m: float) -> bool:
    """Whether anything is as near to a robot there as that: seldom so, and quickly told."""
    within_m = scene.robot.radius_m + reach_m
    is_near = any(dist(body.xy, xy) < body.radius_m + within_m for body in scene.people)
    return is_near or plan.blocker(xy, within_m) is not None


def _swept(stands: Pose, robot_m: float, reach_m: float, *, forwards: bool) -> BaseGeometry:
    """The floor that a gesture may sweep: forwards as wide as the body, else all before and beside it."""
    from shapely import LineString, Point, Polygon

    reach_m -= EXACT_M
    if forwards:
        return LineString([stands.xy, stands.ahead(reach_m)]).buffer(robot_m)
    wide_m = robot_m + reach_m
    ahead, left = (Pose(0.0, 0.0, stands.heading_rad).ahead(wide_m, turn) for turn in (0.0, pi / 2))
    sides = [(stands.x_m + side * left[0], stands.y_m + side * left[1]) for side in (1, -1)]
    fronts = [(x + ahead[0], y + ahead[1]) for x, y in reversed(sides)]
    return Point(stands.xy).buffer(wide_m).intersection(Polygon([*sides, *fronts]))


def _gestures(visitee: Visitee) -> set[str]:
    """All that may be chosen, and those that need what is not so."""
    gesture = visitee.values["greeting_gesture"]
    open_ones = gesture.desirability.memberships if isinstance(gesture.desirability, Choice) else ()
    return {gesture.word, *open_ones, *visitee.now.withheld}


def _in_words(found: tuple[float, str], spot: Spot, reach_m: float) -> str:
    gap_m, name = found
    return (
        f"{name} would be {max(0.0, gap_m):.2f} m from the robot on the {spot.side} side of {spot.place}, "
        f"within the {reach_m:.2f} m that it reaches"
    )


def _things(swept: BaseGeometry, scene: Scene, xy: XY, but: str | None) -> Iterator[tuple[float, str]]:
    """What a gesture would sweep, and how far each is from the robot's body [m].

    Args:
        swept: The floor.
        scene: Where everybody and everything is.
        xy: Where the robot stands.
        but: The person whom a gesture of contact is for: they consented to it.
    """
    from shapely import Point

    robot_m = scene.robot.radius_m
    if (thing := floor_plan(scene).bare.within(swept, xy)) is not None:
        yield thing.gap_m - robot_m, thing.name
    for body in scene.people:
        if body.name != but and swept.distance(Point(body.xy)) < body.radius_m:
            yield dist(body.xy, xy) - body.radius_m - robot_m, body.name
