"""A picture of a map: rooms, doors, furniture and named places, and the people of a scene."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from itertools import pairwise
from textwrap import wrap
from types import MappingProxyType
from typing import TYPE_CHECKING

import numpy as np

from comity_sim2d.pictures import drawing as d
from comity_sim2d.pictures.door_drawing import leaf, swing
from comity_sim2d.pictures.map_labels import NAME_CHARACTERS, MapLabels
from comity_sim2d.pictures.page import DPI, POINTS_PER_IN, as_bytes, in_per_m, own_page
from comity_sim2d.pictures.person_colours import person_colour
from comity_sim2d.pictures.readable_names import legible, names_in, substitutes, with_names
from comity_sim2d.pose import XY, Pose
from comity_sim2d.scene.footpath import Footpaths
from comity_sim2d.scene.obstacles import floor_plan
from comity_sim2d.scene.person import Person
from comity_sim2d.scene.placing import place as placed
from comity_sim2d.scene.scene import Scene

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.patches import Patch

    from comity_sim2d.maps.place_map import PlaceMap
    from comity_sim2d.scene.area import Location
    from comity_sim2d.scene.walk import Walk

EDGE_IN, HEADER_IN, LINE_IN, SCALE_IN = 0.25, 0.58, 0.17, 0.45
"""Margin, height of the headline, of each line below it, and of the scale bar [in]."""
LEAST_IN, MOST_IN = 4.5, 18.0
"""Minimum width of a map, unless it is high, and maximum length of its longer side [in]."""
LEAST_WORDS_IN, LEAST_NAMES_IN = 3.0, 2.2
"""Minimum width of the text above a map and of the space for the names on it, and its minimum height [in]."""
IN_PER_M = 1.0
"""Default scale [in/m], at which labels fit, unless the page would be too small or too large."""
FURNITURE_PT = (9.0, 8.0, 7.0, 6.0)
MOST_CHARACTERS, MOST_LINES = 400, 8
"""Maximum number of characters of a headline, and of lines below it, on a narrow page as many letters."""
SMALL_PT, LETTER = 9.5, 0.62
"""Font size of the lines below the headline [pt], and width of a letter relative to it: wide ones are
rare."""
ORIGIN_M = 0.5
"""Length of the axes at the origin [m]."""
X_AXIS, Y_AXIS = "#B3261E", "#1B7F3B"
"""Colours of the axes: red and green, as in ROS tools."""
SPOT = "#0B6E6E"
SPOT_M, TICK_M = 0.06, 0.3
NO_RINGS: Mapping[str, float] = MappingProxyType({})


def draw_map(
    place: Scene | PlaceMap,
    *,
    title: str = "",
    subtitle: str = "",
    rings: Mapping[str, float] = NO_RINGS,
    seed: int = 0,
    format: str = "png",  # noqa: A002  (the word for it)
) -> bytes:
    """A picture of a place. The same arguments give the same bytes, on the same version of matplotlib.

    Args:
        place: A map, or a scene with its people and the robot at its start.
        title: The headline.
        subtitle: Text below the headline.
        rings: Distances that people like, between the nearest points of the bodies, by name [m].
        seed: Seed of the run, which determines where passers-by start.
        format: `png`, `svg` or `pdf`.
    """
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    if names := substitutes(place):
        rings = {names.get(name, name): distance_m for name, distance_m in rings.items()}
        place = with_names(place, names)
    title, subtitle = legible(title, names), legible(subtitle, names)
    wide, high = d.extent_m(place)
    scale = in_per_m((wide, high), IN_PER_M, least_in=LEAST_IN, most_in=MOST_IN)
    width = max(wide * scale, LEAST_WORDS_IN) + 2 * EDGE_IN
    beside_m = (width - 2 * EDGE_IN) / scale / 2 - wide / 2
    lines = _lines(subtitle, width - 2 * EDGE_IN)
    height = max(high * scale, LEAST_NAMES_IN)
    above_m = height / scale / 2 - high / 2
    size = (width, height + HEADER_IN + LINE_IN * len(lines) + SCALE_IN)
    with own_page([*names_in(place), title, subtitle]):
        figure = Figure(figsize=size, dpi=DPI[format], facecolor="#FFFFFF")
        canvas = FigureCanvasAgg(figure)
        area = (EDGE_IN / size[0], SCALE_IN / size[1], 1 - 2 * EDGE_IN / size[0])
        ax = figure.add_axes((*area, height / size[1]))
        _write_frame(canvas, title, lines, scale)
        floor = d.draw_place(ax, place, beside_m, above_m)
        _draw(floor, MapLabels(ax, canvas), place, rings, seed)
        return as_bytes(figure, format)


def _lines(text: str, width_in: float) -> list[str]:
    """The text below the headline, wrapped to the width of the page; the last line is cut."""
    room = max(int(width_in * POINTS_PER_IN / (SMALL_PT * LETTER)), 1)
    most = math.ceil(MOST_LINES * max(LEAST_IN / width_in, 1.0))
    return wrap(" ".join(text[: room * most * 2].split()), room, max_lines=most, placeholder=" …")


def _draw(
    floor: Patch, labels: MapLabels, place: Scene | PlaceMap, rings: Mapping[str, float], seed: int
) -> None:
    ax = labels.ax
    if isinstance(place, Scene):
        d.draw_o_spaces(ax, place.o_spaces, floor)
    for location in place.locations:
        _draw_location(ax, location)
    if isinstance(place, Scene):
        _draw_on_foot(ax, place, seed, labels)
        _draw_bodies(ax, place, rings, floor)
    _mark(labels, place)
    labels.place(place, FURNITURE_PT)
    if not isinstance(place, Scene):
        _draw_origin(ax, labels)
    else:
        for i, person in enumerate(place.people):
            labels.name(person.name, person.pose, person.radius_m, person_colour(i).on_light)
        labels.near(place.robot.pose.xy, place.robot.radius_m, place.robot.name, size=9.5, colour=d.INK)
    for location in place.locations:
        facing = location.heading_rad
        prefer = None if facing is None else facing + math.pi
        name = d.in_lines(location.name, NAME_CHARACTERS)
        labels.near(location.xy, SPOT_M, name, size=8.0, colour=SPOT, prefer_rad=prefer)


def _draw_origin(ax: Axes, labels: MapLabels) -> None:
    """Draw the axes at the origin of the coordinates, if it is on the map."""
    from matplotlib.patheffects import withStroke

    (left, right), (bottom, top) = ax.get_xlim(), ax.get_ylim()
    if not (left <= 0.0 <= right and bottom <= 0.0 <= top):
        return
    for tip, colour in (((ORIGIN_M, 0.0), X_AXIS), ((0.0, ORIGIN_M), Y_AXIS)):
        arrow = {"arrowstyle": "-|>", "color": colour, "lw": 1.6, "shrinkA": 0, "shrinkB": 0}
        arrow["path_effects"] = [withStroke(linewidth=4.0, foreground=d.HALO)]
        ax.annotate("", tip, (0.0, 0.0), arrowprops=arrow, annotation_clip=False, zorder=7)
        labels.avoid_line([(0.0, 0.0), tip])
    ax.plot(0.0, 0.0, marker="o", ms=4.0, color=d.INK, zorder=7.1)
    labels.near((0.0, 0.0), SPOT_M, "0, 0", size=8.0, colour=d.INK, prefer_rad=math.radians(45.0))


def _draw_location(ax: Axes, location: Location) -> None:
    """Draw a dot with a line in the direction that one faces."""
    ax.plot(*zip(location.xy, _tip(location), strict=True), color=SPOT, lw=1.6, zorder=4.1)
    ax.plot(*location.xy, marker="o", ms=5.0, mfc="#FFFFFF", mec=SPOT, mew=1.6, zorder=4.2)


def _tip(location: Location) -> XY:
    """End of the line of a location; the dot itself if the heading is free."""
    if location.heading_rad is None:
        return (location.x_m + SPOT_M, location.y_m)
    return Pose(*location.xy, location.heading_rad).ahead(TICK_M)


def _draw_bodies(ax: Axes, scene: Scene, rings: Mapping[str, float], floor: Patch) -> None:
    for i, person in enumerate(scene.people):
        d.add_all(ax, d.person_artists(person.pose, person.radius_m, person_colour(i).on_light))
        if person.name in rings:
            reach = person.radius_m + rings[person.name]
            ring = d.dashed_circle(person.xy, reach, person_colour(i).on_light)
            ax.add_patch(ring)
            ring.set_clip_path(floor)
    d.add_all(ax, d.robot_artists(scene.robot.pose, scene.robot.radius_m))


def _draw_on_foot(ax: Axes, scene: Scene, seed: int, labels: MapLabels) -> None:
    """Draw the paths of people who walk, and the passers-by at their start, not hidden by names."""
    for i, person in enumerate(scene.people):
        if person.walk is not None:
            d.draw_track(ax, np.array(_way(scene, person, person.walk)), person_colour(i).on_light)
    if scene.passers_by is not None:
        for one in placed(scene, seed):
            towards = one.stops[0] - one.at
            pose = Pose(one.at.real, one.at.imag, math.atan2(towards.imag, towards.real))
            d.add_all(ax, d.person_artists(pose, scene.passers_by.radius_m, d.FAINT))
            labels.avoid_body(pose.xy, scene.passers_by.radius_m, nose=d.NOSE)


def _way(scene: Scene, person: Person, walk: Walk) -> list[XY]:
    """Corner points of a person's walk, one round if it is a loop."""
    paths = Footpaths(floor_plan(scene), person.radius_m)
    stops = [person.xy, *walk.route, *(walk.route[:1] if walk.loop else ())]
    legs = (paths.between(one, other) or [other] for one, other in pairwise(stops))
    return [person.xy, *(point for leg in legs for point in leg)]


def _mark(labels: MapLabels, place: Scene | PlaceMap) -> None:
    """Mark what labels should not hide."""
    labels.avoid_walls(place)
    for piece in place.furniture:
        labels.avoid_outline(piece.corners)
    for door in place.doors:
        labels.avoid_line([door.start, door.end])
        for line in filter(None, (leaf(door), swing(door))):
            labels.avoid_line(line)
    for location in place.locations:
        labels.avoid_line([location.xy, _tip(location)])
        labels.avoid_circle(location.xy, 2.0 * SPOT_M)
    if isinstance(place, Scene):
        for person in place.people:
            labels.avoid_body(person.xy, person.radius_m, nose=d.NOSE)
        labels.avoid_body(place.robot.pose.xy, place.robot.radius_m)


def _write_frame(canvas: FigureCanvasAgg, title: str, lines: Sequence[str], in_per_m: float) -> None:
    """Write the headline, the text below it, and a scale bar."""
    figure = canvas.figure
    width, height = figure.get_size_inches().tolist()
    left, head = EDGE_IN / width, d.short(" ".join(title.split()), MOST_CHARACTERS)
    below = [
        figure.text(left, 1 - (0.54 + LINE_IN * i) / height, line, size=SMALL_PT, color=d.GREY, va="center")
        for i, line in enumerate(lines)
    ]
    headline = figure.text(left, 1 - 0.28 / height, head, size=15, weight="bold", color=d.INK, va="center")
    for label in (headline, *below):
        d.fitting(label, figure.bbox.width * (1 - 2 * left), canvas)
    d.draw_scale_bar(figure, EDGE_IN, 0.2, in_per_m)
