"""Check that people can follow the walks of a scene, with its doors in their initial state.

It is not part of the scene itself: after a door has shut, a walk may lead through it, and that scene can
still be planned in and drawn.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from comity_sim2d.scene.footpath import Footpaths
from comity_sim2d.scene.obstacles import floor_plan
from comity_sim2d.scene_error import SceneError

if TYPE_CHECKING:
    from comity_sim2d.scene.scene import Scene


def check_walks(scene: Scene) -> None:
    """Reject walks that lead into obstacles, through walls or through shut doors.

    Raises:
        SceneError: For the first point that cannot be reached.
    """
    plan = floor_plan(scene)
    walkers = [(person, person.walk) for person in scene.people if person.walk is not None]
    paths = {radius: Footpaths(plan, radius) for radius in {person.radius_m for person, _ in walkers}}
    for person, walk in walkers:
        here = person.xy
        for point in walk.route:
            blocker = plan.blocker(point, person.radius_m)
            if blocker is not None or paths[person.radius_m].between(here, point) is None:
                raise SceneError(
                    entity=person.name,
                    field="walk",
                    expected="points that can be walked to",
                    got=f"{point}, which {blocker.relation if blocker else f'has no way from {here}'}",
                    remedy="Move the point.",
                )
            here = point
