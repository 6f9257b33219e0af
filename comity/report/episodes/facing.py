"""Angle between the robot's heading and the visited person, at rest: it may still turn while docking."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from comity_executor import Visit
    from comity_sim2d.metrics.stopping import Stopping


def facing_error_deg(visit: Visit, stopping: Stopping | None) -> float | None:
    """The angle [deg] at rest after docking; if it never rested, as it docked; None if it never docked."""
    if visit.docked_at is None:
        return None
    at_rest = stopping.robot_facing_error_deg if stopping else None
    return visit.docked_at.facing_error_deg if at_rest is None else at_rest
