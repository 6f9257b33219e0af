"""The robot's readings: taken at most once per person and tick, and recorded.

All conditions of one tick use the same reading, so that they cannot contradict each other; the recorded
series contains exactly what the tree has used.
"""

from __future__ import annotations

import csv
from array import array
from collections.abc import Callable, Iterator
from contextlib import suppress
from math import inf, isfinite
from pathlib import Path
from types import TracebackType
from typing import SupportsFloat

from comity_executor.robots.capabilities import LONGEST_LEASE_S
from comity_executor.robots.robot import Reading, Robot
from comity_executor.robots.stop_button import StopButton

COLUMNS = ("t", "distance_m", "centre_distance_m", "bearing_deg", "facing_error_deg", "speed_m_s", "stamp_s")


class ReadingSeries:
    """Every reading of an execution; 64 bytes per row."""

    def __init__(self) -> None:
        self.people: list[str] = []
        """Names in order of first reading."""
        self.who = array("q")
        """Per row, the index into `people`."""
        self._values = array("d")
        """Rows of `COLUMNS`, flattened."""

    def append(self, t: float, person: str, reading: Reading) -> None:
        """Append a reading taken at time `t` [s]."""
        if person not in self.people:
            self.people.append(person)
        self.who.append(self.people.index(person))
        self._values.extend(
            (
                t,
                reading.distance_m,
                reading.centre_distance_m,
                reading.bearing_deg,
                reading.facing_error_deg,
                reading.speed_m_s,
                reading.stamp_s,
            )
        )

    def __len__(self) -> int:
        return len(self.who)

    def rows(self, since: int = 0) -> Iterator[tuple[str, dict[str, float]]]:
        """Rows in chronological order, starting at index `since`."""
        width = len(COLUMNS)
        for row in range(since, len(self.who)):
            values = self._values[row * width : (row + 1) * width]
            yield self.people[self.who[row]], dict(zip(COLUMNS, values, strict=True))


class ReadingsFile:
    """A readings file that grows while the tree runs: one row per reading, rounded to 1e-6 as in the trace.

    Args:
        path: The file; it is overwritten.
    """

    def __init__(self, path: Path) -> None:
        self._file = path.open("w", encoding="utf-8", newline="\n")
        self._writer = csv.writer(self._file, lineterminator="\n")
        self._writer.writerow(("person", *COLUMNS))
        self._written = 0

    def keep(self, readings: ReadingSeries) -> None:
        """Write the readings that are not in the file yet."""
        for person, row in readings.rows(self._written):
            self._writer.writerow((person, *(round(value, 6) + 0.0 for value in row.values())))
        self._file.flush()
        self._written = len(readings)

    def __enter__(self) -> ReadingsFile:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._file.close()


class ClockError(ValueError):
    """A robot's clock is unusable for timing."""


class StaleError(Exception):
    """The readings of a tick are too old to start anything."""


def time_after(last_s: float, now_s: object) -> float:
    """The clock's time as a number [s].

    Raises:
        ClockError: It is not a finite number, or before the last time.
    """
    if isinstance(now_s, bool) or not isinstance(now_s, SupportsFloat) or not isfinite(now := float(now_s)):
        raise ClockError(f"now_s: expected the time as a finite number of seconds, got {now_s!r}")
    if now < last_s:
        raise ClockError(
            f"now_s: expected {last_s:g} s or later, as the clock said before, got {now:g} s; "
            "give a time that never runs backwards, such as time.monotonic()"
        )
    return now


class Senses:
    """All that one tree's nodes read of the world, as of the start of the tick."""

    def __init__(self, robot: Robot, emergency: Callable[[], object] | None = None) -> None:
        self.series = ReadingSeries()
        self.stop_button = StopButton(emergency or robot.emergency)
        """The emergency stop, read before all else."""
        self._robot = robot
        self._now_s, self._last_s = 0.0, -inf
        self._taken: dict[str, Reading | None] = {}
        self._taken_before: dict[str, Reading | None] = {}

    def begin_tick(self) -> float:
        """Start a tick: read the stop, discard old readings; returns the time of this tick [s].

        Raises:
            ClockError: The clock goes backwards, or gives no time.
        """
        self.stop_button.look()
        self._taken, self._taken_before = {}, self._taken
        self._now_s = self._last_s = time_after(self._last_s, self._robot.now_s())
        return self._now_s

    def require_fresh(self) -> None:
        """Reject starting anything in a delayed tick, for example after a slow call.

        Raises:
            StaleError: The tick began longer ago than a goal's lease.
            ClockError: The clock goes backwards, or gives no time.
        """
        age_s = time_after(self._now_s, self._robot.now_s()) - self._now_s
        if age_s > LONGEST_LEASE_S:
            raise StaleError(f"nothing begins in a tick that has read the stop and people {age_s:.2f} s ago")

    def look_at_clock(self) -> float:
        """The current time, during or after a tick; the last known one if the clock cannot be read [s]."""
        with suppress(Exception):
            self._now_s = self._last_s = time_after(self._last_s, self._robot.now_s())
        return self._now_s

    def hold(self, person: str) -> None:
        """Reuse the person's last reading in this tick, whatever the robot sees."""
        self._taken[person] = self._taken_before.get(person)

    def now_s(self) -> float:
        """The time of this tick [s]."""
        return self._now_s

    def read(self, person: str) -> Reading | None:
        """The reading of this tick; None if the person is not seen."""
        if person not in self._taken:
            reading = self._taken[person] = self._robot.read(person)
            if reading is not None:
                self.series.append(self._now_s, person, reading)
        return self._taken[person]
