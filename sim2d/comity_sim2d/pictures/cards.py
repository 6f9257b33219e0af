"""The cards of a picture: words and numbers on how the robot approached each visited person."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

from comity_sim2d.navigation.docking import docked
from comity_sim2d.navigation.pose_choice import side_name
from comity_sim2d.pictures import drawing as d
from comity_sim2d.pictures.panel import Card
from comity_sim2d.pictures.person_colours import person_colours
from comity_sim2d.pose import wrap_angle

if TYPE_CHECKING:
    from comity_sim2d.frames import Frames
    from comity_sim2d.pictures.ring import Ring
    from comity_sim2d.robot.acts import ActEvent
    from comity_sim2d.scene.scene import Scene


def cards(scene: Scene, frames: Frames, rings: Sequence[Ring], events: Sequence[ActEvent]) -> list[Card]:
    """One card per visit, in order."""
    colours = person_colours([p.name for p in scene.people])
    return [
        Card(
            ring.person,
            colours[ring.person],
            f"{side_name(ring.bearing_deg)}, {abs(ring.bearing_deg):.0f}°",
            ring.wanted_m,
            ring.reached_m,
            (
                *(ring.label or "").splitlines(),
                *(() if ring.reached_m is None else (_exactness(scene, frames, ring, events),)),
            ),
        )
        for ring in rings
    ]


def reached_s(ring: Ring, events: Sequence[ActEvent]) -> float | None:
    """Time when the robot stood next to the person [s]; None if unknown: use the end."""
    if ring.time_s is not None:
        return ring.time_s
    return next((event.t_start for event in events if event.person == ring.person), None)


def _exactness(scene: Scene, frames: Frames, ring: Ring, events: Sequence[ActEvent]) -> str:
    """Errors of bearing and facing at docking, in words: from the ring, else from the frames."""
    then = reached_s(ring, events)
    met = d.pose_at(frames, ring.person, then)
    person = replace(scene.person(ring.person), x_m=met.x_m, y_m=met.y_m, heading_rad=met.heading_rad)
    seen = docked(d.pose_at(frames, scene.robot.name, then), scene.robot.radius_m, person)
    bearing = seen.bearing_deg if ring.reached_bearing_deg is None else ring.reached_bearing_deg
    facing = seen.facing_error_deg if ring.facing_error_deg is None else ring.facing_error_deg
    off = abs(math.degrees(wrap_angle(math.radians(bearing - ring.bearing_deg))))
    return f"bearing error {off:.1f}°, facing error {facing:.1f}°"
