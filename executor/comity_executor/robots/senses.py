"""The robot's readings, taken at most once per person and tick, and kept.

All conditions of one tick see the same reading, so that they cannot contradict each other; and the series
holds exactly what the tree has seen, no more.
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
    """Every reading of an execution: 64 bytes a row."""

    def __init__(self) -> None:
        self.people: list[str] = []
        """In the order in which they were first seen."""
        self.who = array("q")
        """Per row, the index into `people`."""
        self._values = array("d")
        """One row of `COLUMNS` after the other."""

    def append(self, t: float, person: str, reading: Reading) -> None:
        """Add one reading, taken at time t."""
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
        """In the order of reading, without as many of the first ones as `since` says."""
        width = len(COLUMNS)
        for row in range(since, len(self.who)):
            values = self._values[row * width : (row + 1) * width]
            yield self.people[self.who[row]], dict(zip(COLUMNS, values, strict=True))


class ReadingsFile:
    """Readings on disk that grow while the tree runs: one row each, numbers to a millionth as in the trace.

    Args:
        path: Where to write; what is there is replaced.
    """

    def __init__(self, path: Path) -> None:
        self._file = path.open("w", encoding="utf-8", newline="\n")
        self._writer = csv.writer(self._file, lineterminator="\n")
        self._writer.writerow(("person", *COLUMNS))
        self._written = 0

    def keep(self, readings: ReadingSeries) -> None:
        """Write down those that are not yet."""
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
    """A robot's clock by which nothing can be timed."""


class StaleError(Exception):
    """What a tick has read is too old to begin anything by it."""


def time_after(last_s: float, now_s: object) -> float:
    """What a clock says, as a number.

    Raises:
        ClockError: It is no finite number, or before the last one.
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
    """What the nodes of one tree read of the world; everything is as of the start of the tick."""

    def __init__(self, robot: Robot, emergency: Callable[[], object] | None = None) -> None:
        self.series = ReadingSeries()
        self.stop_button = StopButton(emergency or robot.emergency)
        """Read before all else, as of the start of the tick."""
        self._robot = robot
        self._now_s, self._last_s = 0.0, -inf
        self._taken: dict[str, Reading | None] = {}
        self._taken_before: dict[str, Reading | None] = {}

    def begin_tick(self) -> float:
        """Read the stop, and forget the readings of the last tick but one; the time of this tick.

        Raises:
            ClockError: The robot's clock goes back, or gives no time.
        """
        self.stop_button.look()
        self._taken, self._taken_before = {}, self._taken
        self._now_s = self._last_s = time_after(self._last_s, self._robot.now_s())
        return self._now_s

    def require_fresh(self) -> None:
        """Refuse to begin anything in a tick that has been held up, such as by a call that took its time.

        Raises:
            StaleError: The tick began longer ago than a goal holds by itself.
            ClockError: The robot's clock goes back, or gives no time.
        """
        age_s = time_after(self._now_s, self._robot.now_s()) - self._now_s
        if age_s > LONGEST_LEASE_S:
            raise StaleError(f"nothing begins in a tick that has read the stop and people {age_s:.2f} s ago")

    def look_at_clock(self) -> float:
        """The time now, within a tick or after it; the last known one where the clock cannot be read."""
        with suppress(Exception):
            self._now_s = self._last_s = time_after(self._last_s, self._robot.now_s())
        return self._now_s

    def hold(self, person: str) -> None:
        """In this tick the reading of a person is that of the last one, whatever the robot sees."""
        self._taken[person] = self._taken_before.get(person)

    def now_s(self) -> float:
        """The time of this tick."""
        return self._now_s

    def read(self, person: str) -> Reading | None:
        """The reading of this tick; None where the person is not seen."""
        if person not in self._taken:
            reading = self._taken[person] = self._robot.read(person)
            if reading is not None:
                self.series.append(self._now_s, person, reading)
        return self._taken[person]
