"""One case, planned and carried out."""

from __future__ import annotations

from functools import lru_cache
from typing import TYPE_CHECKING

from comity.live_episode import execute
from comity.preparation import PlannedEpisode, prepare

if TYPE_CHECKING:
    from comity.episode import Episode
    from comity.testing.trials.case import Case

MOST_STORED = 32
"""Episodes of a process that comparisons of profiles need not run again."""


@lru_cache(maxsize=MOST_STORED)
def attempted(case: Case) -> Episode:
    """Plan a case and carry it out.

    Raises:
        InputError: if anything that it names cannot be used.
        PlanningFailed: if there is no plan.
    """
    return execute(prepared_case(case), seed=case.seed)


def prepared_case(case: Case) -> PlannedEpisode:
    """A case with its plan, before the world moves."""
    return prepare(
        case.file,
        profiles=case.profiles,
        rulebook=case.rulebook,
        seed=case.seed,
        at=case.day,
        engine=case.engine,
    )
