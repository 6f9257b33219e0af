"""Planning and execution of one case."""

from __future__ import annotations

from functools import lru_cache
from typing import TYPE_CHECKING

from comity.live_episode import execute
from comity.preparation import PlannedEpisode, prepare

if TYPE_CHECKING:
    from comity.episode import Episode
    from comity.testing.trials.case import Case

MOST_STORED = 32
"""Maximum number of episodes cached by a process for comparisons of profiles."""


@lru_cache(maxsize=MOST_STORED)
def attempted(case: Case) -> Episode:
    """Plan and execute a case.

    Raises:
        InputError: if anything that the case names cannot be used.
        PlanningFailed: if there is no plan.
    """
    return execute(prepared_case(case), seed=case.seed)


def prepared_case(case: Case) -> PlannedEpisode:
    """A planned case, before execution."""
    return prepare(
        case.file,
        profiles=case.profiles,
        rulebook=case.rulebook,
        seed=case.seed,
        at=case.day,
        engine=case.engine,
    )
