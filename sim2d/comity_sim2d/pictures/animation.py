"""An episode as a GIF: the moving robot, with its speech and acts while they happen.

The static background is drawn once, and again when the o-space of a group changes. Every frame restores it,
draws the moving parts on top, and is mapped to one palette for all frames.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Iterator, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
from numpy.typing import NDArray

from comity_sim2d.frames import Frames
from comity_sim2d.kinds import require_kinds
from comity_sim2d.pictures import drawing as d
from comity_sim2d.pictures.drawing_check import check_drawing
from comity_sim2d.pictures.lettering import lettering
from comity_sim2d.pictures.map_labels import NAME_CHARACTERS, MapLabels
from comity_sim2d.pictures.moving_rings import MovingRings, ReachedLines, wanted_m
from comity_sim2d.pictures.person_colours import person_colours
from comity_sim2d.pictures.planned_route import PlannedRoute, draw_planned, planned_at
from comity_sim2d.pictures.readable_names import legible, readable
from comity_sim2d.pictures.ring import Ring
from comity_sim2d.pictures.speech import Speech
from comity_sim2d.pictures.turning_doors import TurningDoors
from comity_sim2d.pose import Pose
from comity_sim2d.robot.acts import ActEvent
from comity_sim2d.scene_error import require_between, require_whole

if TYPE_CHECKING:
    from matplotlib.artist import Artist
    from matplotlib.axes import Axes
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.patches import Patch
    from matplotlib.text import Text

    from comity_sim2d.maps.doorways import DoorTurn
    from comity_sim2d.scene.o_space import OSpace
    from comity_sim2d.scene.person import Person
    from comity_sim2d.scene.scene import Scene

REAL_TIME_S, LONGEST_S = 15.0, 60.0
"""Episodes longer than `REAL_TIME_S` [s] play at double speed; none plays for longer than `LONGEST_S` [s],
since every image is held in memory until it is written (our choice)."""
FPS, SPEED = (1, 100), (0.01, 1000.0)
"""Allowed ranges of frame rate [1/s] and speed: a GIF counts in hundredths of a second (the others are our
choice)."""
LAST_FRAME_S = 2.5
"""Duration of the last frame before the GIF repeats [s]."""
HEADER_IN, FOOT_IN, EDGE_IN, DPI = 0.5, 0.3, 0.1, 100.0
TALLEST_IN = 7.0
CLOCK_PX = 130.0
"""Width of the clock in the top line [px]; the headline has the rest."""
NAME_BELOW = 1.6
"""Distance of a moving person's name below them, in radii."""
MARK = b"Comity"
"""Comment near the start of the file that marks it as ours."""
COLOURS = 64
SAMPLES = 8
"""Number of shots from which the palette is computed."""
BITS = 5
"""Bits of each colour channel that select the palette's entry."""


def write_gif(
    path: str | Path,
    scene: Scene,
    frames: Frames,
    *,
    rings: Sequence[Ring] = (),
    events: Sequence[ActEvent] = (),
    door_turns: Sequence[DoorTurn] = (),
    planned: Sequence[PlannedRoute] = (),
    title: str = "",
    ending: str | None = None,
    fps: int = 10,
    speed: float | None = None,
    width_px: int = 720,
) -> None:
    """Write an animated GIF. The same arguments give the same bytes, on the same matplotlib and Pillow.

    Args:
        path: Where to write; it ends with `.gif`.
        scene: The place and the bodies.
        frames: Frames of the episode.
        rings: One for each visited person: the target distance moves with them, and the actual one shows from
            docking until the last act towards them.
        events: Speech and acts, shown while they happen.
        door_turns: Doors that were opened or shut, shown in their current state.
        planned: The routes of the plans, each shown while its plan is in force.
        title: The headline.
        ending: Headline of the last frame, such as one with the outcome; None: the same.
        fps: Frames per second of playing time, in [1, 100].
        speed: Simulated seconds per second of playing, in [0.01, 1000]; None: 1, 2 for episodes
            longer than 15 s, or as much as leaves a minute of playing.
        width_px: Width of the image, in [100, 10000]; less if the room is narrow.

    Raises:
        SceneError: For another file type, or an invalid width, rate or speed.
        ValueError: For a ring of a person who is not in the scene.
    """
    check_drawing(
        "animation",
        path,
        (".gif",),
        scene,
        frames,
        rings=rings,
        events=events,
        door_turns=door_turns,
        planned=planned,
        width_px=width_px,
    )
    require_kinds("animation", title=(title, str), ending=(ending, str | None))
    require_whole("animation", "fps", fps, *FPS)
    if speed is not None:
        require_between("animation", "speed", speed, *SPEED)
    length = float(frames.time_s[-1])
    speed = _speed(length) if speed is None else speed
    times = [*np.arange(0.0, length, speed / fps).tolist(), length]
    samples = np.linspace(0, len(times) - 1, SAMPLES).astype(int)
    shown = readable(scene, frames, rings, events)
    scene, frames, title = shown.scene, shown.frames, legible(title, shown.names)
    ending = None if ending is None else legible(ending, shown.names)
    with lettering([*shown.words, title, ending or ""]):
        doors = TurningDoors(scene.doors, door_turns)
        film = _Film(
            scene,
            frames,
            shown.rings,
            shown.events,
            doors,
            planned=planned,
            titles=(title, title if ending is None else ending),
            speed=speed,
            width_px=width_px,
        )
        palette = _palette([film.shot(times[i]).copy() for i in samples])
        table = _nearest_entry(palette)
        shots = (table[_coarse(film.shot(t))] for t in times)
        milliseconds = [round(1000 / fps)] * (len(times) - 1) + [round(1000 * LAST_FRAME_S)]
        _save(Path(path), shots, palette, milliseconds)


def _speed(length_s: float) -> float:
    """Simulated seconds per second of playing."""
    return 1.0 if length_s <= REAL_TIME_S else float(max(2, math.ceil(length_s / LONGEST_S)))


class _Film:
    """A canvas with the place, and the artists that move."""

    def __init__(
        self,
        scene: Scene,
        frames: Frames,
        rings: tuple[Ring, ...],
        events: tuple[ActEvent, ...],
        doors: TurningDoors,
        *,
        planned: Sequence[PlannedRoute],
        titles: tuple[str, str],
        speed: float,
        width_px: int,
    ) -> None:
        self._scene, self._frames, self._speed, self._doors = scene, frames, speed, doors
        self._colours = person_colours([p.name for p in scene.people])
        self._canvas: Any  # matplotlib's drawing calls carry no types
        self._canvas, self._ax = _canvas(scene, width_px)
        moves = {p.name: bool(np.ptp(frames.of(p.name), axis=0).any()) for p in scene.people}
        still = [p for p in scene.people if not moves[p.name]]
        floor = self._draw_background(rings, still)
        self._still = _StillPart(self._canvas, self._ax, floor)
        self._animated(doors.artists)
        moving = self._wanted(rings, [p for p in scene.people if moves[p.name]])
        self._rings = MovingRings(self._ax, floor, frames, moving)
        self._reached = ReachedLines(self._ax, scene, frames, rings, events=events, colours=self._colours)
        labels = MapLabels(self._ax, self._canvas)
        self._standing = self._write(labels, rings, still)
        self._speech = Speech(labels, scene, frames, events, self._colours)
        self._animated(self._speech.artists)
        self._bodies = [self._body(p.name, p.radius_m) for p in scene.people if moves[p.name]]
        self._bodies += [self._body(name, radius_m) for name, radius_m in d.passers_by(scene)]
        self._bodies.append(self._body(scene.robot.name, scene.robot.radius_m))
        self._planned = planned
        self._route = draw_planned(self._ax, ())
        self._route.set_animated(True)
        (self._trail,) = self._ax.plot([], [], color=d.ROBOT, lw=1.7, alpha=0.75, animated=True)
        self._names = {p.name: self._name(p) for p in scene.people if moves[p.name]}
        self._clock, self._title = self._header(0.985, "right"), self._header(0.015, "left")
        self._title.set_fontweight("bold")
        self._titles = [self._fitting(title) for title in titles]

    def shot(self, time_s: float) -> NDArray[np.uint8]:
        """The image at a moment: RGBA, shape (height, width, 4), valid until the next shot."""
        self._still.restore(d.o_spaces_at(self._scene, self._frames, time_s))
        self._move(time_s)
        renderer = self._canvas.get_renderer()
        bodies = [part for _, parts in self._bodies for part in parts]
        for artist in (
            *self._doors.at(time_s),
            *self._rings.at(time_s),
            self._route,
            self._trail,
            *bodies,
            *self._reached.at(time_s),
            *self._standing,
            *self._names.values(),
            *self._speech.at(time_s),
            self._clock,
            self._title,
        ):
            artist.draw(renderer)
        return np.asarray(self._canvas.buffer_rgba())

    def _move(self, time_s: float) -> None:
        from matplotlib.transforms import Affine2D

        for name, parts in self._bodies:
            pose = d.pose_at(self._frames, name, time_s)
            place = Affine2D().rotate(pose.heading_rad).translate(*pose.xy) + self._ax.transData
            for part in parts:
                part.set_transform(place)
        count = int(np.searchsorted(self._frames.time_s, time_s + 1e-9))
        way = self._frames.of(self._scene.robot.name)[:count]
        self._trail.set_data(way[:, 0], way[:, 1])
        route = np.array(planned_at(self._planned, time_s), dtype=float).reshape(-1, 2)
        self._route.set_data(route[:, 0], route[:, 1])
        fast = "" if self._speed == 1.0 else f"   {self._speed:g}x"
        self._clock.set_text(f"{time_s:.1f} s{fast}")
        self._title.set_text(self._titles[time_s >= float(self._frames.time_s[-1])])
        for name, label in self._names.items():
            pose = d.pose_at(self._frames, name, time_s)
            label.set_position((pose.x_m, pose.y_m - NAME_BELOW * self._scene.person(name).radius_m))

    def _wanted(
        self, rings: Sequence[Ring], people: Collection[Person]
    ) -> Iterator[tuple[Person, float, str]]:
        """People whose preferred distance is known, with that distance [m] and their colour."""
        for person in self._scene.people:
            distance_m = wanted_m(person, rings)
            if person in people and distance_m is not None:
                yield person, distance_m, self._colours[person.name]

    def _draw_background(self, rings: Sequence[Ring], people: Sequence[Person]) -> Patch:
        """Draw the static background; returns the floor, for clipping."""
        resting = replace(self._scene, doors=self._doors.resting)
        floor = d.draw_place(self._ax, resting, d.beside_m(self._scene), d.above_m(self._scene))
        for person, distance_m, colour in self._wanted(rings, people):
            circle = d.dashed_circle(person.xy, person.radius_m + distance_m, colour)
            self._ax.add_patch(circle)
            circle.set_clip_path(floor)
        for person in people:
            d.add_all(self._ax, d.person_artists(person.pose, person.radius_m, self._colours[person.name]))
        return floor

    def _write(self, labels: MapLabels, rings: Sequence[Ring], people: Sequence[Person]) -> list[Artist]:
        """Write the static labels; returns people's names, which are drawn above all bodies."""
        for person in people:
            labels.avoid_body(person.pose.xy, person.radius_m, nose=d.NOSE)
        for person, distance_m, _ in self._wanted(rings, people):
            labels.avoid_circle(person.xy, person.radius_m + distance_m)
        labels.avoid_line([(x, y) for x, y in self._frames.of(self._scene.robot.name)[::8, :2].tolist()])
        labels.avoid_walls(self._scene)
        labels.place(self._scene)
        return self._animated(
            [labels.name(p.name, p.pose, p.radius_m, self._colours[p.name]) for p in people]
        )

    def _body(self, name: str, radius_m: float) -> tuple[str, list[Artist]]:
        """A body drawn at the origin, with its artists; every frame sets its transform."""
        origin = Pose(0.0, 0.0, 0.0)
        if name == self._scene.robot.name:
            return name, self._animated(d.robot_artists(origin, radius_m))
        colour = self._colours.get(name, d.FAINT)
        return name, self._animated(d.person_artists(origin, radius_m, colour))

    def _animated(self, artists: Sequence[Artist]) -> list[Artist]:
        for artist in artists:
            artist.set_animated(True)
            if artist.axes is None:
                self._ax.add_artist(artist)
        return list(artists)

    def _name(self, person: Person) -> Text:
        """The name below a moving person."""
        from matplotlib.patheffects import withStroke

        colour = self._colours[person.name]
        words = d.in_lines(person.name, NAME_CHARACTERS)
        label = self._ax.text(
            0.0, 0.0, words, size=9.0, color=colour, weight="bold", ha="center", va="top", animated=True
        )
        label.set_clip_on(True)
        label.set_zorder(8.0)
        label.set_path_effects([withStroke(linewidth=2.5, foreground=d.HALO)])
        return label

    def _fitting(self, title: str) -> str:
        self._title.set_text(title)
        return d.fitting(self._title, self._canvas.figure.bbox.width - CLOCK_PX, self._canvas)

    def _header(self, x: float, side: Literal["left", "right"]) -> Text:
        figure = self._canvas.figure
        y = 1.0 - HEADER_IN / 2.0 / figure.get_figheight()
        label: Text = figure.text(x, y, "", size=12, color=d.INK, ha=side, va="center", animated=True)
        return label


class _StillPart:
    """The static background as an image, redrawn when the o-spaces of groups change."""

    def __init__(self, canvas: FigureCanvasAgg, ax: Axes, floor: Patch) -> None:
        self._canvas: Any = canvas  # its drawing calls carry no types
        self._ax, self._floor = ax, floor
        self._spaces: tuple[OSpace, ...] | None = None
        self._discs: list[Patch] = []

    def restore(self, spaces: tuple[OSpace, ...]) -> None:
        """Reset the canvas to the background with these o-spaces."""
        if spaces != self._spaces:
            for disc in self._discs:
                disc.remove()
            self._discs = d.draw_o_spaces(self._ax, spaces, self._floor)
            self._canvas.draw()
            self._image = self._canvas.copy_from_bbox(self._canvas.figure.bbox)
            self._spaces = spaces
        self._canvas.restore_region(self._image)


def _canvas(scene: Scene, width_px: int) -> tuple[FigureCanvasAgg, Axes]:
    """A canvas with the title, the map and a scale bar, as large as the width and `TALLEST_IN` allow."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    wide, high = d.extent_m(scene)
    wide, high = wide + 2 * d.beside_m(scene), high + 2 * d.above_m(scene)
    scale = min((width_px / DPI - 2 * EDGE_IN) / wide, (TALLEST_IN - HEADER_IN - FOOT_IN) / high)
    page = (wide * scale + 2 * EDGE_IN, high * scale + HEADER_IN + FOOT_IN)
    figure = Figure(figsize=page, dpi=DPI, facecolor="#FFFFFF")
    canvas = FigureCanvasAgg(figure)
    d.draw_scale_bar(figure, EDGE_IN, FOOT_IN / 2, scale)
    area = (EDGE_IN / page[0], FOOT_IN / page[1], wide * scale / page[0], high * scale / page[1])
    return canvas, figure.add_axes(area)


def _save(
    path: Path, shots: Iterator[NDArray[np.uint8]], palette: NDArray[np.int64], milliseconds: Sequence[int]
) -> None:
    """Write images of palette entries; each is drawn when needed."""
    from PIL import Image

    def pictures() -> Iterator[Image.Image]:
        for shot in shots:
            picture = Image.fromarray(shot)
            picture.putpalette(palette.astype(np.uint8).tobytes())
            yield picture

    following = pictures()
    next(following).save(
        path,
        format="GIF",
        save_all=True,
        append_images=following,
        duration=list(milliseconds),
        loop=0,
        optimize=True,
        comment=MARK,
    )


def _palette(samples: Sequence[NDArray[np.uint8]]) -> NDArray[np.int64]:
    """A palette for all samples, shape (COLOURS, 3)."""
    from PIL import Image
    from PIL.Image import Quantize

    sheet = Image.fromarray(np.concatenate([sample[::2, ::2, :3] for sample in samples], axis=0))
    colours = np.array(sheet.quantize(COLOURS, method=Quantize.MEDIANCUT).getpalette(), dtype=np.int64)
    rows = colours.reshape(-1, 3)[:COLOURS]
    return np.concatenate([rows, np.zeros((COLOURS - len(rows), 3), dtype=np.int64)])


def _nearest_entry(palette: NDArray[np.int64]) -> NDArray[np.uint8]:
    """The palette's entry for every coarse colour, shape (2 ** (3 * BITS),)."""
    levels = (np.arange(2**BITS) * 2 + 1) * 2 ** (7 - BITS)
    cube = np.stack(np.meshgrid(levels, levels, levels, indexing="ij"), axis=-1).reshape(-1, 1, 3)
    entries = [np.argmin(((part - palette) ** 2).sum(axis=-1), axis=1) for part in np.array_split(cube, 16)]
    return np.concatenate(entries).astype(np.uint8)


def _coarse(shot: NDArray[np.uint8]) -> NDArray[np.uint32]:
    """Red, green and blue of every pixel, cut to `BITS` each, in one number: shape (height, width)."""
    packed = shot.view("<u4")[:, :, 0]
    cut, mask = 8 - BITS, 2**BITS - 1
    red, green, blue = (packed >> cut) & mask, (packed >> (8 + cut)) & mask, (packed >> (16 + cut)) & mask
    return np.asarray((red << 2 * BITS) | (green << BITS) | blue, dtype=np.uint32)
