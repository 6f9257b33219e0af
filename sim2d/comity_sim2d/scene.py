"""A scene: a room, what and who stands in it, and the robot at its start. Frozen, and checked when built."""

from __future__ import annotations

import math
import re
from collections.abc import Container, Iterable
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Literal, get_args

from comity_sim2d.area import Area, Location
from comity_sim2d.comfort import Comfort
from comity_sim2d.door import Door
from comity_sim2d.group import Group, check_groups
from comity_sim2d.kinds import TRUTH, require_kinds
from comity_sim2d.o_space import OSpace, o_space_of_those_left
from comity_sim2d.pose import XY, Pose
from comity_sim2d.robot_reaction import SEEN_M, RobotReaction, require_reaction
from comity_sim2d.scene_error import (
    FARTHEST_M,
    SceneError,
    require_between,
    require_finite,
    require_one_of,
    require_points,
    require_text,
    require_tuple,
    unknown,
)
from comity_sim2d.walk import Walk

if TYPE_CHECKING:
    from comity_sim2d.obstacles import Segments
    from comity_sim2d.passers_by import PassersBy

Side = Literal["right", "left"]
SIDES: tuple[Side, ...] = get_args(Side)
POSTURES = ("standing", "seated")
DRIVES = ("omnidirectional", "differential")
ROBOT_RADIUS_M, PERSON_RADIUS_M = 0.25, 0.20
"""Of the discs, unless they say otherwise: a robot like Pepper (0.48 m across), a grown-up's shoulders."""
SIGHT_M = 0.50
"""So far from its body a robot sees at least: where people talk with it (our choice)."""
CIRCLE_CORNERS = 24
"""Of round furniture, which is up to 0.9 % wider than written (our choice)."""


@dataclass(frozen=True, slots=True)
class Room:
    """The floor that can be walked on, as a polygon; its outline is a wall."""

    corners: tuple[XY, ...]
    """In order, either way round, the first not repeated [m]."""
    holes: tuple[tuple[XY, ...], ...] = ()
    """What is no floor inside it, such as a courtyard: the corners of each, none of them outside."""

    def __post_init__(self) -> None:
        require_tuple("room", "holes", self.holes, tuple, "outlines, each of points `(x, y)`")
        _require_corners("room", self.corners)
        for hole in self.holes:
            _require_corners("room", hole, "holes")

    @property
    def outlines(self) -> tuple[tuple[XY, ...], ...]:
        """The outer one, then that of every hole."""
        return (self.corners, *self.holes)

    @classmethod
    def rectangle(cls, width_m: float, height_m: float) -> Room:
        """A room with one corner at the origin: `width_m` along x, `height_m` along y."""
        require_between("room", "width_m", width_m, 0.01, 1000.0)
        require_between("room", "height_m", height_m, 0.01, 1000.0)
        return cls(((0.0, 0.0), (width_m, 0.0), (width_m, height_m), (0.0, height_m)))


@dataclass(frozen=True, slots=True)
class Wall:
    """An inner wall: a straight line with a thickness and round ends."""

    start: XY
    end: XY
    thickness_m: float = 0.10
    name: str = ""
    """Only for messages and pictures; without one it is called by its number in the scene."""

    def __post_init__(self) -> None:
        require_kinds("wall", name=(self.name, str))
        entity = self.name or "wall"
        require_points(entity, "start", (self.start,))
        require_points(entity, "end", (self.end,))
        require_between(entity, "thickness_m", self.thickness_m, 0.001, 10.0)
        if self.start == self.end:
            raise SceneError(
                entity=entity,
                expected="a wall between two different points",
                got=f"{self.start} twice",
                remedy="Give the wall a length, or use furniture for a pillar.",
            )


@dataclass(frozen=True, slots=True)
class Furniture:
    """Something to go around: a simple polygon with a name."""

    name: str
    corners: tuple[XY, ...]
    """In order, either way round, the first not repeated [m]."""

    def __post_init__(self) -> None:
        require_text("furniture", "name", self.name)
        _require_corners(self.name, self.corners)

    @property
    def called(self) -> str:
        """What a sentence calls it: `the low table`, a kind of thing; `t1` and `Billy`, names of their own.

        Plain words in small letters are taken for a kind of thing (our choice).
        """
        is_a_kind = re.fullmatch(r"(?!(?:the|an?) )[a-z]+(?:[ -][a-z]+)*", self.name) is not None
        return f"the {self.name}" if is_a_kind else self.name

    @classmethod
    def box(
        cls, name: str, x_m: float, y_m: float, *, width_m: float, depth_m: float, angle_rad: float = 0.0
    ) -> Furniture:
        """A rectangle by its middle: `width_m` along x and `depth_m` along y, then turned by `angle_rad`."""
        require_text("furniture", "name", name)
        require_finite(name, x_m=x_m, y_m=y_m, angle_rad=angle_rad)
        require_between(name, "width_m", width_m, 0.01, 1000.0)
        require_between(name, "depth_m", depth_m, 0.01, 1000.0)
        c, s = math.cos(angle_rad), math.sin(angle_rad)
        half = [(sx * width_m / 2, sy * depth_m / 2) for sx, sy in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
        return cls(name, tuple((x_m + c * u - s * v, y_m + s * u + c * v) for u, v in half))

    @classmethod
    def circle(cls, name: str, x_m: float, y_m: float, *, radius_m: float) -> Furniture:
        """A disc by its middle, as the regular polygon of `CIRCLE_CORNERS` corners around it."""
        require_text("furniture", "name", name)
        require_finite(name, x_m=x_m, y_m=y_m)
        require_between(name, "radius_m", radius_m, 0.01, 500.0)
        reach, step = radius_m / math.cos(math.pi / CIRCLE_CORNERS), math.tau / CIRCLE_CORNERS
        angles = [k * step for k in range(CIRCLE_CORNERS)]
        return cls(name, tuple((x_m + reach * math.cos(a), y_m + reach * math.sin(a)) for a in angles))


@dataclass(frozen=True, slots=True)
class Person:
    """Someone in the room, as a disc that faces somewhere."""

    name: str
    x_m: float
    y_m: float
    heading_rad: float
    radius_m: float = PERSON_RADIUS_M
    posture: str = "standing"
    """One of `POSTURES`; a seated person's disc stands for the chair as well."""
    personal_distance_m: float | None = None
    """How far a passing robot should stay, between surfaces, where a way exists; None: the default."""
    comfort: Comfort | None = None
    """What the person likes and shows, hidden from the robot; None: they do not react."""
    walk: Walk | None = None
    """Where the person walks; None: they stay where they are."""
    reacts: RobotReaction | None = None
    """What the person does about the robot as such; None: who walks takes it for another person."""

    def __post_init__(self) -> None:
        require_text("people", "name", self.name)
        require_finite(self.name, x_m=self.x_m, y_m=self.y_m, heading_rad=self.heading_rad)
        require_between(self.name, "radius_m", self.radius_m, 0.05, 2.0)
        if self.personal_distance_m is not None:
            require_between(self.name, "personal_distance_m", self.personal_distance_m, 0.0, 10.0)
        require_one_of(self.name, "posture", self.posture, POSTURES)
        if self.comfort is not None:
            require_kinds(self.name, comfort=(self.comfort, Comfort | None))
        if self.walk is not None:
            require_kinds(self.name, walk=(self.walk, Walk | None))
        if self.reacts is not None:
            require_reaction(self.name, self.reacts)
        if self.posture != "standing" and self.may_move:
            raise SceneError(
                entity=self.name,
                field="walk" if self.walk else "reacts",
                expected="somebody who stands, to walk or to go up to a robot or away from it",
                got=f"somebody {self.posture}",
                remedy="Leave it out, or let them stand.",
            )

    @property
    def may_move(self) -> bool:
        """Whether the person walks, or does so because of the robot's mere presence."""
        return self.walk is not None or self.reacts in SEEN_M

    @property
    def xy(self) -> XY:
        """Where the person stands."""
        return (self.x_m, self.y_m)

    @property
    def pose(self) -> Pose:
        """Where the person stands and faces."""
        return Pose(self.x_m, self.y_m, self.heading_rad)


@dataclass(frozen=True, slots=True)
class Sensor:
    """How the robot's knowledge of where people stand differs from the truth; by default it does not."""

    sigma_m: float = 0.0
    """Standard deviation of Gaussian noise on each coordinate of a person's place."""
    delay_s: float = 0.0
    """Age of what is known."""
    range_m: float = FARTHEST_M
    """People are seen up to here, from the robot's centre to their bodies."""
    field_of_view_deg: float = 360.0
    """About the robot's heading, half of it to either side."""
    hidden_by_walls: bool = False
    """Whether a wall hides who is behind it."""

    def __post_init__(self) -> None:
        require_between("sensor", "sigma_m", self.sigma_m, 0.0, 1.0)
        require_between("sensor", "delay_s", self.delay_s, 0.0, 2.0)
        require_between("sensor", "range_m", self.range_m, 0.1, FARTHEST_M)
        require_between("sensor", "field_of_view_deg", self.field_of_view_deg, 5.0, 360.0)
        require_kinds("sensor", hidden_by_walls=(self.hidden_by_walls, TRUTH))


@dataclass(frozen=True, slots=True)
class RobotBody:
    """The robot where it starts: a disc that drives in one way or the other, with limits."""

    x_m: float
    y_m: float
    heading_rad: float = 0.0
    name: str = "robot"
    radius_m: float = ROBOT_RADIUS_M
    max_speed_m_s: float = 0.7
    max_acceleration_m_s2: float = 0.5
    """For speeding up, slowing down and changing direction alike."""
    max_jerk_m_s3: float = 20.0
    """How fast the acceleration may change; at 20 Hz and 0.5 m/s^2 the commands alone keep the default.

    Below `max_acceleration_m_s2` a second, the robot accelerates less than it may, by so much in a second.
    """
    emergency_deceleration_m_s2: float = 2.0
    """How hard it brakes while its emergency stop is pressed, whatever the jerk.

    Our choice, below where a body tips whose centre of mass stands 0.6 m above wheels that reach 0.15 m out
    (9.81 * 0.15 / 0.6 = 2.5). It never brakes more softly than by `max_acceleration_m_s2`.
    """
    drive: str = "omnidirectional"
    """One of `DRIVES`."""
    sensor: Sensor = field(default_factory=Sensor)

    def __post_init__(self) -> None:
        require_text("robot", "name", self.name)
        require_finite(self.name, x_m=self.x_m, y_m=self.y_m, heading_rad=self.heading_rad)
        require_between(self.name, "radius_m", self.radius_m, 0.05, 2.0)
        require_between(self.name, "max_speed_m_s", self.max_speed_m_s, 0.01, 3.0)
        require_between(self.name, "max_acceleration_m_s2", self.max_acceleration_m_s2, 0.05, 10.0)
        require_between(self.name, "max_jerk_m_s3", self.max_jerk_m_s3, 0.1, 1000.0)
        hardest = ("emergency_deceleration_m_s2", self.emergency_deceleration_m_s2)
        require_between(self.name, *hardest, 0.05, 100.0)
        require_one_of(self.name, "drive", self.drive, DRIVES)
        require_kinds(self.name, sensor=(self.sensor, Sensor))
        if self.sensor.range_m < self.radius_m + SIGHT_M:
            raise SceneError(
                entity="sensor",
                field="range_m",
                expected=f"at least {self.radius_m + SIGHT_M:g} m, which is {SIGHT_M:g} m more than the "
                "robot's radius: it counts from the robot's centre",
                got=f"{self.sensor.range_m:g}",
                remedy="Let it see farther.",
            )

    @property
    def pose(self) -> Pose:
        """Where the robot starts."""
        return Pose(self.x_m, self.y_m, self.heading_rad)


@dataclass(frozen=True, slots=True)
class Scene:
    """Everything a world starts from.

    Raises:
        SceneError: Where something cannot stand where it is put; its `entity` says what.
    """

    room: Room
    robot: RobotBody
    people: tuple[Person, ...] = ()
    walls: tuple[Wall, ...] = ()
    furniture: tuple[Furniture, ...] = ()
    groups: tuple[Group, ...] = ()
    """Who stands together."""
    passers_by: PassersBy | None = None
    """Who walks about besides."""
    keep_to: Side = "right"
    """The side on which people who walk evade one another where both are as good."""
    doors: tuple[Door, ...] = ()
    """As they are at the start, each in a gap of the walls."""
    areas: tuple[Area, ...] = ()
    """Named parts of the floor; nothing stands there because of them."""
    locations: tuple[Location, ...] = ()
    """Named points."""

    def __post_init__(self) -> None:
        from comity_sim2d.passers_by import PassersBy
        from comity_sim2d.scene_check import check_scene

        require_kinds("scene", room=(self.room, Room), robot=(self.robot, RobotBody))
        require_kinds("scene", passers_by=(self.passers_by, PassersBy | None))
        for name, kind, what in (
            ("people", Person, "people"),
            ("walls", Wall, "walls"),
            ("furniture", Furniture, "furniture"),
            ("groups", Group, "groups"),
            ("doors", Door, "doors"),
            ("areas", Area, "areas"),
            ("locations", Location, "locations"),
        ):
            require_tuple("scene", name, getattr(self, name), kind, what)
        require_one_of("scene", "keep_to", self.keep_to, SIDES)
        check_groups(self.groups, self.people)
        check_scene(self)

    def segments(self) -> Segments:
        """All that stands still, as straight lines in arrays."""
        from comity_sim2d.obstacles import floor_plan

        return floor_plan(self).segments

    def without(self, names: Container[str]) -> Scene:
        """The same with some people gone: their groups shrink, and one of whom nobody or one is left ends."""
        groups = (group.without(names) for group in self.groups)
        return replace(
            self,
            people=tuple(person for person in self.people if person.name not in names),
            groups=tuple(group for group in groups if group is not None),
        )

    @property
    def o_spaces(self) -> tuple[OSpace, ...]:
        """What the groups keep open between them at the start, in their order."""
        return tuple(group.o_space(self.people) for group in self.groups)

    def o_spaces_among(self, people: Iterable[Person]) -> tuple[OSpace, ...]:
        """What is left of them with people elsewhere: of those who have not left their group."""
        there = tuple(people)
        left = (o_space_of_those_left(group.those_of(self.people), there) for group in self.groups)
        return tuple(space for space in left if space is not None)

    def person(self, name: str) -> Person:
        """The person of that name.

        Raises:
            ValueError: Where there is none.
        """
        return find_person(self.people, name)


def find_person(people: tuple[Person, ...], name: str) -> Person:
    """The person of that name.

    Raises:
        ValueError: Where there is none.
    """
    if isinstance(name, str):
        for person in people:
            if person.name == name:
                return person
    raise unknown("a person of the scene", name, [person.name for person in people])


def _require_corners(entity: str, corners: tuple[XY, ...], field: str = "corners") -> None:
    require_points(entity, field, corners)
    if len(set(corners)) < 3:
        raise SceneError(
            entity=entity,
            field=field,
            expected="at least three different corners" + (" of each hole" if field == "holes" else ""),
            got=f"{len(set(corners))}",
            remedy="List the corners in order along the outline.",
        )
