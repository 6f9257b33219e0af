"""The environment of an episode: the simulated world, or a real one around a robot."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Protocol

from comity_executor import Robot

if TYPE_CHECKING:
    from comity_sim2d import ActEvent, Door, DoorTurn, Frames, Person, Pose, Scene, Touch
    from comity_sim2d.people.reactions import Shown
    from comity_sim2d.robot.margins import MarginDecision
    from comity_sim2d.senses.active_faults import ActiveFaults


class KnowingRobot(Robot, Protocol):
    """A robot that also reports its belief about the world, from which new plans are made."""

    @property
    def pose(self) -> Pose:
        """Pose of the robot."""
        ...

    @property
    def people(self) -> tuple[Person, ...]:
        """All people at their believed poses."""
        ...

    @property
    def missing(self) -> frozenset[str]:
        """People known not to be at their believed place."""
        ...

    @property
    def walking(self) -> frozenset[str]:
        """People believed to be walking."""
        ...

    def lost(self) -> Mapping[str, str]:
        """Missing people that it no longer searches for, with the reason."""
        ...

    def would_see(self, person: str) -> bool:
        """Whether turning is enough to check a person's believed place."""
        ...

    def has_to_watch(self, person: str) -> bool:
        """Whether it has to face a person to notice that they leave."""
        ...

    def carried(self) -> str | None:
        """The object that it holds."""
        ...

    def learn(self, person: str, *, distance_m: float, speed_m_s: float | None = None) -> None:
        """Store how a person wants it to move near them."""
        ...

    def learn_places(self, places: Mapping[str, Pose]) -> None:
        """Add poses for fetching things."""
        ...


class Environment(Protocol):
    """A place with people and one robot, with records."""

    @property
    def robot(self) -> KnowingRobot:
        """The robot that executes the plan."""
        ...

    @property
    def scene(self) -> Scene:
        """The initial scene."""
        ...

    @property
    def faults(self) -> ActiveFaults:
        """Currently active faults."""
        ...

    @property
    def time_s(self) -> float:
        """Time since the start [s]."""
        ...

    @property
    def doors(self) -> tuple[Door, ...]:
        """Doors in their current state."""
        ...

    @property
    def door_turns(self) -> tuple[DoorTurn, ...]:
        """All openings and shuttings of doors since the start."""
        ...

    @property
    def frames(self) -> Frames:
        """Poses of all entities so far."""
        ...

    def frames_since(self, count: int) -> Frames:
        """The frames without the first `count`."""
        ...

    @property
    def events(self) -> tuple[ActEvent, ...]:
        """Speech and acts of the robot."""
        ...

    @property
    def robot_touches(self) -> tuple[Touch, ...]:
        """The robot's contacts."""
        ...

    @property
    def margin_decisions(self) -> tuple[MarginDecision, ...]:
        """Whether each person who let the robot pass is passed at the reduced margin, in order."""
        ...

    @property
    def shown(self) -> tuple[Shown, ...]:
        """True reactions of people, as far as known."""
        ...
