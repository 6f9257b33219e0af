"""Checks the arguments of a picture or an animation before anything is drawn."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from comity_fis.listing import listed
from comity_sim2d.frames import Frames
from comity_sim2d.kinds import PATH, require_each, require_kinds
from comity_sim2d.maps.doorways import DoorTurn
from comity_sim2d.pictures.planned_route import PlannedRoute
from comity_sim2d.pictures.ring import Ring
from comity_sim2d.robot.acts import ActEvent
from comity_sim2d.scene.scene import Scene
from comity_sim2d.scene_error import SceneError, require_whole

WIDTH_PX = (100, 10_000)
"""Allowed width of a page [px]: less is illegible, more takes gigabytes (our choice)."""


def check_drawing(
    what: str,
    path: str | Path,
    suffixes: Sequence[str],
    scene: Scene,
    frames: Frames,
    *,
    rings: Sequence[Ring],
    events: Sequence[ActEvent],
    door_turns: Sequence[DoorTurn],
    planned: Sequence[PlannedRoute],
    width_px: int,
) -> None:
    """Reject another file type, an invalid width, frames of other people, and visits to nobody.

    Args:
        what: What is drawn, for messages.
        path: Where to write.
        suffixes: Allowed suffixes such as `.png`, in capitals, too.
        scene: The scene.
        frames: Frames of the scene; at least one.
        rings: The visits.
        events: Speech and acts.
        door_turns: Doors of the scene that were opened or shut.
        planned: The routes of the plans.
        width_px: Width of the page, in `WIDTH_PX`.

    Raises:
        SceneError: For an argument of the wrong type, the file name, the width or the frames.
        ValueError: For a visit to a person who is not in the scene.
    """
    require_kinds(what, path=(path, PATH), scene=(scene, Scene), frames=(frames, Frames))
    require_each(what, "rings", rings, Ring)
    require_each(what, "events", events, ActEvent)
    require_each(what, "door_turns", door_turns, DoorTurn)
    require_each(what, "planned", planned, PlannedRoute)
    if Path(path).suffix.lower() not in suffixes:
        raise SceneError(
            entity=what,
            field="path",
            expected=f"a path that ends with {listed(suffixes, 'or')}",
            got=repr(str(path)),
            remedy="Name it so, and convert it afterwards.",
        )
    require_whole(what, "width_px", width_px, *WIDTH_PX)
    _check_frames(what, scene, frames)
    for ring in rings:
        scene.person(ring.person)


def _check_frames(what: str, scene: Scene, frames: Frames) -> None:
    """Reject frames that are empty or lack a person of the scene."""
    passing = scene.passers_by.names if scene.passers_by else ()
    names = (scene.robot.name, *(person.name for person in scene.people), *passing)
    missing = [name for name in names if name not in frames.entities]
    if missing or not len(frames):
        raise SceneError(
            entity=what,
            field="frames",
            expected="frames with the robot and everybody of the scene, at least one",
            got=f"frames without {missing[0]!r}" if missing else "none",
            remedy="Take those of a world of this scene.",
        )
