"""Random places to stand: uniform over the free floor, clear of obstacles and people.

Drawn points that are not free are rejected and drawn again, at most `MOST_DRAWS` times.
"""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
from numpy.typing import NDArray

from comity_fis.proxemics import PERSON_MARGIN_M
from comity_sim2d.kinds import require_kinds
from comity_sim2d.pose import XY
from comity_sim2d.scene.area import Area
from comity_sim2d.scene.obstacles import WALL_MARGIN_M, FloorPlan
from comity_sim2d.scene.robot_body import ROBOT_RADIUS_M
from comity_sim2d.scene_error import FARTHEST_M, require_between, require_points

MOST_DRAWS = 10_000
BATCH = 250
"""Number of points drawn and tested together."""

Body = tuple[XY, float]
"""An existing disc: its centre and radius [m]."""


def random_spot(
    plan: FloorPlan,
    bodies: Iterable[Body],
    radius_m: float,
    rng: np.random.Generator,
    *,
    within: Area | None = None,
) -> XY | None:
    """A random place for a disc, with the robot's clearance from obstacles and 0.30 m from bodies [m].

    Args:
        plan: The static obstacles.
        bodies: People already there.
        radius_m: Radius of the disc [m].
        rng: The random generator.
        within: Room of the place; None: anywhere.

    Returns:
        None if `MOST_DRAWS` points were not free.
    """
    from shapely import Polygon, contains_xy, intersection, prepare

    require_kinds(
        "spot", plan=(plan, FloorPlan), rng=(rng, np.random.Generator), within=(within, Area | None)
    )
    require_between("spot", "radius_m", radius_m, 0.0, FARTHEST_M)
    taken = _taken(bodies)
    free = plan.clear_space(max(radius_m, ROBOT_RADIUS_M) + WALL_MARGIN_M)
    if within is not None:
        free = intersection(free, Polygon(within.corners))
    if free.area <= 0.0:
        return None
    prepare(free)
    low_x, low_y, high_x, high_y = free.bounds
    for _ in range(MOST_DRAWS // BATCH):
        points = rng.uniform((low_x, low_y), (high_x, high_y), (BATCH, 2))
        good = contains_xy(free, points) & _apart(points, radius_m, taken)
        if good.any():
            x, y = points[int(np.argmax(good))].tolist()
            return (x, y)
    return None


def _taken(bodies: Iterable[Body]) -> list[Body]:
    """The discs, each checked to be a position and a radius."""
    require_kinds("spot", bodies=(bodies, Iterable))
    taken = list(bodies)
    for body in taken:
        require_kinds("spot", bodies=(body, tuple))
        xy, radius_m = body if len(body) == 2 else (body, 0.0)
        require_points("spot", "bodies", (xy,))
        require_between("spot", "bodies", radius_m, 0.0, FARTHEST_M)
    return taken


def _apart(points: NDArray[np.float64], radius_m: float, bodies: list[Body]) -> NDArray[np.bool_]:
    good = np.ones(len(points), dtype=bool)
    for (x, y), other_m in bodies:
        good &= np.hypot(points[:, 0] - x, points[:, 1] - y) >= radius_m + other_m + PERSON_MARGIN_M
    return good
