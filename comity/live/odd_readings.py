"""Detects readings that suggest a mistake in a robot's code: degrees for radians, misspelt names."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence
from difflib import get_close_matches
from math import tau
from typing import TYPE_CHECKING

from comity.answers.run import Disturbance

if TYPE_CHECKING:
    from comity_executor import Localisation, PersonTrack

STRANGER = "it is a stranger's, to go around"
ALIKE = 0.8
"""Minimum similarity of two names, in [0, 1], by `difflib` (our choice)."""


class OddReadings:
    """Notes each kind of mistake once per run; the readings are still used.

    Args:
        people: The people of the scenario.
        robot: Name of the robot, for the notes.
    """

    def __init__(self, people: Collection[str], robot: str) -> None:
        self._people = people
        self._robot = robot
        self._noted: dict[str, Disturbance] = {}
        """Notes by kind."""

    @property
    def notes(self) -> tuple[Disturbance, ...]:
        """All notes so far, in order."""
        return tuple(self._noted.values())

    def take_in(self, now_s: float, here: Localisation | None, tracks: Sequence[PersonTrack]) -> None:
        """Check new readings.

        Args:
            now_s: Time since the start of the episode [s].
            here: The robot's pose.
            tracks: The tracked people.
        """
        headings = [("localisation", None if here is None else here.heading_rad)]
        headings += [("tracks", track.heading_rad) for track in tracks]
        for call, heading_rad in headings:
            if heading_rad is not None and abs(heading_rad) > tau:
                self._note(now_s, call, _odd_heading(call, heading_rad))
        for what, text in self._odd_names(tracks):
            self._note(now_s, what, text)

    def _odd_names(self, tracks: Sequence[PersonTrack]) -> Iterator[tuple[str, str]]:
        """Notes on names that are not in the scenario, without the names: one may be a passer-by's."""
        known = {name.lower(): name for name in self._people}
        for track in tracks:
            if track.person is None or track.person in self._people:
                continue
            near = get_close_matches(str(track.person).lower(), known, n=1, cutoff=ALIKE)
            who = known[near[0]] if near else ""
            like = f", but one like {who!r}: names are compared letter by letter, in case too" if who else ""
            yield who, f"track {track.track} has a name that no person of the scenario has{like}; {STRANGER}"

    def _note(self, now_s: float, what: str, text: str) -> None:
        if what not in self._noted:
            self._noted[what] = Disturbance(now_s, now_s, "reading", self._robot, text)


def _odd_heading(call: str, heading_rad: float) -> str:
    return (
        f"{call}: heading_rad is {heading_rad:g}, more than a whole turn in radians; "
        f"where it is in degrees, give math.radians({heading_rad:g})"
    )
