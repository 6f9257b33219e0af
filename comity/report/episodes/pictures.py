"""The picture and the animation of an episode."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from comity.monitoring.lateness import late_s
from comity.parameters.passing import own_distance_m
from comity.report.episodes.facing import facing_error_deg
from comity.report.text import words
from comity_sim2d.pictures.animation import write_gif
from comity_sim2d.pictures.picture import Ring, draw_picture

if TYPE_CHECKING:
    from comity.episode import Episode
    from comity_executor import Visit
    from comity_sim2d import Scene


def draw_episode(episode: Episode, path: Path) -> None:
    """Write a PNG: the way, and what was wanted and reached beside each person."""
    draw_picture(
        path,
        scene_in_the_end(episode),
        episode.frames,
        rings=rings_of(episode),
        events=episode.acts,
        door_turns=episode.door_turns,
        title=_title(episode),
    )


def draw_animation(episode: Episode, path: Path) -> None:
    """Write a GIF of the whole episode."""
    write_gif(
        path,
        scene_in_the_end(episode),
        episode.frames,
        rings=rings_of(episode),
        events=episode.acts,
        door_turns=episode.door_turns,
        title=episode.prepared.file.scenario.name,
        ending=_title(episode),
    )


def scene_in_the_end(episode: Episode) -> Scene:
    """With everybody's own distance as they asked for it last, as the rings of visits have it."""
    scene = episode.prepared.scene
    people = (
        replace(person, personal_distance_m=own_distance_m(episode.values_at(person.name, math.inf)))
        for person in scene.people
    )
    return replace(scene, people=tuple(people))


def _title(episode: Episode) -> str:
    return f"{episode.prepared.file.scenario.name}: {episode.outcome}"


def rings_of(episode: Episode) -> list[Ring]:
    """One for each visited person, in the order of the visits; then those whom nobody reached to the end.

    Who was out of reach at the start and is served later, when a door was opened, is among the visited.
    """
    prepared = episode.prepared
    visited = {visit.person for visit in episode.visits if visit.outcome != "skipped"}
    rings = [
        Ring(
            person=visit.person,
            wanted_m=_wanted(episode, visit.person, "conversational_distance"),
            reached_m=visit.docked_at.distance_m if visit.docked_at else None,
            bearing_deg=visit.wanted.bearing_deg
            if visit.wanted
            else _wanted(episode, visit.person, "approach_bearing"),
            reached_bearing_deg=visit.docked_at.bearing_deg if visit.docked_at else None,
            facing_error_deg=facing_error_deg(episode, visit),
            label=_label(
                episode, visit.person, visit.failure or visit.deviation_reason, _lateness(episode, visit)
            ),
            time_s=visit.docked_s,
        )
        for visit in episode.visits
        if visit.together_with is None and visit.outcome != "skipped"
    ]
    return rings + [
        Ring(
            person,
            prepared.values[person]["conversational_distance"].number,
            label=_label(episode, person, "could not be served"),
        )
        for person in prepared.asked.unreachable
        if person not in visited
    ]


def _label(episode: Episode, person: str, *remarks: str | None) -> str:
    """The profile, and below it what there is to remark."""
    profile = words(episode.prepared.profiles[person].name)
    return "\n".join((profile, *filter(None, remarks)))


def _lateness(episode: Episode, visit: Visit) -> str | None:
    late = late_s(episode.prepared, visit)
    return f"{late:.1f} s late" if late else None


def _wanted(episode: Episode, person: str, parameter: str) -> float:
    reach = next(step for step in episode.steps if step.action == "Reach_user" and step.person == person)
    return float(reach.parameters[parameter])
