"""Missing people: their believed place is in plain view and empty, which counts as evidence.

A person who is merely out of view is believed to be where they were last seen. After several empty looks at
that place in a row the robot drops this belief, and does not know where they are. A place at the edge of the
view, at the limit of the range or partly behind a wall proves nothing, nor does a look without sight.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Protocol

from comity_sim2d.pose import Pose
from comity_sim2d.scene.person import Person
from comity_sim2d.senses.sight import Sight

LOOKS = 5
"""Number of empty looks in a row that are no coincidence: a quarter of a second at 20 Hz (our choice)."""


class MissingTrack(Protocol):
    """The tracking state of one person."""

    @property
    def is_seen(self) -> bool:
        """Whether the person is in the newest measurement."""
        ...

    def ahead(self, time_s: float, /) -> Person:
        """The predicted person after a time [s]."""
        ...


@dataclass(slots=True)
class Unseen:
    """A person who is not in the newest measurement."""

    last_s: float | None
    """Time when they were last seen [s]; None: never."""
    empty: int = 0
    """Number of consecutive empty looks in plain view; once they are lost, the total."""


class Missing:
    """Keeps track of unseen people.

    Args:
        sight: The robot's sight.
        noise_m: Standard deviation of one measurement per axis [m].
    """

    def __init__(self, sight: Sight, noise_m: float) -> None:
        self._sight = sight
        self._noise_m = noise_m
        self.unseen: dict[str, Unseen] = {}
        """People who are not in the newest measurement."""
        self.lost: dict[str, float | None] = {}
        """Time when each lost person was last seen [s]; None: never."""

    def take_in(self, tracks: Mapping[str, MissingTrack], eye: Pose | None, before_s: float | None) -> bool:
        """Process a measurement; returns whether a person was lost or found.

        Args:
            tracks: Tracks of all people, updated with the measurement.
            eye: Pose from which it was made; None if the robot saw nothing.
            before_s: Time of the previous measurement [s].
        """
        if not self.unseen and all(track.is_seen for track in tracks.values()):
            return False
        for name, track in tracks.items():
            if track.is_seen:
                self.unseen.pop(name, None)
                continue
            unseen = self.unseen.setdefault(name, Unseen(before_s))
            if eye is not None and self._sight.is_plain(eye, track.ahead(0.0), self._noise_m):
                unseen.empty += 1
            elif unseen.empty < LOOKS:
                unseen.empty = 0  # a lost person stays lost until seen
        lost = {name: unseen.last_s for name, unseen in self.unseen.items() if unseen.empty >= LOOKS}
        changed, self.lost = lost != self.lost, lost
        return changed
