"""A plan for as many as one can serve: people may be cut off from each other, and each be reached first."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import TYPE_CHECKING

from comity.planning.request import PlanningRequest, spots_of, what_bars
from comity_domain import PlanningFailed, parts
from comity_sim2d import RouteMap
from comity_sim2d.scene.surroundings import Surroundings

if TYPE_CHECKING:
    from comity_domain import Visitee, VisitPlan, VisitRequest
    from comity_sim2d import Scene


def plan_for_most(
    asked: PlanningRequest, scene: Scene, route_map: RouteMap, make: Callable[[VisitRequest], VisitPlan]
) -> tuple[PlanningRequest, VisitPlan]:
    """The plan; where no way leads from some to others, of as many as there are ways between.

    Args:
        asked: The people to visit.
        scene: Where everybody stands.
        route_map: Its routes, as they were asked with.
        make: Plans.

    Returns:
        What the plan is for, with the people it leaves out and why; and the plan.

    Raises:
        PlanningFailed: There is none for these either, or none was found.
    """
    try:
        return asked, make(asked.request)
    except PlanningFailed as failed:
        together = () if failed.cut_off else parts(asked.request)
        if len(together) < 2:
            raise
        narrowed = _only(together[0], asked, scene, route_map)
        try:
            return narrowed, make(narrowed.request)
        except PlanningFailed:
            raise failed from None


def _only(
    names: tuple[str, ...], asked: PlanningRequest, scene: Scene, route_map: RouteMap
) -> PlanningRequest:
    """The request for some alone; the others are as those whom no plan can serve."""
    visitees = {visitee.name: visitee for visitee in asked.request.visitees}
    left = [visitee for visitee in visitees.values() if visitee.name not in names]
    prices = {each.name: each.skip_m for each in left if each.skip_m is not None}
    request = asked.request.without([each.name for each in left])
    there = _standing_before(visitees[names[0]], scene, route_map)
    reasons = {
        each.name: f"no way leads to {each.name} from {names[0]}{_what_is_between(there, each)}"
        for each in left
        if each.name not in prices
    }
    return replace(
        asked,
        request=replace(request, dropped_m={**request.dropped_m, **prices}),
        unreachable={**asked.unreachable, **reasons},
    )


def _standing_before(visitee: Visitee, scene: Scene, route_map: RouteMap) -> Scene:
    """The scene with the robot before a person."""
    x_m, y_m = next(iter(spots_of(scene, route_map, visitee).values()))
    return replace(scene, robot=replace(scene.robot, x_m=x_m, y_m=y_m))


def _what_is_between(scene: Scene, visitee: Visitee) -> str:
    """What keeps the robot from a person, as the end of the reason."""
    place = Surroundings.of(scene)
    for space in place.o_spaces:
        others = tuple(other for other in place.o_spaces if other != space)
        if spots_of(scene, RouteMap(replace(place, o_spaces=others)), visitee):
            return f": {space.words} is in the way"
    return what_bars(scene, visitee)
