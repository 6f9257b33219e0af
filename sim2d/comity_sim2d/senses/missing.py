"""Missing people: their believed place lies in plain view and is empty, which is evidence like any other.

The robot believes a person who is merely out of view to be where they were seen last. After several empty
looks there in a row it drops that belief: then it does not know where they are. A place at the edge of the
view, at the end of the range or partly behind a wall proves nothing, nor does a look without sight.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Protocol

from comity_sim2d.pose import Pose
from comity_sim2d.scene.person import Person
from comity_sim2d.senses.sight import Sight

LOOKS = 5
"""Number of empty looks in a row that are no accident: a quarter of a second at 20 Hz (our choice)."""


class MissingTrack(Protocol):
    """What is known of where one person is."""

    @property
    def is_seen(self) -> bool:
        """In the newest measurement."""
        ...

    def ahead(self, time_s: float, /) -> Person:
        """Where they are after a time."""
        ...


@dataclass(slots=True)
class Unseen:
    """A person who is not in the newest measurement."""

    last_s: float | None
    """When they were seen last; None: never."""
    empty: int = 0
    """How often in a row their place was in plain view, and empty; once they are lost, in all."""


class Missing:
    """Keeps account of who is not seen.

    Args:
        sight: What the robot can see.
        noise_m: The standard deviation of one measurement, on each axis.
    """

    def __init__(self, sight: Sight, noise_m: float) -> None:
        self._sight = sight
        self._noise_m = noise_m
        self.unseen: dict[str, Unseen] = {}
        """People who are not in the newest measurement."""
        self.lost: dict[str, float | None] = {}
        """When those who are lost were seen last; None: never."""

    def take_in(self, tracks: Mapping[str, MissingTrack], eye: Pose | None, before_s: float | None) -> bool:
        """Take in the people of a measurement; returns whether a person was lost or found.

        Args:
            tracks: Of all people, with the measurement.
            eye: From where it was made; None where the robot saw nothing.
            before_s: When the measurement before it was made.
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
                unseen.empty = 0  # who is lost stays so until they are seen
        lost = {name: unseen.last_s for name, unseen in self.unseen.items() if unseen.empty >= LOOKS}
        changed, self.lost = lost != self.lost, lost
        return changed
