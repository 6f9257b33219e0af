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
    """A robot of which can also be asked what it takes the world for: a new plan is made from that."""

    @property
    def pose(self) -> Pose:
        """Where it is."""
        ...

    @property
    def people(self) -> tuple[Person, ...]:
        """All people where it believes them to be."""
        ...

    @property
    def missing(self) -> frozenset[str]:
        """Who is known not to be where they were believed to be."""
        ...

    @property
    def walking(self) -> frozenset[str]:
        """Who is believed to be going somewhere."""
        ...

    def lost(self) -> Mapping[str, str]:
        """Of the missing, those for whom it looks no more, and why."""
        ...

    def would_see(self, person: str) -> bool:
        """Whether it need only turn to see whether a person is where it believes them."""
        ...

    def has_to_watch(self, person: str) -> bool:
        """Whether it has to face a person to notice that they go."""
        ...

    def carried(self) -> str | None:
        """What it holds."""
        ...

    def learn(self, person: str, *, distance_m: float, speed_m_s: float | None = None) -> None:
        """Know from now on how a person wants it to move near them."""
        ...

    def learn_places(self, places: Mapping[str, Pose]) -> None:
        """Know where to stand to fetch things."""
        ...


class Environment(Protocol):
    """A place with people and one robot, of which records are kept."""

    @property
    def robot(self) -> KnowingRobot:
        """Who carries the plan out."""
        ...

    @property
    def scene(self) -> Scene:
        """As it was at the start."""
        ...

    @property
    def faults(self) -> ActiveFaults:
        """What is wrong on purpose now."""
        ...

    @property
    def time_s(self) -> float:
        """Since the start."""
        ...

    @property
    def doors(self) -> tuple[Door, ...]:
        """As they are now."""
        ...

    @property
    def door_turns(self) -> tuple[DoorTurn, ...]:
        """Every door that was opened or shut since the start."""
        ...

    @property
    def frames(self) -> Frames:
        """Where everybody was so far."""
        ...

    def frames_since(self, count: int) -> Frames:
        """The same without the first `count` frames."""
        ...

    @property
    def events(self) -> tuple[ActEvent, ...]:
        """What the robot said and did."""
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
        """What people truly showed, as far as that is known."""
        ...
