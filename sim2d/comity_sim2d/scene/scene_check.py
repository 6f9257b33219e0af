"""Checks of a scene: finds people and objects in impossible places before anything moves."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterable
from functools import lru_cache
from itertools import combinations
from typing import TYPE_CHECKING, Protocol

from comity_fis.proxemics import PERSON_MARGIN_M
from comity_sim2d.scene.obstacles import ROOM, Floor, FloorPlan, floor_plan
from comity_sim2d.scene.passers_by import PassersBy
from comity_sim2d.scene.person import Person
from comity_sim2d.scene_error import SceneError

if TYPE_CHECKING:
    from comity_sim2d.pose import XY
    from comity_sim2d.scene.robot_body import RobotBody
    from comity_sim2d.scene.room import Furniture, Room, Wall

MAX_OBSTACLES = 1000
"""Maximum number of walls, doors and furniture together (our choice: for routes, see `ways.MOST_CORNERS`)."""
MAX_PEOPLE = 1000
"""Maximum number of people in a scene, without passers-by, who have a limit of their own (our choice)."""

PLACES_KEPT = 64
"""Number of places cached as valid: replanning builds the same ones with people elsewhere."""
LEAST_AREA_M2 = 1e-4
"""Minimum area of a room or a piece of furniture [m^2] (our choice: less is a typo)."""


class Filled(Floor, Protocol):
    """A place with a robot and people."""

    @property
    def robot(self) -> RobotBody:
        """The robot at its start."""
        ...

    @property
    def people(self) -> tuple[Person, ...]:
        """The people at their starts."""
        ...

    @property
    def passers_by(self) -> PassersBy | None:
        """The passers-by."""
        ...


def check_scene(scene: Filled) -> None:
    """Reject an invalid scene.

    Raises:
        SceneError: For the first problem found.
    """
    _check_count(scene)
    _check_names(scene)
    _check_margins(scene.people)
    _check_outlines(scene.room, scene.furniture)
    check_on_floor(scene.room, scene.walls, scene.furniture)
    plan = floor_plan(scene)
    bodies: list[Person | RobotBody] = [*scene.people, scene.robot]
    for body in bodies:
        sits = isinstance(body, Person) and body.posture == "seated"
        _check_place(plan.bare if sits else plan, body)
    _check_apart(scene)


def _check_count(scene: Filled) -> None:
    check_count(len(scene.walls) + len(scene.doors) + len(scene.furniture))
    if len(scene.people) > MAX_PEOPLE:
        raise SceneError(
            entity="scene",
            field="people",
            expected=f"at most {MAX_PEOPLE} people",
            got=f"{len(scene.people)}",
            remedy="Leave some out, or have them as passers-by.",
        )


def _check_margins(people: Iterable[Person]) -> None:
    for person in people:
        if person.margin_m != PERSON_MARGIN_M:
            raise SceneError(
                entity=person.name,
                field="margin_m",
                expected=f"{PERSON_MARGIN_M:g} m at the start: a robot that is let pass lowers it",
                got=f"{person.margin_m:g}",
                remedy="Leave it out, and set `margin_m` of the robot.",
            )


def check_count(obstacles: int) -> None:
    """Reject more obstacles than routes can be planned around in bounded time.

    Raises:
        SceneError: With the entity `scene`.
    """
    if obstacles > MAX_OBSTACLES:
        raise SceneError(
            entity="scene",
            expected=f"at most {MAX_OBSTACLES} walls, doors and pieces of furniture",
            got=f"{obstacles}",
            remedy="Join adjoining pieces into one polygon, or cut the map.",
        )


def _check_names(scene: Filled) -> None:
    names = [scene.robot.name, *(p.name for p in scene.people), *(f.name for f in scene.furniture)]
    names += scene.passers_by.names if scene.passers_by else ()
    names += [f"door {door.name}" for door in scene.doors]
    check_own_names(names, "the robot, every person and every piece of furniture")


def check_own_names(names: Iterable[str], bearers: str) -> None:
    """Reject duplicate names.

    Args:
        names: The names, with repetitions.
        bearers: What has these names, for the message.

    Raises:
        SceneError: For the first such name.
    """
    for name, times in Counter(names).items():
        if times > 1:
            raise SceneError(
                entity=name,
                field="name",
                expected=f"a name of its own for {bearers}",
                got=f"{name!r} {times} times",
                remedy="Rename all but one.",
            )


@lru_cache(maxsize=PLACES_KEPT)
def _check_outlines(room: Room, furniture: tuple[Furniture, ...]) -> None:
    for outline in room.outlines:
        check_simple("room", outline)
    _check_holes(room)
    for piece in furniture:
        check_simple(piece.name, piece.corners)


def _check_holes(room: Room) -> None:
    from shapely import Polygon

    floor = Polygon(room.corners)
    for hole in room.holes:
        if not floor.covers(Polygon(hole)):
            raise SceneError(
                entity="room",
                field="holes",
                expected="holes inside the room's outer outline",
                got=f"one that reaches outside, {hole}",
                remedy="Move it inside, or leave it out.",
            )


def check_simple(entity: str, corners: tuple[XY, ...]) -> None:
    """Reject an outline that crosses itself or has no area.

    Raises:
        SceneError: With this entity.
    """
    from shapely import Polygon
    from shapely.validation import explain_validity

    outline = Polygon(corners)
    if outline.convex_hull.area < LEAST_AREA_M2:  # crossing itself or not: corners on one line
        raise _without_area(entity, outline.convex_hull.area)
    if not outline.is_valid:
        raise SceneError(
            entity=entity,
            field="corners",
            expected="an outline that does not cross itself",
            got=_in_words(explain_validity(outline)),
            remedy="List the corners in order along the outline.",
        )
    if outline.area < LEAST_AREA_M2:
        raise _without_area(entity, outline.area)


def _in_words(reason: str) -> str:
    """A reason such as `Self-intersection[5 5]` as the end of a sentence."""
    kind, _, at = reason.lower().rstrip("]").partition("[")
    return f"a {kind} at ({at.replace(' ', ', ')})" if at else kind


def _without_area(entity: str, area_m2: float) -> SceneError:
    return SceneError(
        entity=entity,
        field="corners",
        expected="an outline around at least one square centimetre",
        got="corners on one line, which have no area" if area_m2 == 0 else f"{area_m2:.1e} m2",
        remedy="Move the corners apart.",
    )


@lru_cache(maxsize=PLACES_KEPT)
def check_on_floor(room: Room, walls: tuple[Wall, ...], furniture: tuple[Furniture, ...]) -> None:
    """Reject walls and furniture that are entirely outside the room.

    Raises:
        SceneError: For the first of them; an unnamed wall goes by its number, from 1.
    """
    from shapely import LineString, Polygon

    floor = Polygon(room.corners, room.holes)
    for number, wall in enumerate(walls, 1):
        if floor.distance(LineString([wall.start, wall.end])) > wall.thickness_m / 2:
            raise _outside(wall.name or f"wall {number}", f"a wall from {wall.start} to {wall.end}")
    for piece in furniture:
        if not floor.intersects(Polygon(piece.corners)):
            x, y = piece.corners[0]
            raise _outside(piece.name, f"{piece.name} at ({x:g}, {y:g})")


def _outside(entity: str, got: str) -> SceneError:
    return SceneError(
        entity=entity,
        expected="walls and furniture that are at least partly inside the room",
        got=f"{got}, wholly outside",
        remedy="Move it into the room, or leave it out.",
    )


def _check_place(plan: FloorPlan, body: Person | RobotBody) -> None:
    blocker = plan.blocker(body.pose.xy, body.radius_m)
    if blocker is not None:
        raise SceneError(
            entity=body.name,
            expected=f"a disc of radius {body.radius_m:g} m inside the room, clear of walls and furniture",
            got=f"({body.x_m:g}, {body.y_m:g}), which {blocker.relation}",
            remedy=_remedy(plan, body, blocker.name),
        )


def _remedy(plan: FloorPlan, body: Person | RobotBody, blocker: str) -> str:
    if blocker == ROOM:
        return f"Move {body.name}."
    may_sit = isinstance(body, Person) and plan.bare.blocker(body.pose.xy, body.radius_m) is None
    sit = f", or let {body.name} be seated" if may_sit else ""
    return f"Move {body.name} or {blocker}{sit}."


def _check_apart(scene: Filled) -> None:
    bodies: list[Person | RobotBody] = [*scene.people, scene.robot]
    for one, other in combinations(bodies, 2):
        gap = math.hypot(one.x_m - other.x_m, one.y_m - other.y_m) - one.radius_m - other.radius_m
        if gap < 0.0:
            raise SceneError(
                entity=other.name,
                expected=f"{other.name} and {one.name} in different places",
                got=f"discs that overlap by {-gap:.2f} m",
                remedy=f"Move {other.name} or {one.name}.",
            )
