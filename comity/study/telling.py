"""Text and JSON output about a study, before and after it runs."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping
from itertools import islice
from typing import TYPE_CHECKING, Any

from comity.answers.study import StudyPlanAnswer, StudyRunAnswer, StudyState
from comity.report.text import duration_text, table, unbroken
from comity.study.columns import column_of
from comity.study.folder import JOURNAL
from comity.study.journal import read_journal
from comity.study.progress import progress_of
from comity.study.statement import STATEMENT
from comity.study.table import plain_value
from comity.study.worker import installation
from comity_fis.validation.complaint import counted

if TYPE_CHECKING:
    from pathlib import Path

    from rich.console import RenderableType

    from comity.study.estimate import StudyEstimate
    from comity.study.study_plan import StudyCell, StudyPlan

FIRST = 5
"""Number of episodes shown."""
SEEDS_MATTER = (
    "There, every seed gives the same numbers: one seed is enough, or let seeds matter by the noise of the "
    "sensor (`robot.sensor.noise_m: [0.02]`), places drawn at random (`at: random`) or people who walk."
)


def plan_answer(
    plan: StudyPlan, estimate: StudyEstimate, jobs: int, out: Path | None = None
) -> StudyPlanAnswer:
    """Contents of a study, and its estimated cost.

    Args:
        plan: The study.
        estimate: Estimate from a few episodes.
        jobs: Number of processes.
        out: Output folder; episodes already in it are not run again.
    """
    done = None if out is None else _done_in(plan, out)
    individuals = plan.population.individuals if plan.population else ()
    return StudyPlanAnswer(
        study=plan.written.name,
        statement=STATEMENT,
        episodes=plan.episodes,
        scenarios=len(plan.bases),
        conditions=len(plan.conditions),
        individuals=len(individuals),
        seeds=len(plan.written.every_seed),
        groups=Counter(one.group for one in individuals if one.group),
        wishing=plan.population.wishing if plan.population else 0,
        notes=plan.notes,
        cpu_s_per_episode=estimate.cpu_s_per_episode,
        done=done,
        state=None if out is None else _state_of(out, is_complete=done == plan.episodes),
        estimated_s=estimate.cpu_s_per_episode * (plan.episodes - (done or 0)) / jobs,
        jobs=jobs,
        estimated_bytes=round(estimate.bytes_per_episode * plan.episodes),
        without_effect=estimate.without_effect,
        tried=estimate.tried,
        first=tuple(_shown(cell) for cell in islice(plan.cells(), FIRST)),
    )


def _done_in(plan: StudyPlan, out: Path) -> int:
    """Number of the study's episodes in its journal, for the installed code and platform."""
    rows, here = read_journal(out / JOURNAL).rows, installation()
    return sum(cell.key(here.code, here.fingerprint) in rows for cell in plan.cells())


def _state_of(out: Path, *, is_complete: bool) -> StudyState:
    progress = progress_of(out)
    if progress is not None:
        return "running" if progress.is_running else "interrupted"
    return "done" if is_complete else "incomplete"


def _shown(cell: StudyCell) -> dict[str, Any]:
    values = {column_of(path): plain_value(value) for path, value in cell.condition.values.items()}
    individual = {} if cell.individual is None else {"individual": cell.individual.name}
    return {
        "scenario": cell.scenario,
        "condition": cell.condition.number,
        **values,
        "rulebook_used": cell.base.rulebook_name,
        **individual,
        "seed": cell.seed,
    }


def plan_text(answer: StudyPlanAnswer) -> Iterator[RenderableType]:
    """The answer as text."""
    parts = {
        "scenario": answer.scenarios,
        "condition": answer.conditions,
        "individual": answer.individuals,
        "seed": answer.seeds,
    }
    product = " x ".join(counted(count, name) for name, count in parts.items() if count)
    yield f"Study {answer.study}: {answer.episodes} episodes = {product}"
    if answer.groups:
        groups = ", ".join(f"{name} {count}" for name, count in answer.groups.items())
        yield f"  Individuals: {groups}; {answer.wishing} of {answer.individuals} state a wish"
    yield from (f"  Note: {note}" for note in answer.notes)
    if answer.done is not None and answer.state is not None:
        yield (
            f"  {answer.state.capitalize()}: {answer.done} of {answer.episodes} episodes are there; "
            f"{answer.episodes - answer.done} to be carried out"
        )
    yield (
        f"  About {duration_text(answer.estimated_s)} on {answer.jobs} processes "
        f"({answer.cpu_s_per_episode:.2f} s of CPU an episode), {size_text(answer.estimated_bytes)} on disk"
    )
    for name in answer.without_effect:
        yield f"  Seeds change nothing in {name}"
    if answer.without_effect:
        yield f"  {SEEDS_MATTER}"
    heading = tuple(dict.fromkeys(name for row in answer.first for name in row))
    yield table([_words(row, heading) for row in answer.first], head=heading)
    yield f"  {answer.statement}"


def _words(row: Mapping[str, Any], heading: tuple[str, ...]) -> tuple[str, ...]:
    return tuple("" if row.get(name) is None else str(row[name]) for name in heading)


def size_text(count: float) -> str:
    """Size as text: `40 kB`, `12 MB`, `3.5 GB`."""
    for unit, step in (("kB", 1e3), ("MB", 1e6)):
        if count < 1000 * step:
            return f"{max(count / step, 1):.0f} {unit}"
    return f"{count / 1e9:.1f} GB"


def run_text(answer: StudyRunAnswer) -> Iterator[RenderableType]:
    """Results of a study, as text."""
    yield (
        f"Study {answer.study}: {answer.done} of {answer.episodes} episodes, {answer.run_now} of them now, "
        f"{answer.failed} failed"
    )
    if answer.status != "done":
        yield "  Not all episodes are in the table: run the same command again"
    if answer.damaged_lines:
        lines = counted(answer.damaged_lines, "damaged line")
        places = ", ".join(answer.damaged_at[:FIRST]) + (", ..." if answer.damaged_lines > FIRST else "")
        yield f"  {lines} of the journal skipped ({places}); episodes of this study there ran again"
    if answer.different < answer.episodes:
        yield (
            f"  {answer.different} different episodes: individuals with the same facts, wish and comfort "
            "share one"
        )
    if answer.other:
        yield (
            f"  {counted(answer.other, 'episode')} of other conditions, individuals, code or platform in the "
            "journal: kept there, not in the table"
        )
    if answer.lost_workers:
        lost = counted(answer.lost_workers, "worker")
        yield f"  Lost {lost}; their episodes were given to others"
    yield unbroken(f"  {answer.rows} rows in {answer.folder}: {', '.join(answer.files)}")
    yield f"  {answer.statement}"
