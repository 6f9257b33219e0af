"""An omnidirectional base: it moves in any direction while turning, as Pepper does."""

from __future__ import annotations

from comity_sim2d.base.base import Base, VelocityCommand
from comity_sim2d.base.drive import hardest_change, limit_change, limit_speed, turn_rate
from comity_sim2d.base.smoothing import Smoothing, acceleration_within, window_ticks
from comity_sim2d.pose import Pose, Twist, wrap_angle
from comity_sim2d.scene.robot_body import RobotBody


class Omnidirectional:
    """An omnidirectional base within its limits of speed, acceleration and jerk."""

    def __init__(self, body: RobotBody, step_s: float) -> None:
        self._body = body
        self._step_s = step_s
        self._acceleration_m_s2 = acceleration_within(body.max_acceleration_m_s2, body.max_jerk_m_s3)
        self._smoothing = Smoothing(window_ticks(self._acceleration_m_s2, body.max_jerk_m_s3, step_s))

    def base(self, pose: Pose) -> Base:
        """The state to plan from."""
        ahead, latest, dt = self._smoothing.sum_to_come(), self._smoothing.latest, self._step_s
        return Base(
            Pose(
                pose.x_m + dt * ahead.x_m_s,
                pose.y_m + dt * ahead.y_m_s,
                wrap_angle(pose.heading_rad + dt * ahead.turn_rad_s),
            ),
            velocity=latest.xy,
            turn_rad_s=latest.turn_rad_s,
            acceleration_m_s2=self._acceleration_m_s2,
            step_s=dt,
            lag_s=(self._smoothing.ticks - 1) / 2 * dt,
        )

    def command(self, base: Base, wanted: VelocityCommand, most_m_s: float) -> Twist:
        """The velocity for the coming tick."""
        allowed = limit_speed(wanted.velocity, most_m_s)
        turn = wrap_angle(wanted.heading_rad - base.pose.heading_rad)
        velocity = limit_change(base.velocity, allowed, base.acceleration_m_s2 * base.step_s)
        return self._smoothing.take(Twist(*velocity, turn_rate(base.turn_rad_s, turn, base.step_s)))

    def brake(self) -> Twist:
        """Decelerate at the limit, and stop turning."""
        return self._smoothing.brake(*hardest_change(self._body, self._step_s))

    def brake_before_things(self, base: Base) -> Twist:
        """The same: the base need not turn to move elsewhere."""
        return self.brake()

    def cut(self) -> None:
        """Stop at once."""
        self._smoothing.cut()
