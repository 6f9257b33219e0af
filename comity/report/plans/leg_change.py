"""Reasons why a path differs in length between two plans: start, end, and bends."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING

from comity.report.text import number
from comity_domain import START
from comity_domain.problem.bound_parameters import BEARING, DISTANCE
from comity_sim2d import spot_pose
from comity_sim2d.pose import XY

if TYPE_CHECKING:
    from comity.preparation import PlannedEpisode
    from comity_domain import Plan, PlanStep
    from comity_fis import Inference
    from comity_sim2d import Pose, Scene

HERE = (START.place, START.side)
UNITS = {DISTANCE: "m", BEARING: "deg"}
SHOWN = {"m": 0.0005, "deg": 0.05}
"""Smallest displayed difference by unit."""


def why_this_leg(old: PlanStep, new: PlanStep, before: PlannedEpisode, after: PlannedEpisode) -> str:
    """Differences between the paths to the same person or place.

    Args:
        old: Step of the first plan.
        new: Step of the second plan.
        before: Episode of the first plan.
        after: Episode of the second plan.
    """
    begins, bends = _begins(old, new, before.plan, after.plan), _bends(new, before.values, after)
    reasons = [*begins, *_ends(old, new), *bends]
    return "; ".join(reasons) or "the free places to stand before people are others"


def _begins(old: PlanStep, new: PlanStep, before: Plan, after: Plan) -> Iterator[str]:
    if old.origin != new.origin:
        yield f"from {_place(old.origin)}, and now from {_place(new.origin)}"
        return
    was, is_ = _stand(old, before), _stand(new, after)
    if was is not None and is_ is not None:
        yield from (f"from {was.person}: {change}" for change in _moved(was, is_))


def _ends(old: PlanStep, new: PlanStep) -> Iterator[str]:
    if old.arguments[2:] != new.arguments[2:]:
        yield f"to {_words(old)}, and now to {_words(new)}"
    yield from (f"to {new.person}: {change}" for change in _moved(old, new))


def _words(step: PlanStep) -> str:
    return f"{step.person}'s {step.arguments[-1]}" if BEARING in step.parameters else step.arguments[-1]


def _place(origin: tuple[str, str] | None) -> str:
    if origin is None or origin == HERE:
        return "where the robot starts"
    place, side = origin
    return f"{place}'s {side}" if side else place


def _moved(old: PlanStep, new: PlanStep) -> Iterator[str]:
    """Changes of the docking pose; for another side, only the distance."""
    names = (DISTANCE, BEARING) if old.arguments[-1] == new.arguments[-1] else (DISTANCE,)
    for name in names:
        was, is_ = old.parameters.get(name), new.parameters.get(name)
        unit = UNITS[name]
        if isinstance(was, float) and isinstance(is_, float) and abs(was - is_) >= SHOWN[unit]:
            yield f"{name.replace('_', ' ')} {number(was, unit)} → {number(is_, unit)}"


def _stand(step: PlanStep, plan: Plan) -> PlanStep | None:
    """The step after which the robot starts this one; None at the start."""
    earlier = plan.steps[: plan.steps.index(step)]
    stands = [one for one in earlier if BEARING in one.parameters]
    stood = stands[-1] if stands else None
    return stood if stood and step.origin == (stood.person, stood.arguments[-1]) else None


def _bends(new: PlanStep, before: Mapping[str, Inference], after: PlannedEpisode) -> Iterator[str]:
    """People next to the path whose preferred passing distance changed."""
    stood, start = _stand(new, after.plan), _start(new, after)
    goal = _goal(new, after.scene, after.asked.places)
    ends = {new.person} | ({stood.person} if stood else set())
    length = after.route_map.length(start, goal)
    for name, values in before.items():
        was, is_ = values[DISTANCE].number, after.values[name][DISTANCE].number
        if name in ends or abs(was - is_) < SHOWN["m"]:
            continue
        other = after.route_map.length(start, goal, keep={name: was})
        if length is not None and other is not None and round(100 * length) != round(100 * other):
            yield f"past {name}, who likes to be passed at {number(was, 'm')}, and now at {number(is_, 'm')}"


def _start(step: PlanStep, prepared: PlannedEpisode) -> XY:
    stood, places = _stand(step, prepared.plan), prepared.asked.places
    if stood is not None:
        return _goal(stood, prepared.scene, places)
    place = step.origin[0] if step.origin else ""
    fetched = places.get(place) if step.origin != HERE else None
    return prepared.scene.robot.pose.xy if fetched is None else fetched.xy


def _goal(step: PlanStep, scene: Scene, places: Mapping[str, Pose]) -> XY:
    distance, bearing = step.parameters.get(DISTANCE), step.parameters.get(BEARING)
    if not isinstance(distance, float) or not isinstance(bearing, float):
        return places[step.arguments[-1]].xy
    return spot_pose(scene, step.person, distance, bearing).xy
