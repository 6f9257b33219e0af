"""Everything that the page shows of one run, as plain lists and dictionaries."""

from __future__ import annotations

from typing import TYPE_CHECKING

from comity.answers import PlanAnswer, RunAnswer
from comity.output.run_folder import FRAMES, PLAN, RUN, SCENARIO, RunFolder, damaged
from comity.parameters.cast import cast_of
from comity.replay.frames_file import frames_of
from comity.replay.groups_data import groups_data
from comity.replay.place_data import place_data
from comity.replay.plans_data import plans_data, stages_of
from comity.replay.tracks import tracks_of
from comity.replay.tree_data import tree_data
from comity.replay.values_data import values_data
from comity.report.episodes.trace import load
from comity.scenario import load_scenario
from comity.simulation.scenery import scene_of
from comity_executor.tracing.intervention import INSTANT_S

if TYPE_CHECKING:
    from pathlib import Path

    from comity.scenario import ScenarioFile
    from comity_sim2d import Frames


def episode_data(folder: RunFolder) -> dict[str, object]:
    """What the page is told about a run.

    Raises:
        InputError: if a file of the run is missing or damaged.
    """
    account = folder.read(RUN, RunAnswer)
    plan = folder.read(PLAN, PlanAnswer)
    recorded = load(folder)
    history = recorded.history
    file = load_scenario(str(folder / SCENARIO))
    cast = cast_of(file)
    values = cast.values()
    frames = frames_of(folder / FRAMES)
    _refuse_cut(folder / FRAMES, frames, account)
    scene = scene_of(file, {})
    return {
        "name": folder.path.resolve().name,
        "about": file.scenario.about,
        "ending": recorded.ending,
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
                "doors",
            },
        ),
        "place": place_data(scene),
        "groups": groups_data(scene, frames),
        "people": [_person(name, file) for name in values],
        "robot": file.scenario.robot.name,
        "carrying": file.scenario.robot.carrying,
        "tracks": tracks_of(frames),
        "tree": tree_data(history, values),
        "plans": plans_data(plan, account),
        "values": values_data(cast.rulebook, stages_of(cast, values, account.revisions)),
    }


def _person(name: str, file: ScenarioFile) -> dict[str, object]:
    person = file.scenario.people[name]
    return {
        "name": name,
        "posture": person.posture,
        "visited": name in file.scenario.visited(),
        "carrying": person.carrying,
    }


def _refuse_cut(path: Path, frames: Frames, account: RunAnswer) -> None:
    """A run that is done knows how long it was."""
    end_s = frames.time_s[-1].item() if len(frames) else 0.0
    if account.status == "done" and abs(end_s - account.simulated_s) > INSTANT_S:
        raise damaged(path, ValueError(f"frames up to {end_s:g} s of {account.simulated_s:g} s"))
