"""What blocks all routes to a person: shut doors, people, or gaps that are too narrow.

They may be blocking it themselves, as in a corridor that is too narrow to pass them.
"""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Callable, Collection, Iterable, Sequence
from dataclasses import replace
from functools import cache
from itertools import chain
from typing import TYPE_CHECKING

import numpy as np

from comity.planning.narrow_gap import narrow_gap
from comity_domain import in_the_way
from comity_fis.listing import with_verb
from comity_fis.proxemics import PERSON_MARGIN_M
from comity_sim2d import PastPeople
from comity_sim2d.maps.doorways import turned
from comity_sim2d.maps.topology import room_at, shut_doors_between, topology
from comity_sim2d.pose import XY
from comity_sim2d.scene.obstacles import WALL_MARGIN_M, FloorPlan, floor_plan

if TYPE_CHECKING:
    from comity_sim2d import Scene

MOST_TRIED = 12
"""Doors, and people, one at a time, the rest together: leaving some out costs about 0.1 s (our choice)."""
MOST_NAMED = 3
"""Maximum number of blocking people that are named; more are counted (our choice)."""
STEP_M = 0.01
"""To which the widest way is told."""


def barring(
    scene: Scene, person: str, goals: Sequence[XY], is_reached: Callable[[Scene], bool]
) -> str | None:
    """What blocks all routes to a person, in words; None if it is nothing of one kind.

    Args:
        scene: As everything is.
        person: Who cannot be reached.
        goals: Where the robot could stand, had it a way there.
        is_reached: Whether the robot gets to them in another scene.
    """
    shut = _shut_doors(scene, person, is_reached)
    if shut or not goals:
        return shut
    return (
        _people(scene, person, goals, is_reached)
        or _narrow(scene, goals)
        or _themselves(scene, person, goals)
    )


def _shut_doors(scene: Scene, person: str, is_reached: Callable[[Scene], bool]) -> str | None:
    needed = _shut_on_the_way(scene, person, lambda names: is_reached(opened(scene, names)))
    if not needed:
        return None
    names = with_verb([repr(name) for name in needed], "is", "are")
    return f"the door{'s' if len(needed) > 1 else ''} {names} shut"


def _shut_on_the_way(scene: Scene, person: str, does: Callable[[Collection[str]], bool]) -> Sequence[str]:
    """The fewest doors that have to open: by the graph of the rooms, else by trying them."""
    here, there = room_at(scene, scene.robot.pose.xy), room_at(scene, scene.person(person).xy)
    if here is not None and there is not None:
        ways = shut_doors_between(topology(scene), here, there)
        found = next((shut for shut in ways if shut and does(shut)), None)
        if found is not None:
            return found
    return _needed([door.name for door in scene.doors if not door.is_open], does)


def _people(
    scene: Scene, person: str, goals: Sequence[XY], is_reached: Callable[[Scene], bool]
) -> str | None:
    others = [other.name for other in scene.people if other.name != person]
    needed = _needed(others, lambda names: is_reached(scene.without(names)))
    if not needed:
        return None
    gap = narrow_gap(scene, person, goals)
    return f"{_who(needed)} in the way" + (f"; {gap.words}" if gap else "")


def _who(needed: Sequence[str]) -> str:
    if len(needed) > MOST_NAMED:
        return f"{len(needed)} people are"
    return with_verb(needed, "is", "are")


def _narrow(scene: Scene, goals: Sequence[XY]) -> str | None:
    """How wide the widest way is, where that is too narrow for the robot; found by halving."""
    need_m, plan = 2 * (scene.robot.radius_m + WALL_MARGIN_M), floor_plan(scene)
    steps = range(1, round(need_m / STEP_M))  # the margin that routes may use is below a step

    def is_shut(step: int) -> bool:
        return not _joins(plan, step * STEP_M, scene.robot.pose.xy, goals)

    shut = bisect_left(steps, True, key=is_shut)
    if shut in (0, len(steps)):
        return None
    return (
        f"the robot needs ways {need_m:.2f} m wide, and none there is wider than {steps[shut] * STEP_M:.2f} m"
    )


def _themselves(scene: Scene, person: str, goals: Sequence[XY]) -> str | None:
    """That whoever is visited is in the way, where past them there is one: they make none for a visit."""
    others = [other.name for other in scene.people if other.name != person]
    past, start = PastPeople(scene, others), scene.robot.pose.xy
    if not any(past.reaches(start, goal) for goal in goals):
        return None
    if (gap := narrow_gap(scene, person, goals, beside_visited=True)) is not None:
        return f"{person} bars the way: {gap.words}"
    beside_m = PERSON_MARGIN_M + 2 * scene.robot.radius_m + WALL_MARGIN_M
    return f"{person} bars the way: the robot needs {beside_m:.2f} m between them and a wall to get past"


def _joins(plan: FloorPlan, width_m: float, start: XY, goals: Sequence[XY]) -> bool:
    """Whether a way so wide leads from a place to one of some others."""
    from shapely import get_parts, intersects_xy

    parts = get_parts(plan.clear_space(width_m / 2))
    here = parts[intersects_xy(parts, *start)]
    return any(bool(intersects_xy(part, *np.array(goals).T).any()) for part in here)


def _needed(names: Sequence[str], does: Callable[[Collection[str]], bool]) -> list[str]:
    """Those of which one alone does, else those that do together; none where all of them do not."""
    does_once = cache(does)  # all of them are asked about twice, and so is one alone
    if not names or not does_once(tuple(names)):
        return []
    tried = [*([name] for name in names[:MOST_TRIED]), *([names[MOST_TRIED:]] if names[MOST_TRIED:] else [])]
    found = in_the_way(tried, lambda lifted: does_once(tuple(chain.from_iterable(lifted))))
    return list(chain.from_iterable(found.any_of or found.all_of))


def opened(scene: Scene, names: Iterable[str]) -> Scene:
    """The scene with these doors open."""
    return replace(scene, doors=turned(scene.doors, dict.fromkeys(names, True)))
