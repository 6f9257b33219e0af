"""What a behaviour tree needs of a robot; the 2D world satisfies it, and a real robot can.

The protocols are structural: an implementation need not import this module. Units are metres, seconds and
degrees.

Words: the *distance* is between the nearest points of the two bodies, robot and person. The *bearing* is the
    angle from where the person faces to where the robot's centre stands, seen from the person's centre,
    positive to the person's left, in (-180, 180].
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Protocol

from comity_executor.robots.capabilities import Capabilities
from comity_executor.robots.goals import ActGoal, GoalId, GoalStatus, Motion, MotionGoal, RelativePose
from comity_fis.defuzzification.curve import Curve


class Reading(Protocol):
    """What the robot knows about one person now, from its sensors."""

    @property
    def distance_m(self) -> float:
        """Between the nearest points of the two bodies; negative where they overlap."""
        ...

    @property
    def centre_distance_m(self) -> float:
        """Between the centres of the two bodies."""
        ...

    @property
    def bearing_deg(self) -> float:
        """Where the robot stands as the person sees it, in (-180, 180], positive to the person's left."""
        ...

    @property
    def facing_error_deg(self) -> float:
        """Between the robot's heading and the direction to the person, in [0, 180]."""
        ...

    @property
    def person_facing_error_deg(self) -> float:
        """Between the person's heading and the direction to the robot, in [0, 180]: the unsigned bearing."""
        ...

    @property
    def speed_m_s(self) -> float:
        """The robot's own speed: over the ground, or beside a person who walks, whichever is less."""
        ...

    @property
    def stamp_s(self) -> float:
        """When it was measured; may lie before `Robot.now_s` where sensors lag."""
        ...


def is_seen(reading: Reading) -> bool:
    """Whether a reading is of a person who is seen.

    A robot whose sensors are too short for the pose that it was told to take may read instead how it stands
    to where the person was last seen, with an attribute `is_seen` that is False; without it all readings are
    seen.
    """
    return bool(getattr(reading, "is_seen", True))


class Words(Protocol):
    """Something that a person said to the robot."""

    @property
    def t(self) -> float:
        """When it was said."""
        ...

    @property
    def text(self) -> str:
        """The words."""
        ...


class Robot(Protocol):
    """A mobile base that sees people, goes to them, speaks and gestures.

    Calls return at once; what they began is asked for by its id. People and acts go by their names in the
    plan.
    """

    @property
    def name(self) -> str:
        """Its name in the plan."""
        ...

    @property
    def capabilities(self) -> Capabilities:
        """How exactly, how late and how fast the base does what it is told; the same all the while."""
        ...

    def now_s(self) -> float:
        """The world's time, simulated or real; it never runs backwards."""
        ...

    def read(self, person: str) -> Reading | None:
        """The newest reading of a person; None where the person is not seen."""
        ...

    def heard(self, person: str) -> Sequence[Words]:
        """All that a person has said to the robot, in order; asked for only while it attends to them."""
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
        """Find the place to stand.

        Args:
            person: The person to stand near.
            distance_m: The wanted distance between the bodies.
            bearing_deg: The wanted bearing, signed.
            distance_desirability: How suitable each distance is for this person, over metres.
            direction_desirability: How suitable each direction is, over unsigned degrees from the person's
                front, [0, 90].

        Returns:
            The wanted pose if it is free and reachable, else the free and reachable one of highest
            desirability; None where there is none.
        """
        ...

    def go(self, goal: MotionGoal) -> GoalId:
        """Set out for a goal, which replaces the one before, and say what it is called.

        A handover is this one call: no `stop` comes before it. Where two controllers share the base, the one
        for the new goal is silent until the one for the old has acknowledged its end.

        Docking counts as done within 1 cm and 3 degrees (`Limits`), and the tolerance that the robot states.
        """
        ...

    def renew(self, goal: GoalId) -> None:
        """Go on with the newest motion goal for `lease_s` more, by the base's own clock.

        The execution says so at the end of every tick that has read the stop and whose tree wants the goal
        still, and nothing else does. Where it does not come in time, the base stops by itself and the goal is
        `aborted`; it is never revived. Nothing happens to a goal that is over or replaced.
        """
        ...

    def motion(self) -> Motion:
        """How the newest motion goal goes."""
        ...

    def perform(self, act: ActGoal) -> GoalId:
        """Begin to speak, to gesture or to handle something, and say what the act is called."""
        ...

    def performance(self, act: GoalId) -> GoalStatus:
        """How an act goes; one that was broken off is `stopped`, and not done."""
        ...

    def stop(self, goal: GoalId | None = None) -> None:
        """End one goal or act, and only that: a cancel that comes late must not hit the goal after it.

        It is acknowledged by the state `stopped`. Nothing happens to what is over.

        Args:
            goal: Which; None: bring the base to rest as fast as it decelerates, whatever its goal is.
        """
        ...

    def emergency(self) -> str | bool:
        """Why the robot must stand still and do nothing: a stop button, a bump; False while it need not.

        It is read first in every tick, and stops all that runs. None, any other value or an exception counts
        as pressed. A stop latches: when this is False again, the robot stands until `Execution.resume`. A
        robot's own stop need not wait for the tree: it may cut the motors at once.
        """
        ...
