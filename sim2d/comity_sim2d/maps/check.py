"""Validity of a map with all doors open: a robot can reach every room and every location.

The robot has the default radius; what a scenario's own robot can reach is up to the planner.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from comity_sim2d.maps.door_gaps import OFF_M
from comity_sim2d.maps.file import MAX_CORNERS
from comity_sim2d.scene.obstacles import WALL_MARGIN_M, FloorPlan, floor_plan_of
from comity_sim2d.scene.robot_body import ROBOT_RADIUS_M
from comity_sim2d.scene.room import CIRCLE_CORNERS
from comity_sim2d.scene.scene_check import check_count, check_on_floor, check_own_names, check_simple
from comity_sim2d.scene_error import SceneError, require_finite

if TYPE_CHECKING:
    from shapely import Polygon

    from comity_sim2d.maps.place_map import PlaceMap
    from comity_sim2d.pose import XY
    from comity_sim2d.scene.area import Area, Location
    from comity_sim2d.scene.room import Furniture

LEAST_PART_M2 = 1e-6
MOST_NAMED = 3
"""Maximum number of objects in doors that are named; more are counted (our choice)."""
WAY_M = 2 * (ROBOT_RADIUS_M + WALL_MARGIN_M)
"""Width that a robot of the default radius needs between static obstacles [m]."""
ROUNDING_M = 1e-6
"""Tolerance of coordinates [m], so that a gap drawn exactly wide enough counts."""


def check_parts(
    areas: Sequence[Area],
    furniture: Sequence[Furniture],
    holes: Sequence[Sequence[XY]],
    walls_and_doors: int,
) -> None:
    """Reject too many parts, duplicate names, and invalid outlines.

    Raises:
        SceneError: For the first thing that is wrong.
    """
    check_count(len(furniture) + walls_and_doors)
    outlines = [*(area.corners for area in areas), *holes, *(piece.corners for piece in furniture)]
    corners = sum(map(len, outlines))
    if corners > MAX_CORNERS:
        raise SceneError(
            entity="scene",
            expected=f"rooms, holes and furniture of at most {MAX_CORNERS} corners, "
            f"{CIRCLE_CORNERS} to a circle",
            got=f"{corners}",
            remedy="Give polygons fewer corners, write boxes for what is nearly one, or cut the map.",
        )
    check_own_names((piece.name for piece in furniture), "every piece of furniture")
    for area in areas:
        for x, y in area.corners:
            require_finite(f"room {area.name}", x=x, y=y)
        check_simple(f"room {area.name}", area.corners)
    for number, hole in enumerate(holes, 1):
        check_simple(f"hole {number}", tuple(hole))
    for piece in furniture:
        check_simple(piece.name, piece.corners)


def check_map(place: PlaceMap) -> None:
    """Reject a map with a room or location that a robot cannot reach although all doors are open.

    Raises:
        SceneError: For the first thing that is wrong.
    """
    plan = floor_plan_of(place.room, place.walls, place.furniture, doors=())
    check_on_floor(place.room, place.walls, place.furniture)
    reach = _largest_part(plan)
    for area in place.areas:
        _check_room(area, place, reach)
    for location in place.locations:
        _check_location(location, plan, reach)


def _largest_part(plan: FloorPlan) -> Polygon | None:
    """The largest connected region of the floor where the robot's centre can be.

    Of equally large ones it is the leftmost, independently of the GEOS version.
    """
    from shapely import Polygon, get_parts, prepare

    # Rounded corners must not close the gap: routes leave 5 mm and pass through.
    clear = plan.clear_space(WAY_M / 2 - ROUNDING_M, at_least=False)
    parts = [part for part in get_parts(clear) if isinstance(part, Polygon) and part.area > LEAST_PART_M2]
    largest = max(
        parts, key=lambda part: (round(part.area, 6), -part.bounds[0], -part.bounds[1]), default=None
    )
    if largest is not None:
        prepare(largest)
    return largest


def _check_room(area: Area, place: PlaceMap, reach: Polygon | None) -> None:
    from shapely import Polygon

    inside = Polygon(area.corners).buffer(-ROBOT_RADIUS_M)  # all of the robot: in a door it is not there
    if reach is not None and reach.intersection(inside).area > LEAST_PART_M2:
        return
    got, remedy = "no room for a robot at all", "Make it larger, or take furniture out."
    if reach is not None:
        got = "one without a way into it that is wide enough" + _in_its_doors(area, place)
        remedy = f"Add a door of {WAY_M:.2f} m or more, or clear the way of furniture."
    raise SceneError(
        entity=f"room {area.name}",
        expected=f"a room that a robot {2 * ROBOT_RADIUS_M:g} m across can get into when all doors are open",
        got=got,
        remedy=remedy,
    )


def _in_its_doors(area: Area, place: PlaceMap) -> str:
    """What stands in the doors of a room, as the end of a sentence; empty if they are clear."""
    from shapely import LineString, Polygon

    room = Polygon(area.corners).boundary
    gaps = [(door, LineString([door.start, door.end])) for door in place.doors]
    blocked = [
        f"{piece.name!r} stands in the door {door.name!r}"
        for door, gap in gaps
        for piece in place.furniture
        if room.distance(gap) <= OFF_M and Polygon(piece.corners).distance(gap) < door.thickness_m / 2
    ]
    more = f" and {len(blocked) - MOST_NAMED} more" if len(blocked) > MOST_NAMED else ""
    return f": {', '.join(blocked[:MOST_NAMED])}{more}" if blocked else ""


def _check_location(location: Location, plan: FloorPlan, reach: Polygon | None) -> None:
    from shapely import Point

    clearance = WAY_M / 2
    blocker = plan.blocker(location.xy, clearance - ROUNDING_M)
    where = f"({location.x_m:g}, {location.y_m:g})"
    if not plan.room.covers(Point(location.xy)):
        raise SceneError(
            entity=f"location {location.name}",
            expected="a point in a room",
            got=f"{where}, which is in none",
            remedy="Move it into a room, or leave it out.",
        )
    if blocker is not None:
        gap = blocker.gap_m + clearance
        raise SceneError(
            entity=f"location {location.name}",
            expected=f"a point at least {clearance:g} m from walls and furniture, free for a robot",
            got=f"{where}, {_nearness(gap)} {blocker.name}",
            remedy=f"Move it away from {blocker.name}.",
        )
    if reach is None or reach.distance(Point(location.xy)) > 1e-3:
        raise SceneError(
            entity=f"location {location.name}",
            expected="a point that a robot can get to when all doors are open",
            got=f"{where}, to which no way is wide enough",
            remedy=f"Clear a way {WAY_M:.2f} m wide of furniture, widen a door, or move the location.",
        )


def _nearness(gap_m: float) -> str:
    return f"{gap_m:.2f} m from" if gap_m > 1e-5 else "inside"
