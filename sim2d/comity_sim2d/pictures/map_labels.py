"""Labels on a map: names, distances and speech bubbles, placed where they hide nothing."""

from __future__ import annotations

import math
import textwrap
from collections.abc import Sequence
from itertools import product
from typing import TYPE_CHECKING, Any

import numpy as np

from comity_sim2d.pictures import drawing as d
from comity_sim2d.pictures.label_placement import FAR_PX, Box, Disc, Page
from comity_sim2d.pictures.page import LINE_SPACING
from comity_sim2d.pose import XY, Pose, direction_to

if TYPE_CHECKING:
    from matplotlib.artist import Artist
    from matplotlib.axes import Axes
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.text import Text
    from shapely import Point, Polygon

    from comity_sim2d.maps.place_map import PlaceMap
    from comity_sim2d.scene.area import Area
    from comity_sim2d.scene.room import Furniture
    from comity_sim2d.scene.scene import Scene

PX_PER_IN = 100.0
"""Resolution assumed here, whatever the page's: labels have the same places in every format and size."""
EDGE_PX = 10.0
LINE_PX = 3.0
WALL_PX = 7.0
"""Distance from the outline of the floor to text inside [px]: half the outer wall, and some space."""
NAME_PT, AREA_PT, PERSON_PT = 9.0, 9.5, 10.5
MUCH = 30
"""Maximum number of furniture names placed next to their piece: more would hide the rest (our choice)."""
BUBBLE_CHARACTERS, PERSON_CHARACTERS, NAME_CHARACTERS = (26, 20, 16, 12), (24, 22, 20, 18, 16, 14), 24
"""Maximum characters per line of a bubble and of a person's name (the first, unless a narrower one has a
better place), and of other names."""
NARROWER = 0.5
"""Cost of each narrower shape of a bubble or a name: equal to 30 px more distance (our choice)."""
MOST_LINES = 8
"""Maximum number of lines of a bubble; a larger one would hide the addressee. The run's page has the full
text (our choice)."""
RIM = 0.8
"""Share of the speaker's radius that a bubble stays outside of (our choice)."""


class MapLabels:
    """The labels of one map. First add what to avoid; each label then avoids everything added before it."""

    def __init__(self, ax: Axes, canvas: FigureCanvasAgg) -> None:
        from matplotlib.transforms import Affine2D

        self.ax = ax
        untyped: Any = canvas  # its drawing calls carry no types
        self._renderer = untyped.get_renderer()
        self._to_px = canvas.figure.dpi_scale_trans.inverted() + Affine2D().scale(PX_PER_IN)
        self._metres_to_px = ax.transData + self._to_px
        area = ax.get_window_extent(self._renderer).transformed(self._to_px)
        self._page = Page(Box(area.x0, area.y0, area.x1, area.y1).grown(-EDGE_PX), [], [])
        self._discs: list[Box] = []

    def avoid_disc(self, xy: XY, radius_m: float) -> None:
        """Avoid this disc."""
        size = 2.0 * self._px(radius_m)
        self._discs.append(Box.around(self._at(xy), size, size))
        self._page.marks.append(self._discs[-1])

    def avoid_body(self, xy: XY, radius_m: float, *, nose: float = 1.0) -> None:
        """Avoid this body, before everything else; `nose` is how far it reaches, in radii."""
        self.avoid_disc(xy, radius_m * nose)
        self._page.bodies.append((self._at(xy), self._px(radius_m)))

    def avoid_line(self, points: Sequence[XY]) -> None:
        """Avoid this wall or path."""
        self._page.lines.extend(self._along(points))

    def avoid_walls(self, place: Scene | PlaceMap) -> None:
        """Avoid the walls of a place, including the outer one."""
        for wall in place.walls:
            self.avoid_line([wall.start, wall.end])
        for outline in place.room.outlines:
            self.avoid_line([*outline, outline[0]])
        self._page.room = self._box(place.room.corners).grown(-WALL_PX)

    def avoid_circle(self, xy: XY, radius_m: float) -> None:
        """Avoid this circle around a point."""
        centre = Pose(*xy, 0.0)
        circle = [centre.ahead(radius_m, float(a)) for a in np.linspace(0.0, math.tau, 48)]
        self._page.marks.extend(self._along(circle))

    def avoid_outline(self, corners: Sequence[XY]) -> None:
        """Avoid this shape."""
        self._page.marks.append(self._box(corners))

    def place(self, place: Scene | PlaceMap, sizes: Sequence[float] = (NAME_PT,)) -> None:
        """Place the names of furniture, and of rooms if there are several.

        Names that fit into their piece come first. If many do not, all of those are left out.
        """
        others = [piece for piece in place.furniture if not self._inside(piece, sizes)]
        for piece in others:
            self.avoid_outline(piece.corners)
        for piece in others if len(others) <= MUCH else ():
            self._beside(piece)
        furniture = [self._box(piece.corners) for piece in place.furniture]
        for area in place.areas if len(place.areas) > 1 else ():
            self._area(area, furniture)

    def _inside(self, piece: Furniture, sizes: Sequence[float]) -> bool:
        """Write a piece's name in its middle; returns whether it fits and hides no one.

        Args:
            piece: The furniture.
            sizes: Font sizes [pt], the preferred one first.
        """
        from shapely import box

        outline, middle = self._outline(piece)
        left, bottom, right, top = outline.bounds
        longest, _ = self._size(max(piece.name.split(), key=len), min(sizes), "normal")
        if longest > max(right - left, top - bottom):  # no other size or shape will fit either
            return False
        texts = dict.fromkeys((piece.name, "\n".join(piece.name.split())))
        for points, text, turned in product(sizes, texts, (False, True)):
            width, height = self._size(text, points, "normal")
            inside = Box.around((middle.x, middle.y), *((height, width) if turned else (width, height)))
            room = inside.grown(2.0)
            hides = any(room.overlap(disc) for disc in self._discs)
            if not hides and outline.contains(box(room.left, room.bottom, room.right, room.top)):
                self._page.labels.append(inside)
                self._text(inside.centre, text, points, d.GREY, turned=turned)
                return True
        return False

    def _beside(self, piece: Furniture) -> None:
        """Write a piece's name next to it."""
        outline, middle = self._outline(piece)
        left, bottom, right, top = outline.bounds
        reach_m = min(right - left, top - bottom) / 2.0 / self._px(1.0)
        x, y = self._metres_to_px.inverted().transform((middle.x, middle.y)).tolist()
        self.near((x, y), reach_m, d.short(piece.name, NAME_CHARACTERS), size=NAME_PT, colour=d.GREY)

    def _outline(self, piece: Furniture) -> tuple[Polygon, Point]:
        """A piece's shape on the page, and the anchor of its name in it."""
        from shapely import Polygon

        outline = Polygon([self._at(corner) for corner in piece.corners])
        inside = outline.contains(outline.centroid)
        return outline, outline.centroid if inside else outline.representative_point()

    def _area(self, area: Area, furniture: Sequence[Box]) -> None:
        """Write a room's name in capitals, if there is space around the middle of the room."""
        from shapely import Polygon

        shape = Polygon(area.corners)
        middle = shape.centroid if shape.contains(shape.centroid) else shape.representative_point()
        words, walls = (
            d.short(area.name, NAME_CHARACTERS).upper(),
            self._along([*area.corners, area.corners[0]]),
        )
        at, size = self._at((middle.x, middle.y)), self._size(words, AREA_PT)
        box = self._page.place(at, 0.0, size, besides=[*furniture, *walls])
        self._text(box.centre, words, AREA_PT, d.GREY, "bold")

    def name(self, name: str, pose: Pose, radius_m: float, colour: str) -> Text:
        """Write a person's name, all of it, preferably behind their back; a line leads to a far one."""
        from matplotlib.lines import Line2D

        behind = pose.heading_rad + math.pi
        texts = dict.fromkeys(d.in_lines(name, characters) for characters in PERSON_CHARACTERS)
        shapes = [(text, self._size(text, PERSON_PT)) for text in texts]
        at, radius = self._at(pose.xy), self._px(radius_m)
        box, text = self._best(at, radius, shapes, behind)
        start = box.nearest(at)
        if math.dist(start, at) - radius > FAR_PX:
            leader = Line2D(*zip(start, at, strict=True), color=colour, lw=0.8, zorder=4.9)
            leader.set_transform(self._to_px.inverted())
            self.ax.add_artist(leader)
        return self._text(box.centre, text, PERSON_PT, colour, "bold")

    def near(
        self,
        xy: XY,
        reach_m: float,
        text: str,
        *,
        size: float,
        colour: str,
        weight: str = "normal",
        prefer_rad: float | None = None,
    ) -> Text:
        """Write a label next to an object with this extent around a point."""
        box = self._page.place(self._at(xy), self._px(reach_m), self._size(text, size), prefer_rad)
        return self._text(box.centre, text, size, colour, weight)

    def bubble(
        self, xy: XY, radius_m: float, deeds: Sequence[str], colour: str, *, besides: Sequence[Disc] = ()
    ) -> list[Artist]:
        """Speech and acts of a robot, in a bubble with a tail; the caller adds the artists.

        It lies on the page, and hides no one if there is space.

        Args:
            xy: Position of the robot [m].
            radius_m: Radius of its body [m].
            deeds: Lines, to be wrapped.
            colour: Colour of the addressee.
            besides: Bodies of the other people.
        """
        anchor, radius = self._at(xy), self._px(radius_m)
        bodies = [(self._at(other), self._px(other_m)) for other, other_m in besides]
        keep_off = [(anchor, RIM * radius), *bodies]
        box, text = self._best(anchor, radius + 8.0, self._wrapped(deeds), math.pi / 2.0, keep_off)
        parts = _bubble(box, anchor, radius, colour)
        for part in parts:
            part.set_transform(self._to_px.inverted())
        return [*parts, self._label(box.centre, text, 10.0, d.INK, "normal")]

    def _best(
        self,
        anchor: XY,
        radius: float,
        shapes: Sequence[tuple[str, XY]],
        prefer_rad: float,
        keep_off: Sequence[Disc] | None = None,
    ) -> tuple[Box, str]:
        """The best place and shape of a text, by its shapes with their sizes [px], the widest first."""
        found = []
        for narrower, (text, size) in enumerate(shapes):
            (hides, cost), box = self._page.best(anchor, radius, size, prefer_rad, keep_off=keep_off)
            found.append(((hides, cost + NARROWER * narrower), narrower, box, text))
        *_, box, text = min(found)
        self._page.labels.append(box)
        return box, text

    def _wrapped(self, deeds: Sequence[str]) -> list[tuple[str, XY]]:
        """The wrapped text of a bubble in several widths, each with its size [px]; none wider than the page.

        The narrowest is included even if it is wider.
        """
        widest = self._page.area.right - self._page.area.left
        texts = []
        for characters in BUBBLE_CHARACTERS:
            lines = [line for deed in deeds for line in textwrap.wrap(deed, characters)]
            texts.append("\n".join(lines if len(lines) <= MOST_LINES else [*lines[: MOST_LINES - 1], "…"]))
        sizes = {text: self._size(text, 10.0) for text in texts}
        bubbles = [(text, (width + 18.0, height + 14.0)) for text, (width, height) in sizes.items()]
        return [one for one in bubbles if one[1][0] <= widest] or bubbles[-1:]

    def forget_bubble(self) -> None:
        """Release the place of the latest label, which is not shown together with the next."""
        self._page.labels.pop()

    def _text(
        self, at: XY, text: str, size: float, colour: str, weight: str = "normal", *, turned: bool = False
    ) -> Text:
        from matplotlib.patheffects import withStroke

        label = self._label(at, text, size, colour, weight)
        label.set_rotation(90.0 if turned else 0.0)
        label.set_path_effects([withStroke(linewidth=3.0, foreground=d.HALO)])
        self.ax.add_artist(label)
        return label

    def _label(self, at: XY, text: str, size: float, colour: str, weight: str) -> Text:
        from matplotlib.text import Text

        label = Text(*at, text, size=size, color=colour, weight=weight, ha="center", va="center", zorder=11)
        label.set_linespacing(LINE_SPACING)
        label.set_transform(self._to_px.inverted())
        return label

    def _size(self, text: str, size: float, weight: str = "bold") -> XY:
        label = self._label((0.0, 0.0), text, size, d.INK, weight)
        label.set_figure(self.ax.figure)
        extent = label.get_window_extent(self._renderer).transformed(self._to_px)
        return (extent.width, extent.height)

    def _along(self, points: Sequence[XY]) -> list[Box]:
        """Boxes along a line."""
        at = np.array([self._at(point) for point in points])
        legs = np.hypot(*np.diff(at, axis=0).T)
        way = np.concatenate([[0.0], np.cumsum(legs)])
        steps = np.arange(0.0, float(way[-1]) + 1e-9, 4.0 * LINE_PX)
        places = zip(
            np.interp(steps, way, at[:, 0]).tolist(), np.interp(steps, way, at[:, 1]).tolist(), strict=True
        )
        return [Box.around(place, 2.0 * LINE_PX, 2.0 * LINE_PX) for place in places]

    def _box(self, corners: Sequence[XY]) -> Box:
        """Bounding box of a shape."""
        at = np.array([self._at(corner) for corner in corners])
        (left, bottom), (right, top) = at.min(axis=0).tolist(), at.max(axis=0).tolist()
        return Box(left, bottom, right, top)

    def _at(self, xy: XY) -> XY:
        x, y = self._metres_to_px.transform(xy).tolist()
        return (x, y)

    def _px(self, metres: float) -> float:
        return self._at((metres, 0.0))[0] - self._at((0.0, 0.0))[0]


def _bubble(box: Box, anchor: XY, radius: float, colour: str) -> list[Artist]:
    """The tail, which points from the box to the rim of a disc, and the box itself, in pixels."""
    from matplotlib.patches import FancyBboxPatch, Polygon

    along = direction_to(box.centre, anchor)
    gap = math.dist(box.centre, anchor) - radius - 3.0
    tip = (box.centre[0] + gap * math.cos(along), box.centre[1] + gap * math.sin(along))
    side = (-math.sin(along) * 7.0, math.cos(along) * 7.0)
    foot = [(box.centre[0] + s * side[0], box.centre[1] + s * side[1]) for s in (1, -1)]
    tail = Polygon([*foot, tip], closed=True, fc=colour, ec="none", zorder=9.5)
    inner = box.grown(-4.0)
    body = FancyBboxPatch(
        (inner.left, inner.bottom), inner.right - inner.left, inner.top - inner.bottom,
        boxstyle="round,pad=4,rounding_size=7", fc="#FFFFFF", ec=colour, lw=1.5, zorder=9.6,
    )  # fmt: skip
    return [tail, body]
