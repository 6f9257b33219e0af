"""Everything that the page shows of one run, as plain lists and dictionaries."""

from __future__ import annotations

from typing import TYPE_CHECKING

from numpy import isfinite

from comity.answers import PlanAnswer, RunAnswer
from comity.cast import cast_of
from comity.replay.tracks import tracks_of
from comity.replay.tree_data import tree_data
from comity.replay.values_data import values_data
from comity.report.trace import load
from comity.run_folder import FRAMES, PLAN, RUN, SCENARIO, RunFolder, damaged
from comity.scenario import load_scenario
from comity.scenery import scene_of
from comity_executor import DEFAULT_LIMITS
from comity_executor.intervention import INSTANT_S
from comity_sim2d import read_frames_csv
from comity_sim2d.door_drawing import leaf, swing

if TYPE_CHECKING:
    from pathlib import Path

    from comity.scenario import ScenarioFile
    from comity_fis import Inference
    from comity_sim2d import Frames, Scene


def episode_data(folder: RunFolder) -> dict[str, object]:
    """What the page is told about a run.

    Raises:
        InputError: if a file of the run is missing or damaged.
    """
    account = folder.read(RUN, RunAnswer)
    plan = folder.read(PLAN, PlanAnswer)
    history = load(folder).history
    file = load_scenario(str(folder / SCENARIO))
    cast = cast_of(file)
    rulebook, values = cast.rulebook, cast.values()
    frames = _frames(folder / FRAMES)
    _refuse_cut(folder / FRAMES, frames, account)
    scene = scene_of(file, {})
    return {
        "name": folder.path.resolve().name,
        "about": file.scenario.about,
        "end": max(history.end_s, frames.time_s[-1].item() if len(frames) else 0.0),
        "account": account.model_dump(
            mode="json",
            include={
                "status",
                "outcome",
                "scenario",
                "rulebook",
                "profiles",
                "at",
                "seed",
                "trace_sha256",
                "visits",
                "metrics",
                "error",
            },
        ),
        "place": _place(scene),
        "people": [_person(name, file, inference) for name, inference in values.items()],
        "robot": file.scenario.robot.name,
        "tracks": tracks_of(frames),
        "tree": tree_data(history, values),
        "plan": plan.model_dump(
            mode="json",
            by_alias=True,
            include={"engine", "optimal", "cost", "steps", "unreachable"},
            exclude={"steps": {"__all__": {"contributions"}}},  # they stand with the values
        ),
        "values": values_data(rulebook, values),
    }


def _person(name: str, file: ScenarioFile, inference: Inference) -> dict[str, object]:
    wanted = inference["conversational_distance"].number
    limits = DEFAULT_LIMITS
    return {
        "name": name,
        "posture": file.scenario.people[name].posture,
        "visited": name in file.scenario.visited(),
        "wanted": wanted,
        "band": [max(limits.safety_floor_m, wanted - limits.leave_closer_m), wanted + limits.leave_farther_m],
    }


def _place(scene: Scene) -> dict[str, object]:
    return {
        "room": scene.room.corners,
        "holes": scene.room.holes,
        "doors": [
            [door.name, "open" if door.is_open else "closed", leaf(door), swing(door)] for door in scene.doors
        ],
        "areas": [[area.name, area.corners] for area in scene.areas] if len(scene.areas) > 1 else [],
        "walls": [[*wall.start, *wall.end, wall.thickness_m] for wall in scene.walls],
        "furniture": [[piece.name, piece.corners] for piece in scene.furniture],
    }


def _frames(path: Path) -> Frames:
    try:
        frames = read_frames_csv(path)
        if not all(isfinite(frames.of(name)).all() for name in frames.entities):
            raise ValueError("a place that is no number")
        return frames
    except (OSError, ValueError, KeyError, TypeError, IndexError) as error:
        raise damaged(path, error) from None


def _refuse_cut(path: Path, frames: Frames, account: RunAnswer) -> None:
    """A run that is done knows how long it was."""
    end_s = frames.time_s[-1].item() if len(frames) else 0.0
    if account.status == "done" and abs(end_s - account.simulated_s) > INSTANT_S:
        raise damaged(path, ValueError(f"frames up to {end_s:g} s of {account.simulated_s:g} s"))
