"""Production of clips: each value's episode is run, filmed without showing the value, and compared."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import dataclass
from math import ceil
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Any

from comity.answers.study_with_people import ClipAnswer, ConfoundAnswer, StudyClipsAnswer
from comity.output.csv_text import csv_text
from comity.output.run_folder import open_run
from comity.recording import record
from comity.replay import replay_page
from comity.replay.pictures import film_stimulus
from comity.replay.saved_run import read_run
from comity.study.clips.confounds import ClipFacts, clip_facts, confounds_of
from comity.study.clips.film import ffmpeg_program, write_mp4
from comity.study.clips.variation import opaque_name
from comity.study.tasks import task_of
from comity.study.worker import installation, prepared_of
from comity.system.own_files import make_folder, write_whole, writing, written_whole
from comity_fis import InputError, Where

if TYPE_CHECKING:
    from comity.study.study_plan import StudyCell, StudyPlan

KEY, CONFOUNDS, PAGES = "key.csv", "confounds.csv", "pages"
KEY_COLUMNS = (
    "clip", "parameter", "value", "scenario", "seed", "rulebook", "outcome", "length_s", "trace_sha256",
)  # fmt: skip
LONGEST_S = 60.0
"""Maximum length of a film [s]; all films of a set have the same speed, set by the longest (our choice)."""


@dataclass(frozen=True, slots=True)
class Clip:
    """One film."""

    name: str
    value: Any
    """Value of the parameter."""
    seed: int
    rulebook: str
    outcome: str
    trace_sha256: str
    length_s: float
    """Duration of the episode [simulated s]."""
    facts: ClipFacts


def make_clips(plan: StudyPlan, out: Path) -> StudyClipsAnswer:
    """Run, film and compare the conditions of a study with one factor.

    Args:
        plan: A study with one scenario, one factor, one seed and no individuals.
        out: A new or an empty folder.

    Raises:
        InputError: if the folder is not empty, or cannot be written.
        PlanningFailed: if there is no plan under some value.
    """
    _require_empty(out)
    with TemporaryDirectory(prefix="comity-clips-") as runs:
        clips = sorted((_played(plan, cell, Path(runs)) for cell in plan.cells()), key=lambda one: one.name)
        speed = float(max(1, ceil(max(one.length_s for one in clips) / LONGEST_S)))
        make_folder(out / PAGES)
        films = [file for one in clips for file in _filmed(Path(runs) / one.name, out, speed)]
    confounds = confounds_of([one.facts for one in clips])
    (scenario,), (parameter,) = plan.written.scenarios, plan.written.factors
    write_whole(out / KEY, key_csv(scenario, parameter, clips).encode())
    write_whole(out / CONFOUNDS, confounds_csv(clips, confounds).encode())
    return StudyClipsAnswer(
        scenario=scenario,
        parameter=parameter,
        speed=speed,
        clips=tuple(
            ClipAnswer(
                clip=one.name,
                value=one.value,
                outcome=one.outcome,
                length_s=one.length_s,
                trace_sha256=one.trace_sha256,
            )
            for one in clips
        ),
        confounds=confounds,
        folder=str(out),
        files=(*films, KEY, CONFOUNDS),
    )


def _require_empty(out: Path) -> None:
    with writing(out):
        if out.exists() and (not out.is_dir() or any(out.iterdir())):
            raise InputError(
                expected="a new or an empty folder for the clips",
                got="a folder with other things in it" if out.is_dir() else "a file",
                remedy="Name another: nothing is overwritten.",
                where=Where(str(out)),
            )


def _played(plan: StudyPlan, cell: StudyCell, runs: Path) -> Clip:
    (parameter,) = plan.written.factors
    value = cell.condition.values[parameter]
    name = opaque_name(cell.scenario, parameter, value, cell.seed)
    prepared = prepared_of(task_of(plan, cell, installation()))
    recorded = record(prepared, seed=cell.seed, out=runs / name, views=())
    frames = read_run(recorded.folder).frames
    return Clip(
        name=name,
        value=value,
        seed=cell.seed,
        rulebook=cell.base.rulebook_name,
        outcome=recorded.episode.outcome,
        trace_sha256=recorded.episode.trace_sha256,
        length_s=float(frames.time_s[-1]),
        facts=clip_facts(recorded.episode, frames),
    )


def _filmed(run: Path, out: Path, speed: float) -> Sequence[str]:
    """Names of a clip's files in the folder."""
    folder = open_run(run)
    gif, mp4, page = f"{run.name}.gif", f"{run.name}.mp4", f"{PAGES}/{run.name}.html"
    with writing(out / gif), written_whole(out / gif) as part:
        film_stimulus(read_run(folder), part, speed)
    write_whole(out / page, replay_page(folder).encode())
    program = ffmpeg_program()
    if program is None:
        return (gif, page)
    with writing(out / mp4), written_whole(out / mp4) as part:
        write_mp4(program, out / gif, part)
    return (gif, mp4, page)


def key_csv(scenario: str, parameter: str, clips: Sequence[Clip]) -> str:
    """The key: which clip shows which value."""
    rows = []
    for one in clips:
        told = (scenario, one.seed, one.rulebook, one.outcome, f"{one.length_s:g}", one.trace_sha256)
        rows.append((one.name, parameter, plain(one.value), *told))
    return csv_text(KEY_COLUMNS, rows)


def plain(value: Any) -> str:
    """A value of the parameter as readable text."""
    return value if isinstance(value, str) else json.dumps(value)


def confounds_csv(clips: Sequence[Clip], confounds: Sequence[ConfoundAnswer]) -> str:
    """The confounds: a row for each quantity, a column for each clip."""
    rows = []
    for one in confounds:
        values = ["" if value is None else value for value in one.values]
        difference = "" if one.difference is None else f"{one.difference:.6g}"
        rows.append((one.person, one.quantity, one.unit, *values, difference, one.definition))
    heading = ("person", "quantity", "unit", *(one.name for one in clips), "difference", "definition")
    return csv_text(heading, rows)
