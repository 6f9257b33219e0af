"""Which engines of unified-planning look at the metric of a problem.

What an engine says that it supports does not tell: many take a metric and leave it aside.
"""

from __future__ import annotations

from typing import Any

_ANSWERED_BY_COST = ("fast-downward", "lpg", "lpg-anytime")
"""They find no proof, and cheap plans all the same."""


def optimizes(engine: Any) -> bool:
    """Whether the one plan that an engine gives is the best by the metric, or looked for by it.

    Args:
        engine: The class of an engine of unified-planning.
    """
    from unified_planning.engines.mixins.oneshot_planner import OptimalityGuarantee

    return (
        bool(engine.is_oneshot_planner() and engine.satisfies(OptimalityGuarantee.SOLVED_OPTIMALLY))
        or _name(engine) in _ANSWERED_BY_COST
    )


def improves(engine: Any) -> bool:
    """Whether an engine that proves nothing gives one plan after another, each better by the metric.

    Args:
        engine: The class of an engine of unified-planning.
    """
    from unified_planning.engines.mixins.anytime_planner import AnytimeGuarantee

    return bool(
        not optimizes(engine)
        and engine.is_anytime_planner()
        and engine.ensures(AnytimeGuarantee.INCREASING_QUALITY)
    )


def _name(engine: Any) -> str:
    return str(getattr(engine, "name", "")).lower()
