"""Metrics of runs: as a table, and in long form for statistics programs."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from statistics import fmean
from typing import TYPE_CHECKING

from comity.answers.figures import DefinitionAnswer, FigureAnswer, MetricsAnswer
from comity.answers.run import RunAnswer
from comity.output.csv_text import csv_text
from comity.output.run_folder import RUN, RunFolder
from comity.report.text import table, unbroken
from comity_sim2d import EPISODE, VISIT

if TYPE_CHECKING:
    from rich.console import RenderableType

    from comity_sim2d import Metric

COLUMNS = ("run", "scenario", "rulebook", "seed", "person", "profile", "metric", "value", "unit")
MARK = ",".join(COLUMNS).encode()
"""First line of a metrics file, which identifies files that may be replaced."""


@dataclass(frozen=True, slots=True)
class MeasuredRun:
    """One run with its account."""

    folder: RunFolder
    account: RunAnswer


def measured(folder: RunFolder) -> MeasuredRun:
    """The account of a run.

    Raises:
        InputError: if it is missing or damaged.
    """
    return MeasuredRun(folder, folder.read(RUN, RunAnswer))


def metrics_answer(runs: Sequence[MeasuredRun]) -> MetricsAnswer:
    """All metrics in long form, with their definitions."""
    figures = tuple(figure for run in runs for figure in _figures(run))
    return MetricsAnswer(
        figures=figures,
        by_profile=_by_profile(figures),
        definitions={
            name: DefinitionAnswer(unit=one.unit, means=one.means, source=one.source, per=one.per)
            for name, one in {**EPISODE, **VISIT}.items()
        },
    )


def metrics_csv(answer: MetricsAnswer) -> str:
    """One metric per line."""
    return csv_text(COLUMNS, ([getattr(figure, column) for column in COLUMNS] for figure in answer.figures))


def metrics_text(runs: Sequence[MeasuredRun], answer: MetricsAnswer) -> Iterator[RenderableType]:
    """Metrics run by run (the whole episode, then each person), means by profile if several, then sources."""
    for run in runs:
        account = run.account
        ended = account.outcome or account.status
        yield unbroken(f"\n{run.folder.path}: {account.scenario}, {ended}, seed {account.seed}")
        if not account.metrics:
            yield "  The run has no figures: it did not come to its end."
            continue
        whole = {"duration_s": account.simulated_s, **account.metrics}
        yield table(_rows(EPISODE, (whole,)), head=("of the episode", "", "what it is"))
        people = {name: figures for name, figures in account.figures.items() if figures}
        if people:
            yield table(_rows(VISIT, tuple(people.values())), head=("of a person", *people, "what it is"))
    if len(runs) > 1 and answer.by_profile:
        yield unbroken(f"\nMeans over the people of each profile in {len(runs)} runs")
        means = tuple(answer.by_profile.values())
        yield table(_rows(VISIT, means), head=("of a person", *answer.by_profile, "what it is"))
    yield "  Definitions after"
    yield from (f"  [{i}] {source}" for i, source in enumerate(_sources(), start=1))


def _rows(
    definitions: Mapping[str, Metric], columns: Sequence[Mapping[str, float]]
) -> Iterator[tuple[str, ...]]:
    sources = _sources()
    for name, definition in definitions.items():
        if any(name in figures for figures in columns):
            means = f"{definition.means} [{sources.index(definition.source) + 1}]"
            yield name, *(_number(figures.get(name), definition.unit) for figures in columns), means


def _sources() -> tuple[str, ...]:
    return tuple(dict.fromkeys(one.source for one in (*EPISODE.values(), *VISIT.values())))


def _number(value: float | None, unit: str) -> str:
    if value is None:
        return "-"
    if unit == "1":
        return f"{value:g}" if value == int(value) else f"{value:.3f}"
    return f"{value + 0.0:.3f} {unit}"


def _by_profile(figures: Iterable[FigureAnswer]) -> dict[str, dict[str, float]]:
    """Mean of each per-person metric over all people of a profile who have a value."""
    values: dict[str, dict[str, list[float]]] = {}
    for figure in figures:
        if figure.profile is not None:
            values.setdefault(figure.profile, {}).setdefault(figure.metric, []).append(figure.value)
    return {
        profile: {metric: fmean(found) for metric, found in metrics.items()}
        for profile, metrics in sorted(values.items())
    }


def _figures(run: MeasuredRun) -> Iterator[FigureAnswer]:
    account = run.account
    whole = {"duration_s": account.simulated_s, **account.metrics} if account.metrics else {}
    parts: list[tuple[str | None, Mapping[str, float]]] = [(None, whole), *account.figures.items()]
    for person, figures in parts:
        for name, value in figures.items():
            definition = (VISIT if person else EPISODE).get(name)
            yield FigureAnswer(
                run=str(run.folder.path),
                scenario=account.scenario,
                rulebook=account.rulebook,
                seed=account.seed,
                person=person,
                profile=account.profiles.get(person) if person else None,
                metric=name,
                value=value,
                unit=definition.unit if definition else "",
            )
