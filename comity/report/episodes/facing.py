"""How far past a person the robot looks whom it visits, at rest: as it docks it may turn still."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from comity_executor import Visit
    from comity_sim2d.metrics.stopping import Stopping


def facing_error_deg(visit: Visit, stopping: Stopping | None) -> float | None:
    """At the rest in which it docked; where it never rested as it docked; None where it never did."""
    if visit.docked_at is None:
        return None
    at_rest = stopping.robot_facing_error_deg if stopping else None
    return visit.docked_at.facing_error_deg if at_rest is None else at_rest
