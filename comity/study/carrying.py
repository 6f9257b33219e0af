"""Runners of a study's episodes: processes on this machine, or the workers of a cluster."""

from __future__ import annotations

from collections.abc import Callable, Generator, Iterator
from dataclasses import dataclass

from comity.study.worker import Installation, StudyTask, TaskDone

MOST_LOSSES = 10
"""Number of workers that may be lost on an episode before it counts as failed: one loss may be the machine's
fault, ten are not."""


@dataclass(frozen=True, slots=True)
class Ended:
    """Episodes that ended at the same time and are stored together."""

    done: tuple[TaskDone, ...]
    lost: int = 0
    """Number of workers lost meanwhile."""


@dataclass(frozen=True, slots=True)
class EpisodeRunner:
    """A way to run episodes.

    Leaving `carry_out` early, for whatever reason, ends the running episodes.
    """

    installed: Installation
    """Code and libraries of the workers."""
    carry_out: Callable[[Iterator[StudyTask]], Generator[Ended]]
