"""What Comity needs of a robot that it drives on a map: where it is, which people it sees, and a dozen calls.

Such a robot knows no persons' fronts and no docking: it is told poses of the map. `Robot`, which the tree
needs, is made of it and of the map (`comity.live.RobotOnMap`). The protocol is structural. Units are metres,
seconds and radians, in the frame of the map.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Literal, Protocol

from comity_executor.robots.capabilities import Capabilities
from comity_executor.robots.goals import ActGoal, GoalId, GoalStatus, Motion


@dataclass(frozen=True, slots=True)
class Localisation:
    """Where the robot is, by its own estimate."""

    x_m: float
    y_m: float
    heading_rad: float
    """Counter-clockwise from the x axis."""
    speed_m_s: float
    """Over the ground, as its odometry says; 0 or more."""
    stamp_s: float
    """When it was measured, by the robot's clock."""


@dataclass(frozen=True, slots=True)
class PersonTrack:
    """A person whom the robot's tracker sees."""

    track: int | str
    """What the tracker calls them; it may be another name later."""
    x_m: float
    y_m: float
    stamp_s: float
    """When they were seen there, by the robot's clock."""
    heading_rad: float | None = None
    """Which way they face; None where the tracker does not know."""
    velocity_m_s: tuple[float, float] = (0.0, 0.0)
    """Along x and y."""
    person: str | None = None
    """Who it is, by their name in the scenario; None where that is not known."""
    identified_s: float | None = None
    """When the robot last made sure who it is, such as by their face; None: never."""


@dataclass(frozen=True, slots=True)
class ReducedPassage:
    """A person who lets the robot pass nearer than 0.30 m, where they stand now, on the way to one goal."""

    person: str
    """As in `PersonTrack.person`."""
    x_m: float
    y_m: float
    margin_m: float
    """Between the surfaces of the two bodies, at least."""


@dataclass(frozen=True, slots=True)
class MapGoal:
    """A pose of the map that the base is to take."""

    kind: Literal["navigate", "dock", "face", "go_to"]
    """Why: to travel to a person; to come to rest before them exactly; to turn on the spot; to a place."""
    to: str
    """The person or the place."""
    x_m: float
    y_m: float
    heading_rad: float
    speed_m_s: float
    """At most."""
    parameters: Mapping[str, float | str] = field(default_factory=dict)
    """The person's other parameters, by name, as in a `MotionGoal`."""
    passages: tuple[ReducedPassage, ...] = ()
    """Only for a base with `capabilities.reduced_margin`. It keeps 0.30 m from everybody else, and from
    these, too, once a goal without them comes, or they move."""


class MapRobot(Protocol):
    """A robot that finds its way to poses of a map by itself. Calls return at once.

    More calls are made where they are there: `heard(person)`, as of `Robot`, of a robot that understands
    what people say to it; `sleep(seconds)` of one whose clock is simulated, to let time pass; `carried()` and
    `floor_is_free(...)`, which docs/how-to/connect-a-robot.md describes.
    An attribute `gesture_reach_m` is read where it is there: how far beyond the body each gesture reaches
    [m], by name.
    """

    @property
    def capabilities(self) -> Capabilities:
        """How exactly, how late and how fast the base does what it is told; the same all the while."""
        ...

    def now_s(self) -> float:
        """The time, real or simulated; it never runs backwards."""
        ...

    def localisation(self) -> Localisation | None:
        """Where the robot is, as it last knew; None where it never did or has lost its place."""
        ...

    def tracks(self) -> Sequence[PersonTrack] | None:
        """All people whom the tracker sees; None where the tracker itself is silent."""
        ...

    def go(self, goal: MapGoal) -> GoalId:
        """Set out for a pose, in place of the goal before; says what the goal is called."""
        ...

    def renew(self, goal: GoalId) -> None:
        """Go on with the newest goal for `lease_s` more."""
        ...

    def motion(self) -> Motion:
        """How the newest goal goes."""
        ...

    def perform(self, act: ActGoal) -> GoalId:
        """Begin to speak, to gesture or to handle something; says what the act is called."""
        ...

    def performance(self, act: GoalId) -> GoalStatus:
        """How an act goes."""
        ...

    def stop(self, goal: GoalId | None = None) -> None:
        """End one goal or act; without one, bring the base to rest whatever its goal is."""
        ...

    def emergency(self) -> str | bool:
        """Why the robot must stand still; False while it need not."""
        ...
