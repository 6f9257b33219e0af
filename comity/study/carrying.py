"""What carries the episodes of a study out: processes here, or the workers of a cluster."""

from __future__ import annotations

from collections.abc import Callable, Generator, Iterator
from dataclasses import dataclass

from comity.study.worker import Installation, StudyTask, TaskDone

MOST_LOSSES = 10
"""Workers that an episode may lose before it counts as failed: one may be the machine's fault, not ten."""


@dataclass(frozen=True, slots=True)
class Ended:
    """Episodes that ended at the same time, to be written down together."""

    done: tuple[TaskDone, ...]
    lost: int = 0
    """Workers that were lost meanwhile."""


@dataclass(frozen=True, slots=True)
class EpisodeRunner:
    """A way to carry episodes out.

    Whatever leaves `carry_out` early ends what is under way.
    """

    installed: Installation
    """What the workers have installed."""
    carry_out: Callable[[Iterator[StudyTask]], Generator[Ended]]
