"""Estimate of a study's duration and size, and whether its seeds have an effect, from a few episodes."""

from __future__ import annotations

import json
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from importlib.metadata import version
from typing import TYPE_CHECKING, Any

from comity.study.journal import line_of
from comity.study.study_plan import StudyCell, StudyPlan
from comity.study.table import study_table
from comity.study.tasks import task_of
from comity.study.worker import TaskDone, carried_out, installation

if TYPE_CHECKING:
    from comity.study.episode_rows import StudyRow

MOST_TRIED = 8
"""Maximum number of combinations of scenario and condition that are tried, evenly spread over all."""
OF_THE_SEED = ("trace_sha256",)
"""Columns that may differ although no number does."""


@dataclass(frozen=True, slots=True)
class StudyEstimate:
    """Extrapolation from a few episodes to all."""

    cpu_s_per_episode: float
    bytes_per_episode: float
    tried: int
    without_effect: tuple[str, ...]
    """Combinations of scenario and condition whose rows are the same for the first two seeds."""


def estimated(plan: StudyPlan) -> StudyEstimate:
    """Run the first individual in a few conditions, with the first two seeds."""
    installed = installation()
    tried: list[tuple[StudyCell, TaskDone]] = []
    without_effect = []
    cells = list(_spread(plan))
    for pair in cells:
        done = [(cell, carried_out(task_of(plan, cell, installed))) for cell in pair]
        tried += done
        if len(done) > 1 and _numbers(done[0][1].rows) == _numbers(done[1][1].rows):
            without_effect.append(_called(pair[0]))
    took = [done.took_s for _, done in tried[1:]] or [tried[0][1].took_s]  # the first includes imports
    found = ((cell, done.key, done.rows) for cell, done in tried)
    table = study_table(factors_of(plan), found, installed, version("comity"))
    size = len(table.csv().encode()) + sum(len(line_of(done)) for _, done in tried)
    return StudyEstimate(
        cpu_s_per_episode=sum(took) / len(took),
        bytes_per_episode=size / len(tried),
        tried=len(cells),
        without_effect=tuple(without_effect),
    )


def factors_of(plan: StudyPlan) -> Sequence[str]:
    """Paths of factors with a value in some condition, in the order of the file."""
    return tuple(dict.fromkeys(path for condition in plan.conditions for path in condition.values))


def _spread(plan: StudyPlan) -> Iterator[Sequence[StudyCell]]:
    """A few combinations of scenario and condition, each with one cell for each of the first two seeds."""
    places = [(name, i) for name, bases in plan.bases.items() for i in range(len(bases))]
    step = max(1, len(places) // MOST_TRIED)
    for name, i in places[::step][:MOST_TRIED]:
        person = plan.persons[name] if plan.population else None
        yield [
            StudyCell(name, plan.conditions[i], plan.bases[name][i], person, plan.individuals[0], seed)
            for seed in plan.written.every_seed[:2]
        ]


def _numbers(rows: Sequence[StudyRow]) -> list[dict[str, Any]]:
    return [{name: value for name, value in row.items() if name not in OF_THE_SEED} for row in rows]


def _called(cell: StudyCell) -> str:
    values = ", ".join(f"{path}: {json.dumps(value)}" for path, value in cell.condition.values.items())
    return f"{cell.scenario} ({values})" if values else cell.scenario
