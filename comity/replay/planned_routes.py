"""Planned routes between docking poses."""

from __future__ import annotations

from dataclasses import replace
from functools import partial
from itertools import pairwise
from typing import TYPE_CHECKING

from comity.parameters.passing import own_distance_m
from comity.planning.agenda import places_for
from comity.planning.request import spots_of
from comity.preparation import resolved
from comity.replay.plans_data import stages_of
from comity.simulation.scene_later import scene_at
from comity_domain import Spot
from comity_domain.plans.actions import FETCH, REACH, RETURN
from comity_fis import InputError
from comity_sim2d import DoorTurn, PlannedRoute, RouteMap, SceneError

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator

    from comity.answers.plan import StepAnswer
    from comity.replay.saved_run import SavedRun
    from comity_domain import Visitee
    from comity_sim2d import Scene

    XY = tuple[float, float]


def planned_routes(run: SavedRun) -> tuple[PlannedRoute, ...]:
    """The routes of the first plan and of every replacement, by time; empty if there is no path.

    A pseudonymised run has none: its docking poses cannot be computed without profiles.

    A plan, and therefore its route, uses people's positions at the time of planning only.
    """
    if run.account.shared:
        return ()
    try:
        file = replace(run.file, real_robot=run.account.robot is not None)
        stage = resolved(file, seed=run.account.seed)
    except InputError:
        return ()
    values = dict(stage.values)
    routes = [PlannedRoute(0.0, _corners(lambda: stage.scene, stage.visitees, run.plan.steps))]
    revisions = run.account.revisions
    turns = [DoorTurn(turn.t, turn.door, turn.open) for turn in run.account.doors]
    for revision, later in zip(revisions, stages_of(run.cast, run.values, revisions)[1:], strict=True):
        values |= later
        if revision.kind != "not_replanned":
            visitees = tuple(replace(each, values=values[each.name]) for each in stage.visitees)
            own_m = {name: own_distance_m(inference) for name, inference in values.items()}
            scene_then = partial(scene_at, stage.scene, run.frames, revision.t, turns=turns, own_m=own_m)
            routes.append(PlannedRoute(revision.t, _corners(scene_then, visitees, revision.steps)))
    return tuple(routes)


def _corners(
    make_scene: Callable[[], Scene], visitees: tuple[Visitee, ...], steps: Iterable[StepAnswer]
) -> tuple[XY, ...]:
    """Corners of the route from the robot through all docking poses; empty if a path is missing."""
    try:
        scene = make_scene()
        ways = RouteMap(scene)
        found: list[XY] = []
        for start, goal in pairwise((scene.robot.pose.xy, *_stops(scene, ways, visitees, steps))):
            route = ways.route(start, goal)
            if route is None:
                return ()
            found += route.points
    except (InputError, SceneError, KeyError):  # people overlap at that time, or the robot touched a wall
        return ()
    return tuple(found)


def _stops(
    scene: Scene, ways: RouteMap, visitees: tuple[Visitee, ...], steps: Iterable[StepAnswer]
) -> Iterator[XY]:
    """Docking poses in the plan's order."""
    by_name = {visitee.name: visitee for visitee in visitees}
    places = places_for(scene, ways, visitees)
    for step in steps:
        if step.action in (REACH, RETURN):
            person, side = step.arguments[1:3]
            yield spots_of(scene, ways, by_name[person])[Spot(person, side)]
        elif step.action == FETCH and (pose := places[str(step.parameters["place"])]) is not None:
            yield pose.xy
