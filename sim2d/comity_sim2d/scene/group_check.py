"""Check that people who stand together see each other, with doors as at the start.

Like the check of walks, it is not part of the scene itself: a door may shut between them later.
"""

from __future__ import annotations

from itertools import combinations
from typing import TYPE_CHECKING

from comity_sim2d.scene.obstacles import floor_plan
from comity_sim2d.scene_error import SceneError

if TYPE_CHECKING:
    from comity_sim2d.scene.scene import Scene


def check_groups(scene: Scene) -> None:
    """Reject groups with a wall or a shut door between two of their members.

    Raises:
        SceneError: For the first invalid group.
    """
    plan = floor_plan(scene)
    for group in scene.groups:
        for one, other in combinations(group.those_of(scene.people), 2):
            wall = plan.wall_between(one.xy, other.xy)
            if wall is not None:
                raise SceneError(
                    entity=group.name,
                    field="members",
                    expected="people who stand together, with nothing between them but room",
                    got=f"{wall} between {one.name} and {other.name}",
                    remedy="Move one of them, or leave them out of the group.",
                )
