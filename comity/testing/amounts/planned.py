"""The plans of an episode: the first one, and those that took its place, each with why it was made."""

from __future__ import annotations

from collections.abc import Sequence
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


def plans(episode: Episode) -> tuple[Planned, ...]:
    """All of them in order; the same plan with new numbers is no other."""
    times = (event.t for event in episode.events if event.status in TAKES_OVER)
    later = zip(times, episode.revisions, strict=True)
    return (
        Planned(0.0, episode.prepared.plan),
        *(Planned(since_s, each.plan, each.because) for since_s, each in later if each.replanned),
    )


def last_for(made: Sequence[Planned], person: str, action: str = "") -> Planned | None:
    """The last of these plans with a step for a person whose action begins so; None where none has."""
    for each in reversed(made):
        if any(person in step.people and step.action.startswith(action) for step in each.plan.steps):
            return each
    return None
