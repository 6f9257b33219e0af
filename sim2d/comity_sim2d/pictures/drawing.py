"""Drawing primitives for maps: bodies, walls, paths."""

from __future__ import annotations

import math
import textwrap
from collections.abc import Iterable
from dataclasses import replace
from itertools import pairwise
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from comity_sim2d.frames import Frames
from comity_sim2d.pictures import colours
from comity_sim2d.pictures.door_drawing import door_artists
from comity_sim2d.pose import XY, Pose

if TYPE_CHECKING:
    from matplotlib.artist import Artist
    from matplotlib.axes import Axes
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure
    from matplotlib.patches import Circle, Patch, PathPatch, Polygon
    from matplotlib.text import Text

    from comity_sim2d.maps.place_map import PlaceMap
    from comity_sim2d.scene.o_space import OSpace
    from comity_sim2d.scene.room import Room, Wall
    from comity_sim2d.scene.scene import Scene

PALETTE, INK, GREY, FAINT = colours.PALETTE, colours.INK, colours.GREY, colours.FAINT
HALO = colours.HALO
ROBOT = "#22252B"
FAINT_INK = "#7A808A"
"""Colour of thin lines; text is darker."""
FLOOR, WALL, FURNITURE, FURNITURE_EDGE = "#FBFAF7", "#4A4E57", "#E9E5DC", "#C9C2B4"
DASHES = (0, (5.0, 3.5))
NOSE = 1.42
"""Distance of a person's nose from the centre, in radii of the disc."""
O_SPACE = "#EEEFF1"
RECENT_M, MOST_SHADES = 5.0, 6
"""Pieces of a path of this length [m] have the same shade, and there are at most this many shades (our
choice)."""
TRACK_DARK, TRACK_FADED = 0.8, 0.25
"""Shade of the newest piece of a person's path, and the share of it for the oldest."""
MOVED_M = 0.05
"""A person who moved less than this has no track [m]."""
BARS_M = (1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0, 200.0, 500.0)
SHORTEST_BAR_IN = 0.35
ROOM_EDGE_M = 0.12
"""Space for the outer wall's line around the floor [m]."""
SLENDER = 0.5
"""Minimum ratio of width to height of an episode's map, so that labels fit next to a narrow room (our choice:
half of the height of the tallest animation holds a bubble and a headline)."""

FLAT = 0.3
"""Minimum ratio of height to width of an animation's map, so that labels fit above and below a corridor (our
choice: four lines of a name on either side)."""


def passers_by(scene: Scene) -> list[tuple[str, float]]:
    """Names and radii [m] of people who are in no plan."""
    who = scene.passers_by
    return [(name, who.radius_m) for name in who.names] if who else []


def draw_place(ax: Axes, scene: Scene | PlaceMap, beside_m: float = 0.0, above_m: float = 0.0) -> PathPatch:
    """Draw the floor, walls, furniture and doors in their initial state, without names.

    Args:
        ax: Where to draw it.
        scene: The place.
        beside_m: Free space to the left, and as much to the right [m].
        above_m: Free space above, and as much below [m].

    Returns:
        The floor, for clipping.
    """
    from matplotlib.patches import Polygon

    ax.set_aspect("equal")
    ax.set_axis_off()
    xs, ys = zip(*scene.room.corners, strict=True)
    ax.set_xlim(min(xs) - ROOM_EDGE_M - beside_m, max(xs) + ROOM_EDGE_M + beside_m)
    ax.set_ylim(min(ys) - ROOM_EDGE_M - above_m, max(ys) + ROOM_EDGE_M + above_m)
    floor, edge = _floor(scene.room)
    ax.add_patch(floor)
    ax.add_patch(edge)
    for piece in scene.furniture:
        ax.add_patch(Polygon(piece.corners, closed=True, fc=FURNITURE, ec=FURNITURE_EDGE, lw=1.2, zorder=2))
    for wall in scene.walls:
        patch = _wall(wall)
        ax.add_patch(patch)
        patch.set_clip_path(floor)  # an inner wall may reach through the outer one
    add_all(ax, [artist for door in scene.doors for artist in door_artists(door)])
    return floor


def _floor(room: Room) -> tuple[PathPatch, PathPatch]:
    """The floor, and the outer wall around it: objects on the floor are drawn between the two."""
    from matplotlib.patches import PathPatch
    from matplotlib.path import Path

    outlines = [Path([*corners, corners[0]], closed=True) for corners in room.outlines]
    path = Path.make_compound_path(*outlines)
    floor = PathPatch(path, fc=FLOOR, ec="none", zorder=1)
    return floor, PathPatch(path, fc="none", ec=WALL, lw=4.0, joinstyle="miter", zorder=1.8)


def _wall(wall: Wall) -> Polygon:
    from matplotlib.patches import Polygon
    from shapely import LineString

    outline = LineString([wall.start, wall.end]).buffer(wall.thickness_m / 2).exterior.coords
    return Polygon(np.asarray(outline), closed=True, fc=WALL, ec="none", zorder=3)


def extent_m(scene: Scene | PlaceMap) -> XY:
    """Width and height of the map, outer walls included [m]."""
    xs, ys = zip(*scene.room.corners, strict=True)
    return (max(xs) - min(xs) + 2 * ROOM_EDGE_M, max(ys) - min(ys) + 2 * ROOM_EDGE_M)


def beside_m(scene: Scene) -> float:
    """Free space on either side of an episode's map [m]; 0 except for narrow rooms, see `SLENDER`."""
    wide, high = extent_m(scene)
    return max(0.0, (SLENDER * high - wide) / 2)


def above_m(scene: Scene) -> float:
    """Free space above and below an animation's map [m]; 0 except for flat rooms, see `FLAT`."""
    wide, high = extent_m(scene)
    return max(0.0, (FLAT * wide - high) / 2)


def person_artists(pose: Pose, radius_m: float, colour: str, *, ghost: bool = False) -> list[Artist]:
    """A person from above: the body's disc, a head, and a nose that shows where they face."""
    from matplotlib.patches import Circle, Polygon

    if ghost:
        return [Circle(pose.xy, radius_m, fill=False, ec=colour, lw=1.2, zorder=4.8)]
    tip = pose.ahead(radius_m * NOSE)
    sides = [pose.ahead(radius_m * 0.98, side * math.radians(24.0)) for side in (1, -1)]
    return [
        Polygon([tip, *sides], closed=True, fc=colour, ec="none", zorder=5),
        Circle(pose.xy, radius_m, fc=tint(colour, 0.55), ec=colour, lw=1.6, zorder=5),
        Circle(pose.xy, radius_m * 0.5, fc=colour, ec="none", zorder=6),
    ]


def dashed_circle(centre: XY, radius_m: float, colour: str) -> Circle:
    """A target distance."""
    from matplotlib.patches import Circle

    return Circle(centre, radius_m, fill=False, ec=colour, lw=1.5, ls=DASHES, zorder=4)


def o_spaces_at(scene: Scene, frames: Frames, time_s: float | None = None) -> tuple[OSpace, ...]:
    """O-spaces of groups at a time, by default at the end, without empty ones."""
    members = {name for group in scene.groups for name in group.members}
    poses = {name: pose_at(frames, name, time_s) for name in members}
    people = (
        replace(person, x_m=pose.x_m, y_m=pose.y_m, heading_rad=pose.heading_rad)
        for person in scene.people
        if (pose := poses.get(person.name)) is not None
    )
    return tuple(space for space in scene.o_spaces_among(people) if space.radius_m > 0.0)


def draw_o_spaces(ax: Axes, spaces: Iterable[OSpace], floor: Patch) -> list[Patch]:
    """Draw the o-spaces of groups."""
    discs = [draw_o_space(ax, space.xy, space.radius_m) for space in spaces if space.radius_m > 0.0]
    for disc in discs:
        disc.set_clip_path(floor)
    return discs


def draw_o_space(ax: Axes, centre: XY, radius_m: float) -> Patch:
    """A light disc with a dashed edge on the floor, below furniture and walls."""
    from matplotlib.patches import Circle

    return ax.add_patch(Circle(centre, radius_m, fc=O_SPACE, ec=FAINT_INK, lw=1.0, ls=DASHES, zorder=1.5))


def draw_track(ax: Axes, points: NDArray[np.float64], colour: str) -> None:
    """Draw the path of a person who walks: a thin line from a small ring at its start."""
    start = draw_faded(ax, points, colour, dark=TRACK_DARK, faded=TRACK_FADED, width_pt=1.0, level=4.2)
    ax.plot(*points[0, :2], marker="o", ms=4.5, mfc="#FFFFFF", mec=start, mew=1.1, zorder=4.3)


def draw_faded(
    ax: Axes,
    points: NDArray[np.float64],
    colour: str,
    *,
    dark: float,
    faded: float,
    width_pt: float,
    level: float,
) -> tuple[float, float, float]:
    """Draw a path: the last `RECENT_M` in full shade, the rest fading towards the start.

    Args:
        ax: Where to draw it.
        points: Points along the path, oldest first [m], shape (n, 2).
        colour: Colour of the line.
        dark: Share of the colour in the newest piece, in (0, 1]; the rest is white.
        faded: Share of that for the oldest piece, in (0, 1].
        width_pt: Width of the line [pt].
        level: Drawing order: higher levels cover lower ones.

    Returns:
        Colour of the oldest piece: red, green and blue in [0, 1].
    """
    from matplotlib.collections import LineCollection

    pieces = _recent_first(points[:, :2])
    shades = [tint(colour, 1.0 - dark * share) for share in np.linspace(1.0, faded, len(pieces)).tolist()]
    # the oldest first, so that newer pieces lie on it
    lines = LineCollection(pieces[::-1], colors=shades[::-1], linewidths=width_pt)
    lines.set(zorder=level, capstyle="butt")
    ax.add_collection(lines, autolim=False)
    return shades[-1]


def _recent_first(points: NDArray[np.float64]) -> list[NDArray[np.float64]]:
    """Pieces of a path of about `RECENT_M`, the last one first, each starting where the previous one ends."""
    along = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(points, axis=0).T))])
    left = along[-1] - along
    marks = np.arange(0.0, float(left[0]) + RECENT_M, RECENT_M)[: MOST_SHADES + 1]
    marks[-1] = max(float(marks[-1]), float(left[0]))
    pieces = []
    for near, far in pairwise(marks.tolist()):
        inside = np.flatnonzero((left >= near - 1e-9) & (left <= far + 1e-9))
        if len(inside):
            pieces.append(points[max(int(inside[0]) - 1, 0) : int(inside[-1]) + 1])
    return [piece for piece in pieces if len(piece) > 1] or [points]


def has_moved(points: NDArray[np.float64]) -> bool:
    """Whether positions, shape (n, 2), differ by more than shifting from foot to foot."""
    return bool(np.ptp(points[:, :2], axis=0).max() > MOVED_M)


def draw_scale_bar(figure: Figure, left_in: float, bottom_in: float, in_per_m: float) -> None:
    """Draw a scale bar of one metre, or of the next visible length in `BARS_M`.

    Args:
        figure: The page.
        left_in: Left end [in].
        bottom_in: Height above the bottom of the page [in].
        in_per_m: The scale of the map.
    """
    from matplotlib.lines import Line2D

    width, height = figure.get_size_inches().tolist()
    metres = next((bar for bar in BARS_M if bar * in_per_m >= SHORTEST_BAR_IN), BARS_M[-1])
    y, left, right = bottom_in / height, left_in / width, (left_in + metres * in_per_m) / width
    figure.add_artist(Line2D([left, right], [y, y], color=INK, lw=2.0, solid_capstyle="butt"))
    figure.text(right + 0.08 / width, y, f"{metres:g} m", size=9, color=INK, va="center")


def short(name: str, most: int) -> str:
    """A name shortened to a number of characters, with an ellipsis if cut."""
    return name if len(name) <= most else f"{name[: most - 1].rstrip()}…"


def in_lines(name: str, most: int) -> str:
    """A name in as many lines as it needs, each of at most this number of characters."""
    return textwrap.fill(name, most) or name


def fitting(label: Text, most_px: float, canvas: FigureCanvasAgg) -> str:
    """The part of a label's text that fits into a width in pixels, with an ellipsis if cut."""
    untyped: Any = canvas  # its drawing calls carry no types
    words, most = label.get_text(), len(label.get_text())
    while most > 1 and label.get_window_extent(untyped.get_renderer()).width > most_px:
        most -= 1
        label.set_text(short(words, most))
    return label.get_text()


def robot_artists(pose: Pose, radius_m: float, *, ghost: bool = False) -> list[Artist]:
    """The robot from above: a disc with a visor on the side that it faces."""
    from matplotlib.patches import Circle, Polygon

    edge, level = (GREY, 6.5) if ghost else (ROBOT, 7.0)  # past poses lie below the current one
    angles = np.radians(np.linspace(-38.0, 38.0, 15))
    outer = [pose.ahead(radius_m * 0.84, float(a)) for a in angles]
    inner = [pose.ahead(radius_m * 0.46, float(a)) for a in angles[::-1]]
    return [
        Circle(pose.xy, radius_m, fc="#FFFFFF", ec=edge, lw=1.4 if ghost else 2.2, zorder=level),
        Polygon([*outer, *inner], closed=True, fc=edge, ec="none", zorder=level + (0.2 if ghost else 1.0)),
    ]


def add_all(ax: Axes, artists: Iterable[Artist]) -> None:
    """Put artists on a map."""
    for artist in artists:
        ax.add_artist(artist)


def pose_at(frames: Frames, entity: str, time_s: float | None = None) -> Pose:
    """The pose of an entity at a time; by default at the end."""
    i = len(frames) - 1 if time_s is None else int(np.searchsorted(frames.time_s, time_s - 1e-9))
    x, y, heading = frames.of(entity)[min(i, len(frames) - 1)].tolist()
    return Pose(x, y, heading)


def marks_along(points: NDArray[np.float64], every_m: float, first_m: float) -> list[tuple[XY, XY]]:
    """Points at equal spacing along a path, each with the direction there (a unit vector)."""
    legs = np.diff(points, axis=0)
    way = np.concatenate([[0.0], np.cumsum(np.hypot(legs[:, 0], legs[:, 1]))])
    marks = []
    for at in np.arange(first_m, float(way[-1]) - 0.2, every_m):
        i = int(np.searchsorted(way, at))
        low, high = points[max(i - 3, 0)], points[min(i + 3, len(points) - 1)]
        length = float(np.hypot(*(high - low)))
        x, y = points[i].tolist()
        if length > 0.0:
            marks.append(((x, y), (float(high[0] - low[0]) / length, float(high[1] - low[1]) / length)))
    return marks


def tint(colour: str, share: float) -> tuple[float, float, float]:
    """The colour mixed with a share of white."""
    from matplotlib.colors import to_rgb

    r, g, b = (c + (1.0 - c) * share for c in to_rgb(colour))
    return (r, g, b)
