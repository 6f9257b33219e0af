"""How far past a person the robot looks whom it visits, at rest: as it docks it may turn still."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from comity.episode import Episode
    from comity_executor import Visit


def facing_error_deg(episode: Episode, visit: Visit) -> float | None:
    """At the rest in which it docked; where it never rested as it docked; None where it never did."""
    if visit.docked_at is None:
        return None
    stopping = episode.metrics.stopping.get(visit.person)
    at_rest = stopping.robot_facing_error_deg if stopping else None
    return visit.docked_at.facing_error_deg if at_rest is None else at_rest
