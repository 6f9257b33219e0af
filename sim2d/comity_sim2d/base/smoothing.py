"""The jerk limit: a base takes up commands as their moving average over a few ticks.

Averaging keeps the limits of speed and acceleration, and the way: what was commanded is driven to the last
millimetre, half a window later. So a law that stops exactly at its goal still does, if it computes from where
the base will be when it has done what it has been told already.
"""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Iterable

from comity_sim2d.pose import Twist

LONGEST_S = 2.0
"""No window is longer: a base would go on for too long as it was told before it saw a person (our choice)."""


def acceleration_within(acceleration: float, jerk: float) -> float:
    """The acceleration that a base makes use of: less than it may, where it takes long to build up.

    Args:
        acceleration: The limit [m/s^2].
        jerk: How fast it may change [m/s^3].
    """
    return min(acceleration, jerk * LONGEST_S / 2.0)


def window_ticks(acceleration: float, jerk: float, step_s: float) -> int:
    """The shortest window that keeps the jerk: acceleration changes by at most 2 a / n from tick to tick."""
    return max(1, math.ceil(2.0 * acceleration / (jerk * step_s) - 1e-9))


class Smoothing:
    """The commands of the last few ticks.

    Args:
        ticks: How many are averaged; 1 takes every command up at once.
    """

    def __init__(self, ticks: int) -> None:
        self._commands: deque[Twist] = deque([Twist()] * ticks, maxlen=ticks)

    @property
    def ticks(self) -> int:
        """The length of the window."""
        return len(self._commands)

    @property
    def latest(self) -> Twist:
        """The last command."""
        return self._commands[-1]

    def take(self, command: Twist) -> Twist:
        """What the base does in the coming tick."""
        self._commands.append(command)
        return _mean(self._commands, self.ticks)

    def brake_straight(self, slower_m_s: float) -> Twist:
        """Slow its way down by so much, and forget what it was told of it; turning goes on as told."""
        now = _mean(self._commands, self.ticks)
        speed = math.hypot(*now.xy)
        kept = max(0.0, 1.0 - slower_m_s / speed) if speed else 0.0
        x, y, told = kept * now.x_m_s, kept * now.y_m_s, [*self._commands][1:]
        self._commands.extend(Twist(x, y, turn) for _, _, turn in (*told, self.latest))
        return _mean(self._commands, self.ticks)

    def brake(self, slower_m_s: float, slower_rad_s: float) -> Twist:
        """Slow what the base does now down by so much, and forget what it was told before."""
        now = _mean(self._commands, self.ticks)
        speed, rate = math.hypot(*now.xy), abs(now.turn_rad_s)
        kept = max(0.0, 1.0 - slower_m_s / speed) if speed else 0.0
        turning = max(0.0, 1.0 - slower_rad_s / rate) if rate else 0.0
        braked = Twist(kept * now.x_m_s, kept * now.y_m_s, turning * now.turn_rad_s)
        self._commands.extend([braked] * self.ticks)
        return braked

    def to_come(self) -> list[Twist]:
        """What the base would still do, tick by tick, if it were told to rest from now on."""
        commands = list(self._commands)
        return [_mean(commands[k:], self.ticks) for k in range(1, self.ticks)]

    def sum_to_come(self) -> Twist:
        """The sum of `to_come`."""
        x = y = turn = 0.0
        for k, command in enumerate(self._commands):
            x, y, turn = x + k * command[0], y + k * command[1], turn + k * command[2]
        ticks = len(self._commands)
        return Twist(x / ticks, y / ticks, turn / ticks)

    def cut(self) -> None:
        """Forget all commands: the base stands still at once."""
        self._commands.extend([Twist()] * self.ticks)


def _mean(commands: Iterable[Twist], ticks: int) -> Twist:
    x = y = turn = 0.0
    for command in commands:
        x, y, turn = x + command[0], y + command[1], turn + command[2]
    return Twist(x / ticks, y / ticks, turn / ticks)
