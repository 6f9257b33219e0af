"""The jerk limit: a base executes the moving average of its last few commands.

Averaging preserves the limits of speed and acceleration, and the path: it is driven exactly as commanded,
half a window later. So a control law that stops exactly at its goal still does, provided that it starts from
the state the base reaches after all commands so far.
"""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Iterable

from comity_sim2d.pose import Twist

LONGEST_S = 2.0
"""Maximum length of the window [s]: with a longer one the base would respond too late to a person (our
choice)."""


def acceleration_within(acceleration: float, jerk: float) -> float:
    """The acceleration that a base uses [m/s^2]: less than its limit if that takes long to build up.

    Args:
        acceleration: The limit [m/s^2].
        jerk: The jerk limit [m/s^3].
    """
    return min(acceleration, jerk * LONGEST_S / 2.0)


def window_ticks(acceleration: float, jerk: float, step_s: float) -> int:
    """The shortest window that keeps the jerk limit: acceleration changes by at most 2 a / n per tick."""
    return max(1, math.ceil(2.0 * acceleration / (jerk * step_s) - 1e-9))


class Smoothing:
    """The commands of the last few ticks.

    Args:
        ticks: Number of commands averaged; 1 applies every command at once.
    """

    def __init__(self, ticks: int) -> None:
        self._commands: deque[Twist] = deque([Twist()] * ticks, maxlen=ticks)

    @property
    def ticks(self) -> int:
        """Length of the window."""
        return len(self._commands)

    @property
    def latest(self) -> Twist:
        """The last command."""
        return self._commands[-1]

    def take(self, command: Twist) -> Twist:
        """Add a command; return the velocity for the coming tick."""
        self._commands.append(command)
        return _mean(self._commands, self.ticks)

    def brake_straight(self, slower_m_s: float) -> Twist:
        """Reduce the linear velocity, and drop earlier linear commands; turning continues as commanded."""
        now = _mean(self._commands, self.ticks)
        speed = math.hypot(*now.xy)
        kept = max(0.0, 1.0 - slower_m_s / speed) if speed else 0.0
        x, y, told = kept * now.x_m_s, kept * now.y_m_s, [*self._commands][1:]
        self._commands.extend(Twist(x, y, turn) for _, _, turn in (*told, self.latest))
        return _mean(self._commands, self.ticks)

    def brake(self, slower_m_s: float, slower_rad_s: float) -> Twist:
        """Reduce the current velocities, and drop all earlier commands."""
        now = _mean(self._commands, self.ticks)
        speed, rate = math.hypot(*now.xy), abs(now.turn_rad_s)
        kept = max(0.0, 1.0 - slower_m_s / speed) if speed else 0.0
        turning = max(0.0, 1.0 - slower_rad_s / rate) if rate else 0.0
        braked = Twist(kept * now.x_m_s, kept * now.y_m_s, turning * now.turn_rad_s)
        self._commands.extend([braked] * self.ticks)
        return braked

    def to_come(self) -> list[Twist]:
        """The velocities of the next ticks if all commands from now on were zero."""
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
        """Drop all commands: the base stops at once."""
        self._commands.extend([Twist()] * self.ticks)


def _mean(commands: Iterable[Twist], ticks: int) -> Twist:
    x = y = turn = 0.0
    for command in commands:
        x, y, turn = x + command[0], y + command[1], turn + command[2]
    return Twist(x / ticks, y / ticks, turn / ticks)
