"""The base of a robot: its velocity commands, and the state it reaches once they are carried out."""

from __future__ import annotations

import math
from typing import NamedTuple, Protocol

from comity_sim2d.pose import XY, Pose, Twist


class Base(NamedTuple):
    """The state of the base after all commands so far, the last command, and its limits."""

    pose: Pose
    velocity: XY
    turn_rad_s: float
    acceleration_m_s2: float
    step_s: float
    lag_s: float
    """Lag of the body behind this state [s]."""
    lookahead_m: float = 0.0
    """Look-ahead distance on the route of a base that cannot move sideways [m]."""
    settle_m: float = 0.0
    """Distance to the goal at which such a base stops and turns to its target heading [m]."""
    leaves_m: float = 0.0
    """Distance to the goal, ahead or behind, at which a base that has stopped moves again [m]."""
    follows_m_s: float = 0.0
    """A goal that moves more slowly than this is not followed until it is `leaves_m` away [m/s]."""

    @property
    def xy(self) -> XY:
        """Position [m]."""
        x_m, y_m, _ = self.pose
        return (x_m, y_m)

    @property
    def speed_m_s(self) -> float:
        """Speed over the ground [m/s]."""
        return math.hypot(*self.velocity)

    def cutting_m_s2(self, cut_m: float) -> float:
        """Lateral acceleration at which the body cuts its commanded path by this distance [m/s^2].

        The body drives the mean of n commands, (n - 1) / 2 ticks later. On a bend with acceleration a, the
        mean of the positions lies a (n^2 - 1) dt^2 / 24 inside the path; less if the acceleration changes
        meanwhile.
        """
        return math.inf if self.lag_s <= 0.0 else 6.0 * cut_m / (self.lag_s * (self.lag_s + self.step_s))

    @property
    def turns_to_go(self) -> bool:
        """Whether the base cannot move sideways, and turns to its direction of travel first."""
        return self.lookahead_m > 0.0


class VelocityCommand(NamedTuple):
    """The target velocity and heading of the base, before its limits."""

    velocity: XY
    heading_rad: float
    """Target heading [rad]; a base that cannot move sideways faces its direction of travel while it moves."""
    may_reverse: bool = False
    """Whether the goal is so near that driving backwards is better than turning round."""


class BaseControl(Protocol):
    """Carries out velocity commands within the limits of one kind of base."""

    def base(self, pose: Pose) -> Base:
        """The state to plan from, for a body at this pose when the next command takes effect."""
        ...

    def command(self, base: Base, wanted: VelocityCommand, most_m_s: float) -> Twist:
        """The velocity of the body for the coming tick, in the world frame, at most `most_m_s`."""
        ...

    def brake(self) -> Twist:
        """The velocity for the coming tick under an emergency stop: full deceleration."""
        ...

    def brake_before_things(self, base: Base) -> Twist:
        """The same before an obstacle.

        Args:
            base: Current motion of the body.
        """
        ...

    def cut(self) -> None:
        """Stop at once, ignoring all limits: the robot touched something."""
        ...
