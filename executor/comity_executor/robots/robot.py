"""What a behaviour tree needs of a robot; the 2D world satisfies it, and a real robot can.

The protocols are structural: an implementation need not import this module. Units are metres, seconds and
degrees.

Words: the *distance* is between the nearest points of the two bodies, robot and person. The *bearing* is the
    angle from where the person faces to where the robot's centre stands, seen from the person's centre,
    positive to the person's left, in (-180, 180].
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import inf
from typing import Protocol

from comity_executor.speech.manner import NORMAL, Manner
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
        """The robot's own speed: over the ground, or beside somebody who walks, whichever is less."""
        ...

    @property
    def stamp_s(self) -> float:
        """When it was measured; may lie before `Robot.now_s` where sensors lag."""
        ...


class DockingPose(Protocol):
    """A place to stand near a person, relative to that person, so that it moves along."""

    @property
    def distance_m(self) -> float:
        """Between the nearest points of the two bodies."""
        ...

    @property
    def bearing_deg(self) -> float:
        """In (-180, 180], positive to the person's left."""
        ...

    @property
    def pose_free(self) -> bool:
        """Whether it is the wanted pose."""
        ...

    @property
    def deviation_reason(self) -> str | None:
        """Why it is not the wanted pose; None where it is."""
        ...


@dataclass(frozen=True, slots=True)
class PlannedPose:
    """The wanted pose as the plan has it, before the robot looked whether it is free."""

    distance_m: float
    bearing_deg: float
    pose_free: bool = True
    deviation_reason: str | None = None


class Motion(Protocol):
    """How the last motion command goes."""

    @property
    def state(self) -> str:
        """One of four words; any other makes the leaf fail.

        `idle`: no command, or stopped. After a command a base may say so until it has accepted it
        (`Limits.accept_s`); later it means that the command is lost, and it is given again after a pause.
        `moving`. `arrived`: at the goal; a docked robot stays so while it holds its pose. `blocked`: no
        progress, for the reason in `text`.
        """
        ...

    @property
    def text(self) -> str:
        """A reason for a reader, above all where the motion is blocked; may be empty."""
        ...

    @property
    def blocked_by(self) -> Sequence[str]:
        """The people who are in the way, by name, all who are to be asked; empty where only things are."""
        ...


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

    Commands return at once; one motion command replaces the one before. People and acts go by their names in
    the plan. The pose given to a command may be any `DockingPose`, not only one that `choose_pose` made.
    """

    @property
    def name(self) -> str:
        """Its name in the plan."""
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
    ) -> DockingPose | None:
        """Find the place to stand.

        Args:
            person: Whom to stand near.
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

    def navigate(self, person: str, pose: DockingPose, *, speed_m_s: float, detour_m: float = inf) -> None:
        """Go along the shortest route until close to the pose; `motion` then says `arrived`.

        Args:
            person: Whom to go to.
            pose: Where to stand near them.
            speed_m_s: On the way.
            detour_m: How much farther the way around people may be than it would be without them. Where it
                is more, or there is none, the robot comes up to those in the way and is `blocked_by` them,
                until they make way.
        """
        ...

    def dock(self, person: str, pose: DockingPose, *, speed_m_s: float) -> None:
        """Move finely onto the pose and hold it, following the person, until another command.

        Docking counts as done within 1 cm and 3 degrees (`Limits`): the controller must come closer than
        that.
        """
        ...

    def face(self, person: str) -> None:
        """Turn on the spot towards a person."""
        ...

    def motion(self) -> Motion:
        """How the last motion command goes."""
        ...

    def stop(self) -> None:
        """Come to rest as fast as the base decelerates, and drop the motion command."""
        ...

    def emergency(self) -> str | bool:
        """Why the robot must stand still and do nothing: a stop button, a bump; False while it need not.

        The tree reads it first in every tick and stops all that runs. It goes on when this is False again:
        None, any other value or an exception counts as pressed. A robot's own stop need not wait for the
        tree: it may cut the motors at once.
        """
        ...

    def start_act(self, act: str, person: str, text: str | None = None, *, manner: Manner = NORMAL) -> None:
        """Begin an act towards a person: `utter` or `ask_to_pass` with its text, or a gesture by its name.

        Args:
            act: What to do.
            person: Towards whom.
            text: What to say.
            manner: How loud and how fast to speak, how large to gesture.
        """
        ...

    def act_done(self, act: str, person: str) -> bool | None:
        """Whether an act is over; False while it runs, None if it never started or was broken off."""
        ...

    def stop_act(self, act: str, person: str) -> None:
        """Break an act off; nothing happens if it does not run."""
        ...
