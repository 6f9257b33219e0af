"""The robot protocol that a behaviour tree needs; the 2D world and real robots implement it.

The protocols are structural: an implementation need not import this module. Units are metres, seconds and
degrees.

The *distance* is between the nearest points of the two bodies, robot and person. The *bearing* is the angle
from the person's heading to the robot's centre, seen from the person's centre, positive to the person's left,
in (-180, 180].
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Protocol

from comity_executor.robots.capabilities import Capabilities
from comity_executor.robots.goals import ActGoal, GoalId, GoalStatus, Motion, MotionGoal, RelativePose
from comity_fis.defuzzification.curve import Curve


class Reading(Protocol):
    """The current sensor reading of one person."""

    @property
    def distance_m(self) -> float:
        """Gap between the nearest points of the two bodies [m]; negative if they overlap."""
        ...

    @property
    def centre_distance_m(self) -> float:
        """Distance between the centres of the two bodies [m]."""
        ...

    @property
    def bearing_deg(self) -> float:
        """Bearing of the robot as seen by the person, in (-180, 180], positive to their left [deg]."""
        ...

    @property
    def facing_error_deg(self) -> float:
        """Angle between the robot's heading and the direction to the person, in [0, 180] [deg]."""
        ...

    @property
    def person_facing_error_deg(self) -> float:
        """Angle between the person's heading and the direction to the robot, in [0, 180] [deg]."""
        ...

    @property
    def speed_m_s(self) -> float:
        """The robot's speed: over the ground or relative to a walking person, whichever is less [m/s]."""
        ...

    @property
    def stamp_s(self) -> float:
        """Time of measurement [s]; may be before `Robot.now_s` if sensors have a delay."""
        ...


def is_seen(reading: Reading) -> bool:
    """Whether a reading is of a person who is currently seen.

    If its sensors do not reach the person from the commanded pose, a robot may instead report its pose
    relative to where the person was last seen, with an attribute `is_seen` that is False. Without the
    attribute all readings count as seen.
    """
    return bool(getattr(reading, "is_seen", True))


class Words(Protocol):
    """An utterance of a person to the robot."""

    @property
    def t(self) -> float:
        """Time of the utterance [s]."""
        ...

    @property
    def text(self) -> str:
        """The words."""
        ...


class Robot(Protocol):
    """A mobile base that sees people, goes to them, speaks and gestures.

    Calls return at once; their progress is queried by identifier. People and acts go by their names in the
    plan.
    """

    @property
    def name(self) -> str:
        """Its name in the plan."""
        ...

    @property
    def capabilities(self) -> Capabilities:
        """Tolerance, latency and dynamics of the base; constant."""
        ...

    def now_s(self) -> float:
        """The world's time, simulated or real; it never runs backwards."""
        ...

    def read(self, person: str) -> Reading | None:
        """The newest reading of a person; None if the person is not seen."""
        ...

    def heard(self, person: str) -> Sequence[Words]:
        """All that a person has said to the robot, in order; called only while the robot attends to them."""
        ...

    def choose_pose(
        self,
        person: str,
        *,
        distance_m: float,
        bearing_deg: float,
        distance_desirability: Curve,
        direction_desirability: Curve,
    ) -> RelativePose | None:
        """Choose a docking pose.

        Args:
            person: The person to stand near.
            distance_m: The target distance between the bodies [m].
            bearing_deg: The target bearing, signed [deg].
            distance_desirability: Desirability of each distance for this person, over metres.
            direction_desirability: Desirability of each direction, over unsigned degrees from the person's
                front, [0, 90].

        Returns:
            The target pose if it is free and reachable, else the most desirable pose that is; None if there
            is none.
        """
        ...

    def go(self, goal: MotionGoal) -> GoalId:
        """Start a goal, replacing the previous one; returns its identifier.

        Replacing a goal is this one call, without a `stop` before it. If two controllers share the base, the
        one for the new goal stays silent until the one for the old has acknowledged its end.

        Docking succeeds within 1 cm and 3 degrees (`Limits`), plus the tolerance that the robot states.
        """
        ...

    def renew(self, goal: GoalId) -> None:
        """Renew the newest motion goal for another `lease_s`, by the base's own clock.

        Only the execution calls this, at the end of every tick that has read the stop and whose tree still
        wants the goal. Without it in time, the base stops by itself and the goal is `aborted`; it is never
        revived. There is no effect on a goal that is over or replaced.
        """
        ...

    def motion(self) -> Motion:
        """Progress of the newest motion goal."""
        ...

    def perform(self, act: ActGoal) -> GoalId:
        """Start to speak, gesture or handle something; returns the act's identifier."""
        ...

    def performance(self, act: GoalId) -> GoalStatus:
        """Progress of an act; an interrupted one is `stopped`, and not done."""
        ...

    def stop(self, goal: GoalId | None = None) -> None:
        """End only this goal or act: a late cancel must not hit the next goal.

        It is acknowledged by the state `stopped`. There is no effect on what is over.

        Args:
            goal: The goal or act; None: stop the base at its full deceleration, whatever its goal.
        """
        ...

    def emergency(self) -> str | bool:
        """Why the robot must stand still and do nothing (a stop button, a bump); False if it need not.

        It is read first in every tick, and stops everything. None, any other value or an exception counts as
        pressed. A stop latches: after this is False again, the robot stands until `Execution.resume`. A
        robot's own stop need not wait for the tree: it may cut the motors at once.
        """
        ...
