"""A differential drive: it moves along its heading, forwards or backwards, and turns on the spot."""

from __future__ import annotations

import math

from comity_sim2d.base.base import Base, VelocityCommand
from comity_sim2d.base.drive import BEND_SHARE, SPEED_SHARE, hardest_change, turn_rate
from comity_sim2d.base.smoothing import Smoothing, acceleration_within, window_ticks
from comity_sim2d.pose import Pose, Twist, wrap_angle
from comity_sim2d.scene.robot_body import RobotBody

LOOKAHEAD_M, SOFT_LOOKAHEAD_M = 0.2, 0.1
"""Look-ahead distance of pure pursuit (Coulter 1992, CMU-RI-TR-92-01) [m]: less than the margin of a bend's
arc. With a low jerk limit the shorter one is used, since slow acceleration also makes the base cut its bends
(tuned)."""
SETTLE_M, SETTLE_SIGMAS = 0.004, 0.2
"""Within this distance [m] plus this many standard deviations of the sensor, the base does not turn to get
closer to its goal."""
LEAVES_M, LEAVES_SIGMAS = 0.008, 1.4
"""Same units: distance at which a base at rest moves again. It is less than the centimetre within which a
robot counts as docked, or it would never dock with a person who shifts slightly more. With fewer standard
deviations it would react to noise (our choice, tuned)."""
FOLLOWS_M_S = 0.1
"""A person who shifts more slowly than this [m/s] is faced but not followed until they are too far away."""
TURN_FIRST_RAD = math.radians(35.0)
"""At a larger heading error than this [rad], the base stops and turns on the spot."""
HARD_M_S3, STRAIGHT_SHARE, TURN_SHARE = 6.0, 0.75, 0.5
"""Turning adds up to 3 m/s^3 of jerk, within the limits. If the jerk limit is below `HARD_M_S3`, the base
uses `STRAIGHT_SHARE` of it for its speed, and turns no faster than `TURN_SHARE` of the jerk over its
acceleration (our choice, tuned; the rest is for bends)."""
RESTING_M_S = 1e-6
TURNS_M_S = 0.1
"""At its goal, the base turns to its target heading once slower than this [m/s]: turning earlier, it would
leave its path."""


class Differential:
    """A differential drive within its limits of speed, acceleration and jerk.

    In its own commands `Twist.x_m_s` is the forward speed.
    """

    def __init__(self, body: RobotBody, step_s: float) -> None:
        self._body = body
        self._step_s = step_s
        self._heading_rad = body.heading_rad
        """Heading of the body when the next command takes effect [rad]."""
        is_soft = body.max_jerk_m_s3 < HARD_M_S3
        self._lookahead_m = SOFT_LOOKAHEAD_M if is_soft else LOOKAHEAD_M
        jerk = body.max_jerk_m_s3 * (STRAIGHT_SHARE if is_soft else 1.0)
        self._acceleration_m_s2 = acceleration_within(body.max_acceleration_m_s2, jerk)
        self._fastest_rad_s = TURN_SHARE * jerk / self._acceleration_m_s2 if is_soft else math.inf
        self._smoothing = Smoothing(window_ticks(self._acceleration_m_s2, jerk, step_s))

    def base(self, pose: Pose) -> Base:
        """The state to plan from."""
        self._heading_rad, ahead = pose.heading_rad, self._smoothing.to_come()
        for twist in ahead:
            pose = self._driven(pose, twist)
        forwards = self._smoothing.latest.x_m_s
        return Base(
            pose,
            velocity=(forwards * math.cos(pose.heading_rad), forwards * math.sin(pose.heading_rad)),
            turn_rad_s=self._smoothing.latest.turn_rad_s,
            acceleration_m_s2=self._acceleration_m_s2,
            step_s=self._step_s,
            lag_s=len(ahead) / 2 * self._step_s,
            lookahead_m=self._lookahead_m,
            settle_m=SETTLE_M + SETTLE_SIGMAS * self._body.sensor.sigma_m,
            leaves_m=LEAVES_M + LEAVES_SIGMAS * self._body.sensor.sigma_m,
            follows_m_s=FOLLOWS_M_S,
        )

    def command(self, base: Base, wanted: VelocityCommand, most_m_s: float) -> Twist:
        """The velocity for the coming tick."""
        forwards, turn = self._aim(base, wanted, most_m_s)
        a, dt, now = base.acceleration_m_s2, base.step_s, self._smoothing.latest.x_m_s
        # The turning rate is limited by the present speed, and the speed by the next turning rate.
        tightest = BEND_SHARE * a / max(abs(now), 1e-9)
        tightest = min(tightest, self._fastest_rad_s)
        turning = min(max(turn_rate(base.turn_rad_s, turn, dt), -tightest), tightest)
        bend = BEND_SHARE * a / max(abs(turning), 1e-9)
        forwards = min(max(forwards, -bend), bend)
        # A goal that comes nearer needs more braking than expected: the whole limit on a straight path, the
        # same as for speeding up in the tightest bend, and less than the bend leaves in between.
        left = a - (1.0 - SPEED_SHARE) / BEND_SHARE * abs(now * turning)
        most = dt * (left if (forwards - now) * now < 0.0 else SPEED_SHARE * a)
        change = min(max(forwards - now, -most), most)
        return self._in_world(self._smoothing.take(Twist(now + change, 0.0, turning)))

    def brake(self) -> Twist:
        """Decelerate at the limit, and stop turning."""
        return self._in_world(self._smoothing.brake(*hardest_change(self._body, self._step_s)))

    def brake_before_things(self, base: Base) -> Twist:
        """The same, but keep turning when almost at rest: else it could not turn away from the obstacle."""
        if base.speed_m_s > TURNS_M_S:
            return self.brake()
        slower_m_s, _ = hardest_change(self._body, self._step_s)
        return self._in_world(self._smoothing.brake_straight(slower_m_s))

    def cut(self) -> None:
        """Stop at once."""
        self._smoothing.cut()

    def _aim(self, base: Base, wanted: VelocityCommand, most_m_s: float) -> tuple[float, float]:
        """The forward speed [m/s], and the angle left to turn [rad]."""
        speed = min(math.hypot(*wanted.velocity), most_m_s)
        if speed <= RESTING_M_S:
            if base.speed_m_s > TURNS_M_S:
                return 0.0, 0.0
            return 0.0, wrap_angle(wanted.heading_rad - base.pose.heading_rad)
        off = wrap_angle(math.atan2(wanted.velocity[1], wanted.velocity[0]) - base.pose.heading_rad)
        if wanted.may_reverse and abs(off) > math.pi / 2:
            off, speed = wrap_angle(off + math.pi), -speed
        return (speed * math.cos(off) if abs(off) < TURN_FIRST_RAD else 0.0), off

    def _in_world(self, twist: Twist) -> Twist:
        """The twist in the world frame, along the heading in the middle of the tick."""
        heading = self._heading_rad + twist.turn_rad_s * self._step_s / 2
        return Twist(twist.x_m_s * math.cos(heading), twist.x_m_s * math.sin(heading), twist.turn_rad_s)

    def _driven(self, pose: Pose, twist: Twist) -> Pose:
        """The pose one tick later."""
        middle = pose.heading_rad + twist.turn_rad_s * self._step_s / 2
        return Pose(
            pose.x_m + twist.x_m_s * self._step_s * math.cos(middle),
            pose.y_m + twist.x_m_s * self._step_s * math.sin(middle),
            wrap_angle(pose.heading_rad + twist.turn_rad_s * self._step_s),
        )
