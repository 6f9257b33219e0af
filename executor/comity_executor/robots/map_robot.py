"""The protocol of a robot that is commanded on a map: localisation, tracked people, and a dozen calls.

Such a robot knows neither people's orientations nor docking: it receives poses on the map.
`comity.live.RobotOnMap` combines it with the map to the `Robot` that the tree needs. The protocol is
structural. Units are metres, seconds and radians, in the map frame.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Literal, Protocol

from comity_executor.robots.capabilities import Capabilities
from comity_executor.robots.goals import ActGoal, GoalId, GoalStatus, Motion


@dataclass(frozen=True, slots=True)
class Localisation:
    """The robot's own pose estimate."""

    x_m: float
    y_m: float
    heading_rad: float
    """Heading, counter-clockwise from the x axis [rad]."""
    speed_m_s: float
    """Speed over the ground by odometry, at least 0 [m/s]."""
    stamp_s: float
    """Time of measurement, by the robot's clock [s]."""


@dataclass(frozen=True, slots=True)
class PersonTrack:
    """A person seen by the robot's tracker."""

    track: int | str
    """Identifier in the tracker; it may change later."""
    x_m: float
    y_m: float
    stamp_s: float
    """Time of the observation, by the robot's clock [s]."""
    heading_rad: float | None = None
    """Orientation of the person [rad]; None if the tracker does not know it."""
    velocity_m_s: tuple[float, float] = (0.0, 0.0)
    """Velocity along x and y [m/s]."""
    person: str | None = None
    """Name in the scenario; None if not identified."""
    identified_s: float | None = None
    """Time of the last identification, for example by face [s]; None: never."""


@dataclass(frozen=True, slots=True)
class ReducedPassage:
    """A person who lets the robot pass nearer than 0.30 m at their current position, for one goal."""

    person: str
    """Name as in `PersonTrack.person`."""
    x_m: float
    y_m: float
    margin_m: float
    """Minimum distance between the surfaces of the two bodies [m]."""


@dataclass(frozen=True, slots=True)
class MapGoal:
    """A goal pose for the base on the map."""

    kind: Literal["navigate", "dock", "face", "go_to"]
    """Purpose: travel to a person; come to rest precisely next to them; turn on the spot; go to a place."""
    to: str
    """The person or the place."""
    x_m: float
    y_m: float
    heading_rad: float
    speed_m_s: float
    """Maximum speed [m/s]."""
    parameters: Mapping[str, float | str] = field(default_factory=dict)
    """The person's other parameters, by name, as in a `MotionGoal`."""
    passages: tuple[ReducedPassage, ...] = ()
    """Only for a base with `capabilities.reduced_margin`. It keeps 0.30 m from everybody else, and also from
    these people once a goal without them arrives or they move."""


class MapRobot(Protocol):
    """A robot that finds its own route to poses on a map. Calls return at once.

    Optional calls are made if present: `heard(person)`, as in `Robot`, for a robot that understands speech;
    `sleep(seconds)` for a simulated clock; `carried()` and `floor_is_free(...)`, which
    docs/how-to/connect-a-robot.md describes. An optional attribute `gesture_reach_m` gives the reach of each
    gesture beyond the body [m], by name.
    """

    @property
    def capabilities(self) -> Capabilities:
        """Tolerance, latency and dynamics of the base; constant."""
        ...

    def now_s(self) -> float:
        """The time, real or simulated [s]; it never runs backwards."""
        ...

    def localisation(self) -> Localisation | None:
        """The last known pose; None if it is unknown or lost."""
        ...

    def tracks(self) -> Sequence[PersonTrack] | None:
        """All people whom the tracker sees; None if the tracker gives no data."""
        ...

    def go(self, goal: MapGoal) -> GoalId:
        """Start a goal, replacing the previous one; returns its identifier."""
        ...

    def renew(self, goal: GoalId) -> None:
        """Renew the newest goal for another `lease_s`."""
        ...

    def motion(self) -> Motion:
        """The progress of the newest goal."""
        ...

    def perform(self, act: ActGoal) -> GoalId:
        """Start to speak, gesture or handle something; returns the act's identifier."""
        ...

    def performance(self, act: GoalId) -> GoalStatus:
        """The progress of an act."""
        ...

    def stop(self, goal: GoalId | None = None) -> None:
        """End a goal or act; None: bring the base to rest, whatever its goal is."""
        ...

    def emergency(self) -> str | bool:
        """Why the robot must stand still; False if it need not."""
        ...
