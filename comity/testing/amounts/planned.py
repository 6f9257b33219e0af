"""The plans of an episode: the first one, and those that took its place, each with why it was made."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

from comity.monitoring.measuring import TAKES_OVER

if TYPE_CHECKING:
    from comity.episode import Episode
    from comity_domain import Plan
    from comity_executor import Cause


@dataclass(frozen=True, slots=True)
class Planned:
    """One plan, from when on it was carried out."""

    since_s: float
    plan: Plan
    because: tuple[Cause, ...] = ()
    """Empty for the first."""


def plans(episode: Episode) -> Iterator[Planned]:
    """All of them in order; the same plan with new numbers is no other."""
    yield Planned(0.0, episode.prepared.plan)
    times = (event.t for event in episode.events if event.status in TAKES_OVER)
    for since_s, revision in zip(times, episode.revisions, strict=True):
        if revision.replanned:
            yield Planned(since_s, revision.plan, revision.because)


def last_for(episode: Episode, person: str, action: str = "") -> Planned | None:
    """The last plan with a step for a person that does something of that name; None where none has."""
    return next(
        (
            each
            for each in reversed([*plans(episode)])
            if any(person in step.people and step.action.startswith(action) for step in each.plan.steps)
        ),
        None,
    )
