"""What the robot said and did in an episode, gathered by whom it was for and where it stood."""

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
"""What it did no farther apart is told together: a body's width, so that bubbles stand apart (our choice)."""


@dataclass(frozen=True, slots=True)
class Saying:
    """What was said and done from one place."""

    person: str
    """For whom; of what is picked up, where."""
    xy: XY
    """Where the robot was."""
    words: tuple[str, ...]
    """What was repeated at once, once."""
    times: int = 1
    """How often in a row, also from further places; it was said first at this one."""

    @property
    def lines(self) -> tuple[str, ...]:
        """The words, and how often where that is more than once."""
        return self.words if self.times == 1 else (*self.words, f"({self.times} times)")


def sayings(frames: Frames, robot: str, events: Sequence[ActEvent]) -> tuple[Saying, ...]:
    """All that was not broken off, in order.

    Args:
        frames: Where the robot was.
        robot: Its name.
        events: What it said and did.
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
    """One for what was said to a person again and again with nothing else to them in between."""
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
