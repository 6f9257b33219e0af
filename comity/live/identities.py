"""Tracks the certainty of people's identities: trackers swap people who pass close to each other.

A track's identity is certain once the robot has recognised the person (`PersonTrack.identified_s`), for
example by face. It becomes doubtful if two tracks come within `MEETING_M` of each other or a track disappears
briefly, until the next recognition.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from itertools import combinations
from math import dist, inf
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from comity_executor import PersonTrack

MEETING_M = 1.0
"""Distance below which two tracks may have been swapped [m]."""


class Identities:
    """Keeps the certainty of every identity.

    Args:
        people: The people of the scenario.
    """

    def __init__(self, people: Collection[str]) -> None:
        self._doubted_s = dict.fromkeys(people, -inf)
        """Time of the last doubt, by person [s]."""
        self._sure_s = dict.fromkeys(people, -inf)
        """Time of the last recognition, by person [s]."""
        self._seen: frozenset[str] = frozenset()

    @property
    def uncertain(self) -> frozenset[str]:
        """People whose identity is uncertain."""
        return frozenset(name for name in self._doubted_s if self._sure_s[name] <= self._doubted_s[name])

    def take_in(self, tracks: Sequence[PersonTrack], now_s: float, *, doubted: Collection[str] = ()) -> None:
        """Update with the newest tracks.

        Args:
            tracks: At most one per person.
            now_s: The current time, by the tracks' clock [s].
            doubted: People reported at several positions.
        """
        named = {track.person: track for track in tracks if track.person in self._doubted_s}
        for name, track in named.items():
            if track.identified_s is not None:
                self._sure_s[name] = max(self._sure_s[name], track.identified_s)
        met = {
            track.person
            for pair in combinations(tracks, 2)
            if dist(*((each.x_m, each.y_m) for each in pair)) < MEETING_M
            for track in pair
        }
        for who in self._doubted_s:
            is_gone = who in self._seen and who not in named
            if is_gone or who in doubted or (who in named and who in met):
                self._doubted_s[who] = now_s
        self._seen = frozenset(named)
