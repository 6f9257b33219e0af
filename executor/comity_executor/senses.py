"""The robot's readings, taken at most once per person and tick, and kept.

All conditions of one tick see the same reading, so that they cannot contradict each other; and the series
holds exactly what the tree has seen, no more.
"""

from __future__ import annotations

import csv
from array import array
from collections.abc import Iterator
from pathlib import Path

from comity_executor.robot import Reading, Robot

COLUMNS = ("t", "distance_m", "centre_distance_m", "bearing_deg", "facing_error_deg", "speed_m_s", "stamp_s")


class ReadingSeries:
    """Every reading of an execution, in columns: 64 bytes a row."""

    def __init__(self) -> None:
        self.people: list[str] = []
        """In the order in which they were first seen."""
        self.who = array("q")
        """Per row, the index into `people`."""
        self.columns = {name: array("d") for name in COLUMNS}

    def append(self, t: float, person: str, reading: Reading) -> None:
        """Add one reading, taken at time t."""
        if person not in self.people:
            self.people.append(person)
        self.who.append(self.people.index(person))
        values = (
            t,
            reading.distance_m,
            reading.centre_distance_m,
            reading.bearing_deg,
            reading.facing_error_deg,
            reading.speed_m_s,
            reading.stamp_s,
        )
        for column, value in zip(self.columns.values(), values, strict=True):
            column.append(value)

    def __len__(self) -> int:
        return len(self.who)

    def rows(self) -> Iterator[tuple[str, dict[str, float]]]:
        """Person by person and tick by tick, in the order of reading."""
        for row, who in enumerate(self.who):
            yield self.people[who], {name: column[row] for name, column in self.columns.items()}


def write_readings_csv(path: Path, readings: ReadingSeries) -> None:
    """Write one row per reading, numbers to a millionth as in the trace."""
    with path.open("w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(("person", *COLUMNS))
        for person, row in readings.rows():
            writer.writerow((person, *(round(value, 6) + 0.0 for value in row.values())))


class Senses:
    """What the nodes of one tree read of the world; everything is as of the start of the tick."""

    def __init__(self, robot: Robot) -> None:
        self.series = ReadingSeries()
        self._robot = robot
        self._now_s = 0.0
        self._taken: dict[str, Reading | None] = {}

    def begin_tick(self) -> float:
        """Forget the readings of the last tick; the world's time, which holds for this one."""
        self._taken.clear()
        self._now_s = self._robot.now_s()
        return self._now_s

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
