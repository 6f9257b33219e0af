"""Distances in an animation: target distances move with people, actual ones show while they last."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING

from comity_sim2d.pictures import drawing as d
from comity_sim2d.pictures.cards import reached_s
from comity_sim2d.pose import XY, Pose, direction_to

if TYPE_CHECKING:
    from matplotlib.artist import Artist
    from matplotlib.axes import Axes
    from matplotlib.lines import Line2D
    from matplotlib.patches import Circle, Patch

    from comity_sim2d.frames import Frames
    from comity_sim2d.pictures.ring import Ring
    from comity_sim2d.robot.acts import ActEvent
    from comity_sim2d.scene.person import Person
    from comity_sim2d.scene.scene import Scene


def wanted_m(person: Person, rings: Sequence[Ring]) -> float | None:
    """The distance that a person likes, if known [m]; the target distance of a visit takes precedence."""
    visited = (ring.wanted_m for ring in rings if ring.person == person.name)
    return next(visited, person.personal_distance_m)


class MovingRings:
    """The preferred distances of people who move.

    Args:
        ax: The map.
        floor: The floor, to clip them.
        frames: Poses of all entities.
        people: People who move, each with their preferred distance [m] and colour.
    """

    def __init__(
        self, ax: Axes, floor: Patch, frames: Frames, people: Iterable[tuple[Person, float, str]]
    ) -> None:
        self._data, self._frames = ax.transData, frames
        self._rings: list[tuple[str, Circle]] = []
        for person, distance_m, colour in people:
            circle = d.dashed_circle((0.0, 0.0), person.radius_m + distance_m, colour)
            ax.add_patch(circle)
            circle.set_clip_path(floor)
            circle.set_animated(True)
            self._rings.append((person.name, circle))

    def at(self, time_s: float) -> list[Artist]:
        """The artists at a time."""
        from matplotlib.transforms import Affine2D

        for name, circle in self._rings:
            place = d.pose_at(self._frames, name, time_s)
            circle.set_transform(Affine2D().translate(*place.xy) + self._data)
        return [circle for _, circle in self._rings]


class ReachedLines:
    """The actual distance: a line between the bodies, from docking until the last act towards a person.

    Args:
        ax: The map.
        scene: The scene with the bodies.
        frames: Poses of the bodies.
        rings: The visits.
        events: Speech and acts.
        colours: Colours, by person.
    """

    def __init__(
        self,
        ax: Axes,
        scene: Scene,
        frames: Frames,
        rings: Sequence[Ring],
        *,
        events: Sequence[ActEvent],
        colours: Mapping[str, str],
    ) -> None:
        from matplotlib.lines import Line2D

        self._scene, self._frames = scene, frames
        end_s = float(frames.time_s[-1])
        reached = [(ring, reached_s(ring, events)) for ring in rings if ring.reached_m is not None]
        starts = [(ring.person, end_s if start is None else start) for ring, start in reached]
        latest = max((start for _, start in starts), default=end_s)
        self._spans: list[tuple[float, float, str, Line2D]] = []
        for person, start in starts:
            acts = [event.t_end for event in events if event.person == person]
            until = end_s + 1.0 if start == latest else max(acts, default=start)
            line = Line2D([], [], color=colours[person], lw=2.4, marker="o", ms=6.5, markevery=[1])
            line.set(markeredgecolor="#FFFFFF", markeredgewidth=1.2, solid_capstyle="butt", animated=True)
            ax.add_line(line)
            self._spans.append((start, until, person, line))

    def at(self, time_s: float) -> list[Artist]:
        """The artists at a time."""
        shown = [(person, line) for start, until, person, line in self._spans if start <= time_s < until]
        for person, line in shown:
            line.set_data(*zip(*self._gap(person, time_s), strict=True))
        return [line for _, line in shown]

    def _gap(self, person: str, time_s: float) -> tuple[XY, XY]:
        """The nearest points of the person and of the robot."""
        robot = self._scene.robot
        body, other = d.pose_at(self._frames, person, time_s), d.pose_at(self._frames, robot.name, time_s)
        towards = Pose(*body.xy, direction_to(body.xy, other.xy))
        far = math.dist(body.xy, other.xy) - robot.radius_m
        return towards.ahead(self._scene.person(person).radius_m), towards.ahead(far)
