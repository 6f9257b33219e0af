"""Doors from above, as on an architect's plan: the leaf, and the way it swings."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from comity_sim2d.pose import XY

if TYPE_CHECKING:
    from matplotlib.artist import Artist

    from comity_sim2d.door import Door

LEAF, SWING = "#A0622D", "#D9B899"
LEAF_SHARE = 0.96
"""Of the gap's width: the leaf of a sliding door stays a little shorter beside the wall."""
ASIDE_M = 0.09
"""From the middle of the wall to a sliding door's leaf beside it."""


def door_artists(door: Door) -> list[Artist]:
    """A door as it is: shut, a bar in the gap; open, its leaf out of the way."""
    from matplotlib.lines import Line2D

    if door.kind == "opening":
        return [_line(door.start, door.end, SWING, width=1.0, style=(0, (1.0, 2.5)))]
    if not door.is_open:
        sill = _line(door.start, door.end, "#FFFFFF", width=6.0)
        return [sill, _line(door.start, door.end, LEAF, width=4.0)]
    if door.kind == "sliding":
        return [_line(*_slid(door), LEAF, width=2.4)]
    tip, swing = _swung(door)
    xs, ys = zip(*swing, strict=True)
    arc = Line2D(xs, ys, color=SWING, lw=1.0, zorder=3.2)
    return [arc, _line(door.start, tip, LEAF, width=2.4)]


def leaf_lines(door: Door) -> list[list[XY]]:
    """The lines of an open leaf and of its swing, for labels to keep off."""
    if door.kind == "opening" or not door.is_open:
        return []
    if door.kind == "sliding":
        return [list(_slid(door))]
    tip, swing = _swung(door)
    return [swing, [door.start, tip]]


def _line(start: XY, end: XY, colour: str, *, width: float, style: object = "-") -> Artist:
    from matplotlib.lines import Line2D

    line = Line2D(
        [start[0], end[0]], [start[1], end[1]], color=colour, lw=width, solid_capstyle="butt", zorder=3.3
    )
    line.set_linestyle(style)  # type: ignore[arg-type]
    return line


def _slid(door: Door) -> tuple[XY, XY]:
    """The leaf beside the wall, on its left as seen from the door's start."""
    (ax, ay), (bx, by) = door.start, door.end
    width = math.dist(door.start, door.end)
    ux, uy = (bx - ax) / width, (by - ay) / width
    side = (-uy * ASIDE_M, ux * ASIDE_M)
    back = width * LEAF_SHARE
    return (ax - back * ux + side[0], ay - back * uy + side[1]), (ax + side[0], ay + side[1])


def _swung(door: Door) -> tuple[XY, list[XY]]:
    """The tip of a leaf that is open by a quarter turn to the left, and its way there."""
    (ax, ay), (bx, by) = door.start, door.end
    width, along = math.dist(door.start, door.end), math.atan2(by - ay, bx - ax)
    angles = [along + math.pi / 2 * k / 16 for k in range(17)]
    way = [(ax + width * math.cos(a), ay + width * math.sin(a)) for a in angles]
    return way[-1], way
