"""Validates a robot's localisation and tracks of people.

A call that raises, invalid numbers, a pose outside the map and a time in the future count as silence: a robot
without data for long stands. A track that disappears briefly is extrapolated: trackers drop frames.
"""

from __future__ import annotations

from dataclasses import replace
from math import inf, isfinite
from numbers import Real
from typing import TYPE_CHECKING

from comity_executor.robots.raised import raised
from comity_sim2d import Person, wrap_angle

if TYPE_CHECKING:
    from comity_executor import Localisation, MapRobot, PersonTrack
    from comity_sim2d.scene.obstacles import FloorPlan

AHEAD_S = 0.1
"""Maximum offset between a robot's clocks [s]; later timestamps are invalid."""
GRACE_S = 0.3
"""Maximum gap of a track that counts as dropped frames [s] (our choice: three at 10 Hz)."""
OLD_S = 0.5
"""Maximum age of a track; older ones are ignored [s]."""


class BaseSenses:
    """Polls one robot, once per tick.

    Args:
        base: The robot.
        plan: The floor plan of the map.
    """

    def __init__(self, base: MapRobot, plan: FloorPlan) -> None:
        self._base = base
        self._plan = plan
        self._tracks: dict[int | str, PersonTrack] = {}
        """The newest track by tracker identifier, while valid."""
        self.tracked_s = -inf
        """Time of the tracker's last report [s]; -inf before the first."""
        self.refused: dict[str, str] = {}
        """Why the last report was rejected, by source: `localisation`, `tracker`."""

    def localisation(self, now_s: float) -> Localisation | None:
        """The robot's pose; None if it is unknown or invalid."""
        self.refused.pop("localisation", None)
        try:
            here = self._base.localisation()
            why = None if here is None else self._why_not_here(here, now_s)
        except Exception as error:
            here, why = None, raised(error)
        if why is None:
            return here
        self.refused["localisation"] = why
        return None

    def _why_not_here(self, here: Localisation, now_s: float) -> str | None:
        """Why a pose is invalid; None if it is valid."""
        if not _are_finite(here.x_m, here.y_m, here.heading_rad, here.speed_m_s):
            return f"a number of {here!r} is not finite"
        if not _has_come(here.stamp_s, now_s):
            return f"stamp_s is {here.stamp_s!r}, and now_s {now_s:g}"
        if not self._plan.is_floor((here.x_m, here.y_m)):
            return f"({here.x_m:.2f}, {here.y_m:.2f}) is no floor of the map"
        return None

    def tracks(self, now_s: float) -> list[PersonTrack]:
        """Tracks of people seen now or a moment ago."""
        said = self._said(now_s)
        fresh = {track.track: track for track in said or () if now_s - track.stamp_s <= OLD_S}
        if fresh or (said is not None and not said):
            self.tracked_s = now_s
        elif said:
            self.refused["tracker"] = f"its newest track is more than {OLD_S:g} s old"
        people = {track.person for track in fresh.values()} - {None}
        held = {
            name: track
            for name, track in self._tracks.items()
            if name not in fresh and track.person not in people and now_s - track.stamp_s <= GRACE_S
        }
        self._tracks = held | fresh
        return list(self._tracks.values())

    def _said(self, now_s: float) -> list[PersonTrack] | None:
        """The current tracks, without those at invalid positions; None if the tracker is silent."""
        self.refused.pop("tracker", None)
        try:
            tracks = self._base.tracks()
            if tracks is not None:
                return [track for track in tracks if _is_somewhere(track) and _has_come(track.stamp_s, now_s)]
        except Exception as error:
            self.refused["tracker"] = raised(error)
        return None


def one_each(tracks: list[PersonTrack]) -> tuple[list[PersonTrack], frozenset[str]]:
    """The tracks with at most one per person: of several tracks, any may be the person.

    Returns:
        The tracks, with duplicates made anonymous; and the people who had several.
    """
    found: list[PersonTrack] = []
    seen: set[str] = set()
    several: set[str] = set()
    for track in tracks:
        if track.person is not None and track.person in seen:
            several.add(track.person)
            found.append(replace(track, person=None))
        else:
            found.append(track)
            seen |= {track.person} if track.person else set()
    return found, frozenset(several)


def stranger(track: PersonTrack) -> Person:
    """A person with a known position and nothing else."""
    return Person(f"track {track.track}", track.x_m, track.y_m, wrap_angle(track.heading_rad or 0.0))


def _is_somewhere(track: PersonTrack) -> bool:
    numbers = (track.x_m, track.y_m, track.stamp_s, *track.velocity_m_s)
    return _are_finite(*numbers, 0.0 if track.heading_rad is None else track.heading_rad)


def _has_come(stamp_s: object, now_s: float) -> bool:
    return _are_finite(stamp_s) and float(stamp_s) <= now_s + AHEAD_S  # type: ignore[arg-type]


def _are_finite(*numbers: object) -> bool:
    return all(isinstance(number, Real) and isfinite(float(number)) for number in numbers)
