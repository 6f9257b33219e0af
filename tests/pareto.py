"""What references for plans share, which know nothing of how the software plans."""

from __future__ import annotations

import math


def pareto(ways):
    """Those that no other one beats in cost and time."""
    kept, soonest = set(), math.inf
    for cost, seconds in sorted(ways):
        if seconds < soonest:
            kept.add((cost, seconds))
            soonest = seconds
    return kept
