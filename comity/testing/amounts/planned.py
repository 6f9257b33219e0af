"""The plans of an episode: the first one and its replacements, each with the reason to replan."""

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
    """One plan, with the time from which it was executed."""

    since_s: float
    plan: Plan
    because: tuple[Cause, ...] = ()
    """Reasons to replan; empty for the first plan."""


def plans(episode: Episode) -> tuple[Planned, ...]:
    """All plans in order; updated parameters alone do not make a new plan."""
    times = (event.t for event in episode.events if event.status in TAKES_OVER)
    later = zip(times, episode.revisions, strict=True)
    return (
        Planned(0.0, episode.prepared.plan),
        *(Planned(since_s, each.plan, each.because) for since_s, each in later if each.replanned),
    )


def last_for(made: Sequence[Planned], person: str, action: str = "") -> Planned | None:
    """The last plan with a step for a person whose action starts with `action`, or None."""
    for each in reversed(made):
        if any(person in step.people and step.action.startswith(action) for step in each.plan.steps):
            return each
    return None
