"""A stored run: the source of its page, its picture and its GIF."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from comity.answers.inference import SettledAnswer
from comity.answers.plan import PlanAnswer
from comity.answers.run import RunAnswer
from comity.output.run_folder import FRAMES, PLAN, RUN, SCENARIO, damaged
from comity.parameters.cast import cast_of
from comity.replay.frames_file import frames_of
from comity.scenario import load_scenario
from comity.simulation.changes import changes_of_values
from comity.simulation.scenery import scene_of
from comity_executor.tracing.intervention import INSTANT_S
from comity_fis import Choice, Inference, ParameterValue

if TYPE_CHECKING:
    from collections.abc import Mapping
    from pathlib import Path

    from comity.output.run_folder import RunFolder
    from comity.parameters.cast import Cast
    from comity.scenario import ScenarioFile
    from comity_sim2d import Frames, Scene


@dataclass(frozen=True, slots=True)
class SavedRun:
    """A run read from its folder."""

    account: RunAnswer
    plan: PlanAnswer
    """The first plan."""
    file: ScenarioFile
    """The resolved scenario, which contains its profiles and rulebook."""
    cast: Cast
    values: Mapping[str, Inference]
    """Initial parameters, by person."""
    frames: Frames
    scene: Scene
    """The initial scene, but with each person's finally preferred distance."""


def read_run(folder: RunFolder) -> SavedRun:
    """Read a run.

    Raises:
        InputError: if a file of the run is missing or damaged.
    """
    account, plan = folder.read(RUN, RunAnswer), folder.read(PLAN, PlanAnswer)
    file = load_scenario(str(folder / SCENARIO))
    cast = cast_of(file)
    values = values_told(account) if account.shared else cast.values()
    frames = frames_of(folder / FRAMES)
    _refuse_cut(folder / FRAMES, frames, account)
    scene = scene_of(file, {**values, **_later(cast, _end_s(frames))}, account.seed)
    return SavedRun(account, plan, file, cast, values, frames, scene)


def values_told(account: RunAnswer) -> dict[str, Inference]:
    """Values stored in a pseudonymised run, where they cannot be inferred without profiles."""
    return {
        person: Inference(
            rulebook=account.rulebook,
            mode="exact",
            inputs={},
            parameters={name: _value(name, told) for name, told in values.parameters.items()},
        )
        for person, values in account.values.items()
    }


def _value(name: str, told: SettledAnswer) -> ParameterValue:
    return ParameterValue(
        name=name,
        value=told.value,
        unit=told.unit,
        spread=told.spread,
        origin=told.origin,
        contributions=told.contributions,
        desirability=Choice({}),  # not stored
        fired=(),
        note="",
    )


def _later(cast: Cast, end_s: float) -> dict[str, Inference]:
    """The final parameters of each person whose parameters changed during the episode, by name."""
    return {one.person: one.values for one in changes_of_values(cast).values() if one.at_s <= end_s}


def _refuse_cut(path: Path, frames: Frames, account: RunAnswer) -> None:
    """Refuse frames that are shorter than a finished run."""
    end_s = _end_s(frames)
    if account.status == "done" and abs(end_s - account.simulated_s) > INSTANT_S:
        raise damaged(path, ValueError(f"frames up to {end_s:g} s of {account.simulated_s:g} s"))


def _end_s(frames: Frames) -> float:
    return frames.time_s[-1].item() if len(frames) else 0.0
