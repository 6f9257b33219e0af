"""Converts a scenario's limits to those of an execution."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from comity_executor import Limits

if TYPE_CHECKING:
    from comity import scenario as written


def limits_of(limits: written.LimitsSpec, *, attend_s: float) -> Limits:
    """The limits of the tree.

    Args:
        limits: Limits in the scenario.
        attend_s: Time for watching each person's reaction [s].
    """
    return replace(
        Limits.attentive(attend_s),
        replans=limits.replans,
        replan_pause_s=limits.replan_pause_s,
        patience_s=limits.patience_s,
        reach_timeout_s=limits.reach_s,
        reach_attempts=limits.reach_attempts,
        act_timeout_s=limits.act_s,
        act_pause_s=limits.act_pause_s,
        blocked_s=limits.blocked_s,
        passing_s=limits.passing_s,
        detour_m=limits.detour_m,
        unseen_s=limits.unseen_s,
    )
