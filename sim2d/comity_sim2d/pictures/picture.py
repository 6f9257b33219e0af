"""One picture of an episode: the map with the robot's path, and each visit's target and actual distance."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from comity_fis.proxemics import FRONT_DEG, WIDEST_DEG
from comity_sim2d.frames import Frames
from comity_sim2d.kinds import require_kinds
from comity_sim2d.metrics import clearances_m, measure
from comity_sim2d.navigation.pose_choice import side_name
from comity_sim2d.pictures import drawing as d
from comity_sim2d.pictures import panel
from comity_sim2d.pictures.cards import cards, reached_s
from comity_sim2d.pictures.drawing_check import check_drawing
from comity_sim2d.pictures.episode_layout import EDGE_IN, SCALE_IN, Layout, layout
from comity_sim2d.pictures.label_placement import Disc
from comity_sim2d.pictures.legend import Legend
from comity_sim2d.pictures.map_labels import MapLabels
from comity_sim2d.pictures.page import DPI, FORMS, as_bytes, own_page
from comity_sim2d.pictures.panel import Card
from comity_sim2d.pictures.person_colours import person_colours
from comity_sim2d.pictures.planned_route import PlannedRoute, draw_planned
from comity_sim2d.pictures.readable_names import legible, readable
from comity_sim2d.pictures.ring import Ring
from comity_sim2d.pictures.sayings import TOGETHER_M, Saying, sayings
from comity_sim2d.pictures.turning_doors import doors_at
from comity_sim2d.pose import XY, Pose, direction_to
from comity_sim2d.robot.acts import ActEvent

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure
    from matplotlib.patches import Patch

    from comity_sim2d.maps.doorways import DoorTurn
    from comity_sim2d.paths.personal_space import Points
    from comity_sim2d.scene.scene import Scene

__all__ = ["Ring", "draw_picture"]

SUFFIXES = tuple(f".{form}" for form in FORMS)
ARROWS_EVERY_M = 0.9
LEAST_IN_PER_M = 0.8
"""Scale below which arrows are drawn larger than to scale [in/m]."""
MARK_M = 0.06
"""Radius around a small mark that labels avoid [m]."""
WAY_DARK, WAY_FADED = 0.85, 0.58
"""Shade of the newest piece of the driven path, and the share of it for the oldest.

The oldest has a contrast of 3 with the floor (WCAG 2.2, criterion 1.4.11).
"""
SAME_M = 0.02
"""If two places are nearer than this [m], only one is drawn."""


def draw_picture(
    path: str | Path,
    scene: Scene,
    frames: Frames,
    *,
    rings: Sequence[Ring] = (),
    events: Sequence[ActEvent] = (),
    door_turns: Sequence[DoorTurn] = (),
    planned: Sequence[PlannedRoute] = (),
    title: str = "",
    subtitle: str | None = None,
    width_px: int = 1200,
) -> None:
    """Write a PNG, SVG or PDF. The same arguments give the same bytes, on the same version of matplotlib.

    Args:
        path: Where to write; it ends with `.png`, `.svg` or `.pdf`.
        scene: The place and the bodies.
        frames: Frames of the episode.
        rings: One for each visited person, in the order of the visits.
        events: Speech and acts.
        door_turns: Doors that were opened or shut: all are drawn in their final state.
        planned: The routes of the plans, drawn below the driven path.
        title: The headline.
        subtitle: Text below the headline; None: duration, path length and smallest distance to people.
        width_px: Width of a PNG, in [100, 10000]: everything scales with it.

    Raises:
        SceneError: For another file type, or an invalid width.
        ValueError: For a ring of a person who is not in the scene.
    """
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    check_drawing(
        "picture",
        path,
        SUFFIXES,
        scene,
        frames,
        rings=rings,
        events=events,
        door_turns=door_turns,
        planned=planned,
        width_px=width_px,
    )
    require_kinds("picture", title=(title, str), subtitle=(subtitle, str | None))
    scene = replace(scene, doors=doors_at(scene.doors, door_turns, float(frames.time_s[-1])))
    shown = readable(scene, frames, rings, events)
    scene, frames, title = shown.scene, shown.frames, legible(title, shown.names)
    subtitle = None if subtitle is None else legible(subtitle, shown.names)
    routes = tuple(route.points for route in planned if route.points)
    picture = _Picture(scene, frames, shown.rings, shown.events, routes)
    cards = picture.cards()
    page = layout(scene, cards, picture.legend())
    form = Path(path).suffix.lower().removeprefix(".")
    dpi = width_px / page.width if form == "png" else DPI[form]
    with own_page([*shown.words, title, subtitle or ""]):
        figure = Figure(figsize=(page.width, page.height), dpi=dpi, facecolor="#FFFFFF")
        canvas = FigureCanvasAgg(figure)
        _draw_header(figure, canvas, title, _facts(frames) if subtitle is None else subtitle)
        longest_m = max((card.longest_m for card in cards), default=0.0)
        for place, column in page.columns:
            panel.draw_column(_axes(figure, place), column, longest_m)
        picture.draw_map(MapLabels(_axes(figure, page.map), canvas), page)
        d.draw_scale_bar(figure, page.map[0], page.map[1] - SCALE_IN / 2, page.in_per_m)
        Path(path).write_bytes(as_bytes(figure, form, dpi))


class _Picture:
    """State shared by all parts of one picture."""

    def __init__(
        self,
        scene: Scene,
        frames: Frames,
        rings: tuple[Ring, ...],
        events: tuple[ActEvent, ...],
        planned: tuple[tuple[XY, ...], ...],
    ) -> None:
        self._planned = planned
        self._scene, self._frames, self._rings, self._events = scene, frames, rings, events
        self._colours = person_colours([p.name for p in scene.people])
        self._robot, self._radius_m = scene.robot.name, scene.robot.radius_m
        self._end = d.pose_at(frames, self._robot)
        self._o_spaces = d.o_spaces_at(scene, frames)
        self._stands = {p.name: d.pose_at(frames, p.name) for p in scene.people}
        self._reached = {
            ring.person: d.pose_at(frames, self._robot, reached_s(ring, events))
            for ring in rings
            if ring.reached_m is not None
        }
        self._met = {
            ring.person: d.pose_at(frames, ring.person, reached_s(ring, events))
            if ring.person in self._reached
            else self._stands[ring.person]
            for ring in rings
        }

    def cards(self) -> list[Card]:
        """One card per visit."""
        return cards(self._scene, self._frames, self._rings, self._events)

    def legend(self) -> Legend:
        """The legend of what is on the map."""
        return Legend(
            planned=bool(self._planned),
            visits=bool(self._rings),
            walkers=bool(self._tracks),
            groups=bool(self._o_spaces),
            met=bool(self._met_elsewhere) or any(self._is_left(pose) for pose in self._reached.values()),
        )

    def draw_map(self, labels: MapLabels, page: Layout) -> None:
        """Draw the map with everything on it."""
        ax = labels.ax
        floor = d.draw_place(ax, self._scene, page.beside_m, page.above_m)
        d.draw_o_spaces(ax, self._o_spaces, floor)
        for name, points in self._tracks.items():
            d.draw_track(ax, points, self._colours.get(name, d.FAINT))
        for ring in self._rings:
            self._draw_ring(ax, ring, floor)
        self._draw_own_distances(ax, floor)
        for route in self._planned:
            draw_planned(ax, route)
        self._draw_way(ax, max(1.0, LEAST_IN_PER_M / page.in_per_m))
        for person in self._scene.people:
            pose, colour = self._stands[person.name], self._colours[person.name]
            d.add_all(ax, d.person_artists(pose, person.radius_m, colour))
        for name, radius_m in d.passers_by(self._scene):
            d.add_all(ax, d.person_artists(d.pose_at(self._frames, name), radius_m, d.FAINT))
        for name, pose in self._met_elsewhere.items():
            radius_m = self._scene.person(name).radius_m
            d.add_all(ax, d.person_artists(pose, radius_m, self._colours[name], ghost=True))
        for pose in self._reached.values():
            if self._is_left(pose):
                d.add_all(ax, d.robot_artists(pose, self._radius_m, ghost=True))
        d.add_all(ax, d.robot_artists(self._end, self._radius_m))
        self._mark(labels)
        self._write(labels)

    @property
    def _met_elsewhere(self) -> dict[str, Pose]:
        """Poses where the robot met people who have since moved, by name."""
        return {
            name: pose
            for name, pose in self._met.items()
            if math.dist(pose.xy, self._stands[name].xy) > SAME_M
        }

    def _is_left(self, pose: Pose) -> bool:
        """Whether the robot ends at another place than where it reached a person."""
        return math.dist(pose.xy, self._end.xy) > SAME_M

    def _draw_ring(self, ax: Axes, ring: Ring, floor: Patch) -> None:
        """Draw the chosen side as a sector, the target distance dashed, the actual one with a dot."""
        from matplotlib.patches import Wedge

        pose, colour = self._met[ring.person], self._colours[ring.person]
        radius = self._scene.person(ring.person).radius_m + ring.wanted_m
        low, high = (math.degrees(pose.heading_rad) + bearing for bearing in _side(ring.bearing_deg))
        sector = Wedge(pose.xy, radius, low, high, width=ring.wanted_m, fc=colour, alpha=0.16, zorder=2.5)
        for patch in (sector, d.dashed_circle(pose.xy, radius, colour)):
            ax.add_patch(patch)
            patch.set_clip_path(floor)
        if ring.person in self._reached:
            inner, outer = self._gap(ring)
            ax.plot(*zip(inner, outer, strict=True), color=colour, lw=2.4, solid_capstyle="butt", zorder=8.5)
            ax.plot(*outer, marker="o", ms=6.5, mfc=colour, mec="#FFFFFF", mew=1.2, zorder=9)

    @cached_property
    def _tracks(self) -> dict[str, Points]:
        """Paths of the people who walked, frame by frame."""
        names = [*self._colours, *(name for name, _ in d.passers_by(self._scene))]
        return {name: points for name in names if d.has_moved(points := self._frames.of(name))}

    @property
    def _people(self) -> list[Disc]:
        """Bodies of all people as drawn."""
        people = [(self._stands[person.name].xy, person.radius_m) for person in self._scene.people]
        people += [(pose.xy, self._scene.person(name).radius_m) for name, pose in self._met_elsewhere.items()]
        passing = d.passers_by(self._scene)
        return people + [(d.pose_at(self._frames, name).xy, radius_m) for name, radius_m in passing]

    def _draw_own_distances(self, ax: Axes, floor: Patch) -> None:
        """Draw the own distances, if known, of people who are only passed."""
        for name, radius_m in self._own_distances.items():
            circle = d.dashed_circle(self._stands[name].xy, radius_m, self._colours[name])
            ax.add_patch(circle)
            circle.set_clip_path(floor)

    @cached_property
    def _own_distances(self) -> dict[str, float]:
        """Radii of the rings of people who are only passed [m], by name."""
        visited = {ring.person for ring in self._rings}
        return {
            person.name: person.radius_m + person.personal_distance_m
            for person in self._scene.people
            if person.name not in visited and person.personal_distance_m is not None
        }

    def _draw_way(self, ax: Axes, size: float) -> None:
        """Draw the driven path; `size` scales its arrows, to be visible on a large map, too."""
        from matplotlib.patches import Polygon

        points = self._frames.of(self._robot)[:, :2]
        d.draw_faded(ax, points, d.ROBOT, dark=WAY_DARK, faded=WAY_FADED, width_pt=1.7, level=4.5)
        ax.plot(*points[0], marker="o", ms=7, mfc="#FFFFFF", mec=d.ROBOT, mew=1.7, zorder=6)
        for (x, y), (dx, dy) in d.marks_along(points, ARROWS_EVERY_M * size, 0.6 * size):
            tip, back = 0.09 * size, 0.06 * size
            corners = [(x + tip * dx, y + tip * dy)]
            corners += [(x - back * dx - s * back * dy, y - back * dy + s * back * dx) for s in (1, -1)]
            ax.add_patch(Polygon(corners, closed=True, fc=d.ROBOT, ec="#FFFFFF", lw=0.8, zorder=4.6))

    def _mark(self, labels: MapLabels) -> None:
        """Mark what labels should not hide."""
        for pose in (*self._reached.values(), self._end):
            labels.avoid_body(pose.xy, self._radius_m)
        for person in self._scene.people:
            labels.avoid_body(self._stands[person.name].xy, person.radius_m, nose=d.NOSE)
        for name, radius_m in d.passers_by(self._scene):
            labels.avoid_body(d.pose_at(self._frames, name).xy, radius_m, nose=d.NOSE)
        labels.avoid_line([(x, y) for x, y in self._frames.of(self._robot)[::8, :2].tolist()])
        for ring in self._rings:
            radius = self._scene.person(ring.person).radius_m + ring.wanted_m
            labels.avoid_circle(self._met[ring.person].xy, radius)
            if ring.person in self._reached:
                labels.avoid_line(self._gap(ring))
        for name, radius_m in self._own_distances.items():
            labels.avoid_circle(self._stands[name].xy, radius_m)
        for space in self._o_spaces:
            labels.avoid_disc(space.xy, space.radius_m)
        labels.avoid_walls(self._scene)
        for track in self._tracks.values():
            labels.avoid_line([(x, y) for x, y in track[::8, :2].tolist()])
        for route in self._planned:
            labels.avoid_line(route)

    def _write(self, labels: MapLabels) -> None:
        """Write the labels: those with a fixed place first."""
        labels.place(self._scene)
        for ring in self._rings:
            self._write_distance(labels, ring)
        for saying in sayings(self._frames, self._robot, self._events):
            self._write_saying(labels, saying)
        for person in self._scene.people:
            pose, colour = self._stands[person.name], self._colours[person.name]
            labels.name(person.name, pose, person.radius_m, colour)
        x, y = self._frames.of(self._robot)[0, :2].tolist()
        labels.near((x, y), MARK_M, "start", size=9.0, colour=d.INK)

    def _write_saying(self, labels: MapLabels, saying: Saying) -> None:
        """Draw a bubble at the robot if it is drawn there, else at a mark on its path."""
        drawn = (*self._reached.values(), self._end)
        robot = min(drawn, key=lambda pose: math.dist(pose.xy, saying.xy))
        is_drawn = math.dist(robot.xy, saying.xy) <= TOGETHER_M
        at, radius_m = (robot.xy, self._radius_m) if is_drawn else (saying.xy, MARK_M)
        if not is_drawn:
            labels.ax.plot(*at, marker="o", ms=5, mfc="#FFFFFF", mec=d.ROBOT, mew=1.4, zorder=6)
        colour = self._colours.get(saying.person, d.GREY)
        d.add_all(labels.ax, labels.bubble(at, radius_m, saying.lines, colour, besides=self._people))

    def _write_distance(self, labels: MapLabels, ring: Ring) -> None:
        """Write target and actual distance next to the line between the two."""
        wanted, colour = f"target {ring.wanted_m:.3f} m", self._colours[ring.person]
        if ring.reached_m is None or ring.person not in self._reached:
            pose, radius = self._stands[ring.person], self._scene.person(ring.person).radius_m
            text = f"{wanted}\nnot reached"
            labels.near(pose.xy, radius, text, size=9.5, colour=colour, prefer_rad=pose.heading_rad)
            return
        (ax, ay), (bx, by) = self._gap(ring)
        middle, text = ((ax + bx) / 2, (ay + by) / 2), f"actual {ring.reached_m:.3f} m\n{wanted}"
        labels.near(middle, MARK_M, text, size=9.5, colour=colour, weight="bold")

    def _gap(self, ring: Ring) -> tuple[XY, XY]:
        """The nearest points of the person and of the robot next to them [m]."""
        person, robot = self._met[ring.person], self._reached[ring.person]
        towards = Pose(*person.xy, direction_to(person.xy, robot.xy))
        near = self._scene.person(ring.person).radius_m
        return towards.ahead(near), towards.ahead(math.dist(person.xy, robot.xy) - self._radius_m)


def _draw_header(figure: Figure, canvas: FigureCanvasAgg, title: str, subtitle: str) -> None:
    height, left = figure.get_figheight(), EDGE_IN / figure.get_figwidth()
    label = figure.text(left, 1 - 0.40 / height, title, size=17, weight="bold", color=d.INK, va="center")
    d.fitting(label, figure.bbox.width * (1 - 2 * left), canvas)
    figure.text(left, 1 - 0.70 / height, subtitle, size=10.5, color=d.GREY, va="center")


def _axes(figure: Figure, inches: tuple[float, float, float, float]) -> Axes:
    """Axes by left, bottom, width and height in inches."""
    wide, high = figure.get_figwidth(), figure.get_figheight()
    left, bottom, width, height = inches
    return figure.add_axes((left / wide, bottom / high, width / wide, height / high))


def _facts(frames: Frames) -> str:
    m = measure(frames)
    return f"{m.duration_s:.1f} s, {m.path_length_m:.2f} m travelled{_nearest(frames)}"


def _nearest(frames: Frames) -> str:
    """The smallest distance to people, and whom the robot touched first, in words."""
    gaps = clearances_m(frames)
    if not gaps.size:
        return ""
    if gaps.min() > 0.0:
        return f", never nearer than {gaps.min():.2f} m to anyone"
    row, column = np.argwhere(gaps <= 0.0)[0]
    return f", touched {frames.entities[1 + column]} at t={frames.time_s[row]:.2f} s"


def _side(bearing_deg: float) -> XY:
    """The range of bearings of the side of a bearing [deg], as the planner divides them."""
    side = side_name(bearing_deg)
    if side == "front":
        return (-FRONT_DEG, FRONT_DEG)
    return (FRONT_DEG, WIDEST_DEG) if side == "left" else (-WIDEST_DEG, -FRONT_DEG)
