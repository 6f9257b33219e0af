"""Whom a robot may take for whom: trackers change the names of two people who pass close by each other.

Who a track is counts as sure once the robot has made sure of it (`PersonTrack.identified_s`), such as by a
face. Two tracks within `MEETING_M` of each other, or a track that is gone for a moment, are a doubt that only
a later recognition ends.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from itertools import combinations
from math import dist, inf
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from comity_executor import PersonTrack

MEETING_M = 1.0
"""Tracks that were so near each other may have been mixed up."""


class Identities:
    """Keeps account of who is surely who.

    Args:
        people: The people of the scenario.
    """

    def __init__(self, people: Collection[str]) -> None:
        self._doubted_s = dict.fromkeys(people, -inf)
        """When there was a reason to doubt last."""
        self._sure_s = dict.fromkeys(people, -inf)
        """When the robot made sure last."""
        self._seen: frozenset[str] = frozenset()

    @property
    def uncertain(self) -> frozenset[str]:
        """Who may be another person."""
        return frozenset(name for name in self._doubted_s if self._sure_s[name] <= self._doubted_s[name])

    def take_in(self, tracks: Sequence[PersonTrack], now_s: float, *, doubted: Collection[str] = ()) -> None:
        """Take in the newest tracks.

        Args:
            tracks: One at most for each person.
            now_s: The time, by the same clock as theirs.
            doubted: Who was said to be in several places.
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
