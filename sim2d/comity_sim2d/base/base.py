"""The base of a robot: what it is told, and where it will be when it has done what it was told."""

from __future__ import annotations

import math
from typing import NamedTuple, Protocol

from comity_sim2d.pose import XY, Pose, Twist


class Base(NamedTuple):
    """Where the base comes to be of what it was told so far, what it was told last, and its limits."""

    pose: Pose
    velocity: XY
    turn_rad_s: float
    acceleration_m_s2: float
    step_s: float
    lag_s: float
    """Of the body behind this, between its wheels and its commands."""
    lookahead_m: float = 0.0
    """Where the base cannot move sideways, it aims so far ahead on its route."""
    settle_m: float = 0.0
    """So near its goal such a base is content, and turns to where it is to look."""
    leaves_m: float = 0.0
    """Content, it moves again when its goal is so far away, ahead or behind."""
    follows_m_s: float = 0.0
    """A goal that moves more slowly is not followed until it is too far away."""

    @property
    def xy(self) -> XY:
        """The place alone."""
        x_m, y_m, _ = self.pose
        return (x_m, y_m)

    @property
    def speed_m_s(self) -> float:
        """Over the ground."""
        return math.hypot(*self.velocity)

    def cutting_m_s2(self, cut_m: float) -> float:
        """The acceleration to the side with which the body comes so far inside the way of its commands.

        It drives the mean of n of them, (n - 1) / 2 ticks later: of places on a bend with acceleration a, the
        mean is inside by a (n^2 - 1) dt^2 / 24. Where acceleration changes meanwhile, it is by less.
        """
        return math.inf if self.lag_s <= 0.0 else 6.0 * cut_m / (self.lag_s * (self.lag_s + self.step_s))

    @property
    def turns_to_go(self) -> bool:
        """Whether it cannot move sideways."""
        return self.lookahead_m > 0.0


class VelocityCommand(NamedTuple):
    """What the base should do next, before its limits."""

    velocity: XY
    heading_rad: float
    """Where to look; a base that cannot move sideways looks where it goes while it moves."""
    may_reverse: bool = False
    """Whether the goal is so near that driving backwards is better than turning round."""


class BaseControl(Protocol):
    """Carries out what is wanted, as one kind of base can."""

    def base(self, pose: Pose) -> Base:
        """The state to decide from, with the body at a pose when the next command takes effect."""
        ...

    def command(self, base: Base, wanted: VelocityCommand, most_m_s: float) -> Twist:
        """The velocity of the body for the coming tick, in the world's frame; at most so fast."""
        ...

    def brake(self) -> Twist:
        """The velocity for the coming tick where the emergency stop is pressed: as hard as the body may."""
        ...

    def brake_before_things(self, base: Base) -> Twist:
        """The same where something is in the way.

        Args:
            base: How the body moves now.
        """
        ...

    def cut(self) -> None:
        """Stand still at once, beyond all limits: something was touched."""
        ...
