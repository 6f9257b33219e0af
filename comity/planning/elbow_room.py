"""Room for a gesture: nothing may be within its reach, before and beside the robot that greets."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace
from math import cos, hypot, sin
from typing import TYPE_CHECKING

from comity_domain import Spot, Visitee, reach_of
from comity_fis import Choice
from comity_sim2d import Pose
from comity_sim2d.pose import direction_to
from comity_sim2d.scene.obstacles import floor_plan

if TYPE_CHECKING:
    from comity_sim2d import Scene

XY = tuple[float, float]
EXACT_M = 1e-6


def with_elbow_room(scene: Scene, visitee: Visitee, spots: Mapping[Spot, XY]) -> Visitee:
    """The same person without the gestures that would hit something or somebody.

    A gesture is out where that is so at any of the sides from which the plan may have the robot come: sides
    and gestures are weighed independently of each other.

    Args:
        scene: Where everybody and everything is.
        visitee: Whom to greet.
        spots: Where the robot may stand before them.
    """
    hits: dict[str, str] = {}
    for gesture in sorted(_gestures(visitee)):
        reach_m = reach_of(gesture, visitee.now.reach_m)
        for spot, xy in spots.items():
            found = min(
                _things(reach_m, scene, spot, xy, touched=gesture in visitee.now.touches), default=None
            )
            if found is not None and found[0] < reach_m - EXACT_M:
                hits[gesture] = _in_words(found, spot, reach_m)
                break
    return replace(visitee, now=replace(visitee.now, hits=hits)) if hits else visitee


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


def _things(
    reach_m: float, scene: Scene, spot: Spot, xy: XY, *, touched: bool
) -> Iterator[tuple[float, str]]:
    """What is nearest before and beside a robot that greets there, and how far from its body [m].

    The greeted person's own body counts, but for a gesture of contact: they consented to that.
    """
    robot_m = scene.robot.radius_m
    stands = Pose(*xy, direction_to(xy, scene.person(spot.place).xy))
    plan = floor_plan(scene)
    is_narrow = reach_m > 0.0 and plan.blocker(xy, robot_m + reach_m) is not None
    if is_narrow and (ahead := plan.ahead(stands, robot_m + reach_m)) is not None:
        yield ahead.gap_m + reach_m, ahead.name
    for body in scene.people:
        dx, dy = body.x_m - stands.x_m, body.y_m - stands.y_m
        before_m = dx * cos(stands.heading_rad) + dy * sin(stands.heading_rad)
        if before_m > -body.radius_m and not (touched and body.name == spot.place):
            yield hypot(dx, dy) - body.radius_m - robot_m, body.name
