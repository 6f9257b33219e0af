"""Execution of one episode of a study, by a process on this machine or on a cluster."""

from __future__ import annotations

import tempfile
import time
from collections.abc import Collection, Mapping
from dataclasses import dataclass, replace
from functools import lru_cache
from pathlib import Path
from threading import Lock
from typing import TYPE_CHECKING, Any

from comity.episode import fingerprint
from comity.live_episode import execute
from comity.preparation import prepare
from comity.scenario import ComfortSpec, Scenario, ScenarioFile
from comity.study.base import EpisodeBase
from comity.study.episode_rows import ERROR, NO_PLAN, StudyRow, episode_rows, failed_rows
from comity.system.installed_code import installed_code
from comity_domain import PlanningFailed
from comity_fis import shipped_rulebooks
from comity_fis.validation.yaml_file import YamlFile

if TYPE_CHECKING:
    from comity.preparation import PlannedEpisode
    from comity.sharing.extra import Extra

KEPT = 64
"""Maximum number of cached combinations of scenario and condition in a worker."""
_ONE_AT_A_TIME = Lock()
"""Lock for workers with several threads, which run episodes one at a time: py_trees' blackboard is shared."""


@dataclass(frozen=True, slots=True)
class Installation:
    """Code, libraries and platform, which affect an episode besides its input."""

    code: str
    fingerprint: str


@dataclass(frozen=True, slots=True)
class StudyTask:
    """Input of a worker for one episode."""

    key: str
    base: EpisodeBase
    person: str | None
    """Person replaced by the individual; None without one."""
    profile: Mapping[str, Any] | None
    comfort: Mapping[str, Any] | None
    filtered: Collection[Extra] | None
    seed: int
    installed: Installation
    """Code and libraries that the key assumes."""


@dataclass(frozen=True, slots=True)
class TaskDone:
    """The result of a task."""

    key: str
    rows: tuple[StudyRow, ...]
    took_s: float
    """CPU time of the worker [s]."""


def installation() -> Installation:
    """The installation of this process."""
    return Installation(installed_code(), fingerprint())


def carried_out(task: StudyTask) -> TaskDone:
    """Plan and execute an episode; an exception becomes its rows."""
    with _ONE_AT_A_TIME:
        start = time.process_time()
        try:
            rows = _rows(task)
        except PlanningFailed as failed:
            rows = tuple(failed_rows(_visited(task), NO_PLAN, str(failed)))
        except Exception as error:
            rows = tuple(failed_rows(_visited(task), ERROR, f"{type(error).__name__}: {error}"))
        return TaskDone(task.key, rows, time.process_time() - start)


def lost_rows(task: StudyTask, losses: int) -> tuple[StudyRow, ...]:
    """Rows of an episode whose workers were all lost."""
    return tuple(failed_rows(_visited(task), ERROR, f"{losses} workers were lost with this episode"))


def _rows(task: StudyTask) -> tuple[StudyRow, ...]:
    episode = execute(prepared_of(task), seed=task.seed)
    return tuple(episode_rows(episode, task.person, filtered=task.filtered))


def prepared_of(task: StudyTask) -> PlannedEpisode:
    """The planned episode of a task."""
    file = _scenario(task.base)
    profiles = {}
    if task.person is not None and task.profile is not None:
        profiles = {task.person: dict(task.profile)}
        person = file.scenario.people[task.person].model_copy(update={"comfort": _comfort(task)})
        people = {**file.scenario.people, task.person: person}
        file = replace(file, scenario=file.scenario.model_copy(update={"people": people}))
    return prepare(file, profiles=profiles, rulebook=_rulebook(task.base.rulebook), seed=task.seed)


def _visited(task: StudyTask) -> tuple[str, ...]:
    return _scenario(task.base).scenario.visited()


_SCENARIOS: dict[str, ScenarioFile] = {}
"""Cache of scenarios by the digest of their base."""


def _scenario(base: EpisodeBase) -> ScenarioFile:
    if base.digest not in _SCENARIOS:
        while len(_SCENARIOS) >= KEPT:
            del _SCENARIOS[next(iter(_SCENARIOS))]
        file = YamlFile(Path(), base.called, dict(base.scenario), {}, "", {})
        _SCENARIOS[base.digest] = ScenarioFile(file, file.check(Scenario))
    return _SCENARIOS[base.digest]


def _comfort(task: StudyTask) -> ComfortSpec | None:
    return None if task.comfort is None else ComfortSpec.model_validate(task.comfort)


@lru_cache(maxsize=KEPT)
def _rulebook(name_or_text: str) -> str:
    """A shipped name unchanged; for a text, the path of a temporary file, kept for the worker's lifetime."""
    if name_or_text in shipped_rulebooks():
        return name_or_text
    path = Path(_folder().name) / f"rulebook-{_rulebook.cache_info().misses}.yaml"
    path.write_text(name_or_text, encoding="utf-8", newline="\n")
    return str(path)


@lru_cache(maxsize=1)
def _folder() -> tempfile.TemporaryDirectory[str]:
    """A temporary folder, removed when the process ends."""
    return tempfile.TemporaryDirectory(prefix="comity-study-")
