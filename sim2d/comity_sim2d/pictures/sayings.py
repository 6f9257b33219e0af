"""Speech and acts of an episode, grouped by addressee and by the robot's position."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from comity_sim2d.pictures import drawing as d

if TYPE_CHECKING:
    from comity_sim2d.frames import Frames
    from comity_sim2d.pose import XY
    from comity_sim2d.robot.acts import ActEvent

TOGETHER_M = 0.3
"""Acts no farther apart than this are shown together [m]: a body's width, so that bubbles stay apart (our
choice)."""


@dataclass(frozen=True, slots=True)
class Saying:
    """Speech and acts from one position."""

    person: str
    """The addressee; for picking up, the place."""
    xy: XY
    """Position of the robot [m]."""
    words: tuple[str, ...]
    """The words; immediate repetitions once."""
    times: int = 1
    """Number of repetitions in a row, also from later positions; this is the first one."""

    @property
    def lines(self) -> tuple[str, ...]:
        """The words, with the number of repetitions if more than one."""
        return self.words if self.times == 1 else (*self.words, f"({self.times} times)")


def sayings(frames: Frames, robot: str, events: Sequence[ActEvent]) -> tuple[Saying, ...]:
    """All speech and acts that were not interrupted, in order.

    Args:
        frames: Frames of the episode.
        robot: Its name.
        events: Its speech and acts.
    """
    found: list[Saying] = []
    for event in sorted(events, key=lambda event: event.t_start):
        if event.stopped:
            continue
        xy = d.pose_at(frames, robot, event.t_start).xy
        last = next((i for i in reversed(range(len(found))) if found[i].person == event.person), None)
        if last is None or math.dist(found[last].xy, xy) > TOGETHER_M:
            found.append(Saying(event.person, xy, (event.words,)))
        elif found[last].words[-1] != event.words:
            found[last] = replace(found[last], words=(*found[last].words, event.words))
    return tuple(_collapsed(found))


def _collapsed(found: Sequence[Saying]) -> list[Saying]:
    """Merges repeated sayings to a person with nothing else to them in between."""
    kept: list[Saying] = []
    last: dict[str, int] = {}
    for one in found:
        before = last.get(one.person)
        if before is not None and kept[before].words == one.words:
            kept[before] = replace(kept[before], times=kept[before].times + 1)
        else:
            last[one.person] = len(kept)
            kept.append(one)
    return kept
