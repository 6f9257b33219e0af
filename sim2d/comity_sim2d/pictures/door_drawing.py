"""Doors seen from above, as on an architect's plan: the leaf and its swing."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from comity_sim2d.pose import XY

if TYPE_CHECKING:
    from matplotlib.artist import Artist

    from comity_sim2d.scene.door import Door

LEAF, SWING = "#A0622D", "#D9B899"
LEAF_SHARE = 0.96
"""Share of the gap's width that the leaf of a sliding door covers next to the wall."""
ASIDE_M = 0.09
"""Distance from the middle of the wall to the leaf of an open sliding door [m]."""


def door_artists(door: Door) -> list[Artist]:
    """A door in its state: shut, a bar in the gap; open, its leaf out of the way."""
    if door.kind == "opening":
        return [_line([door.start, door.end], SWING, width=1.0, dotted=True)]
    if door.is_open:
        arc = swing(door)
        return [*([_line(arc, SWING, width=1.0)] if arc else []), _line(leaf(door), LEAF, width=2.4)]
    return [_line(leaf(door), "#FFFFFF", width=6.0), _line(leaf(door), LEAF, width=4.0)]


def leaf(door: Door) -> list[XY]:
    """The line of the leaf, seen from above; empty for an opening, which has none."""
    if door.kind == "opening":
        return []
    if not door.is_open:
        return [door.start, door.end]
    return list(_slid(door)) if door.kind == "sliding" else [door.start, _swung(door)[-1]]


def swing(door: Door) -> list[XY]:
    """The arc of an open, hinged leaf's tip; empty for all others."""
    return _swung(door) if door.kind == "hinged" and door.is_open else []


def _line(points: list[XY], colour: str, *, width: float, dotted: bool = False) -> Artist:
    from matplotlib.lines import Line2D

    xs, ys = zip(*points, strict=True)
    style = (0, (1.0, 2.5)) if dotted else "-"
    return Line2D(xs, ys, color=colour, lw=width, ls=style, solid_capstyle="butt", zorder=3.3)


def _slid(door: Door) -> tuple[XY, XY]:
    """The leaf next to the wall, on its left as seen from the door's start."""
    (ax, ay), (bx, by) = door.start, door.end
    width = math.dist(door.start, door.end)
    ux, uy = (bx - ax) / width, (by - ay) / width
    side = (-uy * ASIDE_M, ux * ASIDE_M)
    back = width * LEAF_SHARE
    return (ax - back * ux + side[0], ay - back * uy + side[1]), (ax + side[0], ay + side[1])


def _swung(door: Door) -> list[XY]:
    """The arc of a leaf's tip that opens by a quarter turn to the left."""
    (ax, ay), (bx, by) = door.start, door.end
    width, along = math.dist(door.start, door.end), math.atan2(by - ay, bx - ax)
    angles = [along + math.pi / 2 * k / 16 for k in range(17)]
    return [(ax + width * math.cos(a), ay + width * math.sin(a)) for a in angles]
