"""The robot's reading of a person at the requested time, in addition to the reading at the state change."""

from __future__ import annotations

import csv
from collections.abc import Mapping
from typing import TYPE_CHECKING

from comity.answers.trace import ReadingAnswer
from comity.output.run_folder import READINGS
from comity_fis import InputError, Where
from comity_fis.record import reader

if TYPE_CHECKING:
    from comity.output.run_folder import RunFolder
    from comity_executor import NodeExplanation


def readings_at(folder: RunFolder, t: float | None) -> Mapping[str, ReadingAnswer]:
    """By name, the last reading of every person up to a time [s]; None for the end.

    Raises:
        InputError: if the run's file of readings is damaged.
    """
    path = folder / READINGS
    last: dict[str, ReadingAnswer] = {}
    if not path.is_file():
        return last
    with path.open(encoding="utf-8", newline="") as file:
        for row in csv.DictReader(line for line in file if line.endswith("\n")):
            try:
                if t is not None and float(row["t"]) > t + 1e-6:
                    break
                last[row["person"]] = reader(ReadingAnswer).validate_python(row)
            except (KeyError, TypeError, ValueError):
                raise InputError(
                    expected="readings of a run, one a line",
                    got=f"{row}",
                    remedy="Run the episode again.",
                    where=Where(str(path)),
                ) from None
    return last


def reading_for(why: NodeExplanation, readings: Mapping[str, ReadingAnswer]) -> ReadingAnswer | None:
    """The reading of the person whom a node concerns, or None."""
    return readings.get(why.event.person) if why.event.person else None


def reading_text(reading: ReadingAnswer) -> str:
    """A reading in words."""
    return (
        f"t={reading.t:.2f} s: distance {reading.distance_m:.2f} m, bearing {reading.bearing_deg:.1f} deg, "
        f"facing error {reading.facing_error_deg:.1f} deg, {reading.speed_m_s:.2f} m/s"
    )
