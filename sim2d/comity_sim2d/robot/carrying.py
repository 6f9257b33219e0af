"""Objects in the robot's hands, derived from the record of its acts."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator

from comity_sim2d.kinds import require_kinds, require_numbers
from comity_sim2d.robot.acts import HAND_OVER, PICK_UP, ActEvent


def carried_at(events: Iterable[ActEvent], t: float) -> str | None:
    """The object in the robot's hands at a time [s], or None."""
    require_numbers("carried", t=t)
    return next((thing for thing, begin, end in carryings(events) if begin <= t + 1e-9 < end), None)


def carryings(events: Iterable[ActEvent]) -> Iterator[tuple[str, float, float]]:
    """Carried objects with start and end [s]; infinite end if never handed over."""
    held: tuple[str, float] | None = None
    require_kinds("carried", events=(events, Iterable))
    for event in events:
        require_kinds("carried", events=(event, ActEvent))
        if event.stopped or event.thing is None:
            continue
        if event.act == PICK_UP:
            held = (event.thing, event.t_end)
        elif event.act == HAND_OVER and held is not None:
            yield (*held, event.t_end)
            held = None
    if held is not None:
        yield (*held, math.inf)
