"""Tracking of one person from noisy measurements: constant velocity until a change is detected.

A constant-velocity Kalman filter that converges to the fading-memory filter (Morrison 1969, "Introduction to
Sequential Smoothing and Prediction"), whose one constant is the weight of the old estimate. Such a filter
lags behind a person who turns round. So it monitors the innovations: if they exceed the noise, the person has
changed direction, and the earlier velocity estimate gets little weight (adjustable process noise: Bar-Shalom,
Li and Kirubarajan 2001, "Estimation with Applications to Tracking and Navigation", chapter 11). Without noise
nothing is kept, and the estimate equals the measurement.
"""

from __future__ import annotations

import math
from dataclasses import replace

from comity_sim2d.pose import XY, wrap_angle
from comity_sim2d.scene.person import Person
from comity_sim2d.scene.robot_body import Sensor

FADING = 0.95
"""Weight of the old estimate per tick if there is noise: about one second of memory at 20 Hz (our choice)."""
FARTHEST_STEP_M = 0.3
"""Maximum movement between two measurements, apart from noise [m]; after a larger jump the person was put
elsewhere."""
CHANGE_M_S = 1.0
"""Standard deviation per axis of a velocity that is entirely unknown [m/s] (our choice)."""
SURPRISE_KEPT = 0.7
"""Weight of the old mean of the innovations per tick: about three ticks of memory (our choice)."""
NOTICED_TICKS = 3
"""Delay of the detection that a person changed direction [ticks] (our choice: the memory of that mean)."""
SURPRISE = 5.0
"""Number of standard deviations beyond which that mean is significant: once in 270,000 looks (our choice)."""
SURPRISE_SQUARE = SURPRISE**2 * (1.0 - SURPRISE_KEPT) / (1.0 + SURPRISE_KEPT)
"""Threshold for the squared mean: `SURPRISE**2` times the variance of each component."""


class Covariance:
    """Covariance of position and velocity per axis, as multiples of the variance of a measurement.

    Args:
        sigma_m: Standard deviation of a measurement [m]; positive.
        step_s: Time between measurements [s].
    """

    def __init__(self, sigma_m: float, step_s: float) -> None:
        self._step_s = step_s
        self._change = (CHANGE_M_S / sigma_m) ** 2
        self.restart()

    def restart(self) -> None:
        """Restart: position from one measurement, velocity as certain as after long tracking."""
        self._place, self._both = 1.0, 0.0
        self._velocity = (1.0 - FADING) ** 3 / (FADING * self._step_s**2)

    def doubt(self) -> None:
        """Increase the uncertainty of the velocity since a few ticks ago, and so of the position."""
        since_s = NOTICED_TICKS * self._step_s
        self._velocity += self._change
        self._both += since_s * self._change
        self._place += since_s**2 * self._change

    def expect(self) -> float:
        """Predict one tick ahead; returns the variance of the next innovation."""
        dt = self._step_s
        self._place = (self._place + dt * (2.0 * self._both + dt * self._velocity)) / FADING
        self._both = (self._both + dt * self._velocity) / FADING
        self._velocity /= FADING
        return self._place + 1.0

    def take(self) -> tuple[float, float]:
        """Update with a measurement; returns the gains for the position and for the velocity [1/s]."""
        gain, rate_gain = self._place / (self._place + 1.0), self._both / (self._place + 1.0)
        self._velocity -= rate_gain * self._both
        self._place, self._both = gain, rate_gain
        return gain, rate_gain


class Gains:
    """The filter gains for a sensor, adapted after significant innovations.

    Args:
        sensor: Sensor with its noise.
        step_s: Time between measurements [s].
    """

    def __init__(self, sensor: Sensor, step_s: float) -> None:
        self._exact = (1.0, 1.0 / step_s)
        self._sigma_m = sensor.sigma_m
        self._covariance = Covariance(sensor.sigma_m, step_s) if sensor.sigma_m else None
        self._off = 0j

    def restart(self) -> None:
        """Assume that the person stands."""
        self._off = 0j
        if self._covariance is not None:
            self._covariance.restart()

    def after(self, dx: float, dy: float) -> tuple[float, float]:
        """Gains for the position and for the velocity [1/s], given an innovation [m]."""
        covariance = self._covariance
        if covariance is None:
            return self._exact
        # A filter of constant velocity trades noise against lag: long memory is smooth and late at a turn.
        # Here memory is long until the innovations say otherwise. Divided by their standard deviation they
        # are white noise of variance 1 while the model holds; their running mean is then near 0, and a turn
        # shows as a mean that stays off in one direction. Past five standard deviations of that mean the
        # velocity is taken for unknown since a few ticks, by adding process noise (Bar-Shalom, Li and
        # Kirubarajan 2001, chapter 11), and the filter takes up the new velocity within those ticks.
        # Testing the mean and not each innovation keeps one outlier from resetting it.
        deviation_m = self._sigma_m * math.sqrt(covariance.expect())
        self._off += (1.0 - SURPRISE_KEPT) * (complex(dx, dy) / deviation_m - self._off)
        if self._off.real**2 + self._off.imag**2 > SURPRISE_SQUARE:
            self._off = 0j
            covariance.doubt()
        return covariance.take()


class Track:
    """The filtered position and velocity of one person.

    Args:
        sensor: Sensor with its noise.
        step_s: Time between measurements [s].
        mapped: Assumed pose before the first measurement.
    """

    def __init__(self, sensor: Sensor, step_s: float, mapped: Person) -> None:
        self._gains = Gains(sensor, step_s)
        self._step_s = step_s
        self._farthest_m = FARTHEST_STEP_M + 6.0 * sensor.sigma_m
        self._person = mapped
        self._seen: Person | None = None
        self.velocity: XY = (0.0, 0.0)
        self.turn_rad_s = 0.0
        self.last_velocity: XY = (0.0, 0.0)
        """Velocity when they were last seen [m/s]."""

    @property
    def is_seen(self) -> bool:
        """Whether the person is in the last measurement."""
        return self._seen is not None

    def update(self, seen: Person | None) -> bool:
        """Process a measurement or its absence; returns whether the estimate changed."""
        last, self._seen = self._seen, seen
        if seen is None:
            moved = not self._rests
            if last is not None:
                self.last_velocity = self.velocity
            self.velocity, self.turn_rad_s = (0.0, 0.0), 0.0  # assume that they stay there
            return moved
        if seen is last and self._rests:
            return False  # without noise nothing has changed
        if last is None or math.dist(self._person.xy, seen.xy) > self._farthest_m:
            known, self._person = self._person, seen
            self.velocity, self.turn_rad_s = (0.0, 0.0), 0.0
            self._gains.restart()
            return seen is not known
        (vx, vy), dt = self.velocity, self._step_s
        x, y = self._person.x_m + vx * dt, self._person.y_m + vy * dt
        dx, dy = seen.x_m - x, seen.y_m - y
        gain, rate_gain = self._gains.after(dx, dy)
        self.turn_rad_s = wrap_angle(seen.heading_rad - self._person.heading_rad) / dt
        self.velocity = (vx + rate_gain * dx, vy + rate_gain * dy)
        self._person = replace(seen, x_m=x + gain * dx, y_m=y + gain * dy)
        return True

    @property
    def _rests(self) -> bool:
        return self.velocity == (0.0, 0.0) and self.turn_rad_s == 0.0

    def ahead(self, time_s: float) -> Person:
        """The person after a time, at constant velocity."""
        if time_s == 0.0 or self._rests:
            return self._person
        person, (vx, vy) = self._person, self.velocity
        heading = wrap_angle(person.heading_rad + self.turn_rad_s * time_s)
        return replace(
            person, x_m=person.x_m + vx * time_s, y_m=person.y_m + vy * time_s, heading_rad=heading
        )
