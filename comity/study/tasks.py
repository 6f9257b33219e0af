"""Conversion of a study's episodes to tasks for workers."""

from __future__ import annotations

from typing import TYPE_CHECKING

from comity.study.worker import Installation, StudyTask

if TYPE_CHECKING:
    from comity.study.study_plan import StudyCell, StudyPlan


def task_of(plan: StudyPlan, cell: StudyCell, installed: Installation) -> StudyTask:
    """The task of a worker for one episode.

    Args:
        plan: The study.
        cell: The episode.
        installed: Code and libraries of the workers.
    """
    one, population = cell.individual, plan.population
    is_real = population is not None and not population.is_drawn
    return StudyTask(
        key=cell.key(installed.code, installed.fingerprint),
        base=cell.base,
        person=cell.person,
        profile=None if one is None else one.profile,
        comfort=None if one is None or one.comfort is None else one.comfort.model_dump(mode="json"),
        filtered=plan.written.tell if is_real else None,
        seed=cell.seed,
        installed=installed,
    )
