"""Doors that are opened or shut during an episode, drawn in their state at a time."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from comity_sim2d.maps.doorways import turned
from comity_sim2d.pictures.door_drawing import door_artists

if TYPE_CHECKING:
    from matplotlib.artist import Artist

    from comity_sim2d.maps.doorways import DoorTurn
    from comity_sim2d.scene.door import Door


def doors_at(doors: Sequence[Door], turns: Sequence[DoorTurn], time_s: float) -> tuple[Door, ...]:
    """All doors in their state at a time.

    Args:
        doors: All doors in their initial state.
        turns: Openings and shuttings, in order.
        time_s: The time [s]; turns at this time count.
    """
    return turned(doors, {turn.door: turn.is_open for turn in turns if turn.t <= time_s})


class TurningDoors:
    """The artists of doors that turn; doors that never do belong to the background.

    Args:
        doors: All doors in their initial state.
        turns: Openings and shuttings, in order.
    """

    def __init__(self, doors: Sequence[Door], turns: Sequence[DoorTurn]) -> None:
        names = {turn.door for turn in turns}
        self._doors = tuple(door for door in doors if door.name in names)
        self._turns = tuple(turns)
        self.resting = tuple(door for door in doors if door.name not in names)
        """Doors that never turn."""
        both = (door for state in (True, False) for door in turned(self._doors, dict.fromkeys(names, state)))
        self._artists = {door: door_artists(door) for door in both}

    @property
    def artists(self) -> list[Artist]:
        """All artists."""
        return [artist for artists in self._artists.values() for artist in artists]

    def at(self, time_s: float) -> list[Artist]:
        """The artists at a time."""
        return [part for door in doors_at(self._doors, self._turns, time_s) for part in self._artists[door]]
