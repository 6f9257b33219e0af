"""Speech bubbles of an animation: one at a time, with everything that goes on together."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from comity_sim2d.pictures import drawing as d

if TYPE_CHECKING:
    from matplotlib.artist import Artist

    from comity_sim2d.frames import Frames
    from comity_sim2d.pictures.label_placement import Disc
    from comity_sim2d.pictures.map_labels import MapLabels
    from comity_sim2d.robot.acts import ActEvent
    from comity_sim2d.scene.scene import Scene

EVERY_S = 0.25
"""Interval at which people's positions are checked while a bubble is shown [s] (our choice: half a step of a
walker)."""


class Speech:
    """The bubbles of an episode.

    Args:
        labels: The labels of the map, for placement.
        scene: The scene, with the people whom bubbles should not hide.
        frames: Poses of all entities.
        events: Speech and acts.
        colours: Colours by person; acts towards others are left out.
    """

    def __init__(
        self,
        labels: MapLabels,
        scene: Scene,
        frames: Frames,
        events: Sequence[ActEvent],
        colours: Mapping[str, str],
    ) -> None:
        told = [event for event in events if event.person in colours]
        self._spans: list[tuple[float, float, list[Artist]]] = []
        for start, end in pairwise(sorted({t for event in told for t in (event.t_start, event.t_end)})):
            now = [event for event in told if event.t_start <= start < event.t_end]
            if not now:
                continue
            words = list(dict.fromkeys(event.words for event in now))
            at = d.pose_at(frames, scene.robot.name, min(event.t_start for event in now))
            people = _bodies(scene, frames, start, end)
            colour = colours[now[0].person]
            bubble = labels.bubble(at.xy, scene.robot.radius_m, words, colour, besides=people)
            labels.forget_bubble()
            self._spans.append((start, end, bubble))

    @property
    def artists(self) -> list[Artist]:
        """All artists."""
        return [part for *_, bubble in self._spans for part in bubble]

    def at(self, time_s: float) -> list[Artist]:
        """The artists at a time."""
        return [part for start, end, bubble in self._spans if start <= time_s < end for part in bubble]


def _bodies(scene: Scene, frames: Frames, start_s: float, end_s: float) -> list[Disc]:
    """Bodies of all people between two times, each place once."""
    people = [(person.name, person.radius_m) for person in scene.people]
    times = [*np.arange(start_s, end_s, EVERY_S).tolist(), end_s]
    bodies = (
        (d.pose_at(frames, name, time_s).xy, radius_m)
        for name, radius_m in (*people, *d.passers_by(scene))
        for time_s in times
    )
    return list(dict.fromkeys(bodies))
