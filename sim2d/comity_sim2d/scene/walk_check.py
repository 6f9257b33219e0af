"""Check that people can walk where a scene has them walk, with its doors as they set out.

This is no check of the scene itself: after a door has shut, a person's walk leads through it, and the scene
of that moment can still be planned in and drawn.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from comity_sim2d.scene.footpath import Footpaths
from comity_sim2d.scene.obstacles import floor_plan
from comity_sim2d.scene_error import SceneError

if TYPE_CHECKING:
    from comity_sim2d.scene.scene import Scene


def check_walks(scene: Scene) -> None:
    """Refuse walks that lead into things, through walls or through shut doors.

    Raises:
        SceneError: For the first point that cannot be walked to.
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
