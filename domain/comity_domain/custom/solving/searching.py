"""Fast Downward's search configuration for a domain it was not tuned for.

Greedy search comes first: it finds some plan if there is one, which remains if time or memory runs out. Each
search between it and the proof has its share of the time, because any of them may fail: on a large round trip
A* with h^FF never ends, while weighted A* with LM-cut takes a moment; in other domains it is the reverse.
Greedy search itself has no time limit: while no plan is known, Fast Downward takes an aborted search as proof
that there is none.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from comity_domain.custom.costs.classical import beyond_strips

if TYPE_CHECKING:
    from unified_planning.model import Problem

ANY_PLAN = "iterated([lazy_greedy([ff()])])"

_QUICK_SHARE = 1 / 8
"""Share of the time limit for each intermediate search (our choice)."""


def search_for(problem: Problem, time_limit_s: float) -> str:
    """The search for a classical problem with one integer cost per action.

    Args:
        problem: The problem.
        time_limit_s: Time for the whole engine run [s], > 0.
    """
    quick = f"max_time={_QUICK_SHARE * time_limit_s:.3f}"
    stages = [
        "lazy_greedy([ff()])",
        f"lazy_wastar([ff()],w=2,{quick})",
        f"eager_wastar([ff()],w=1,{quick})",
    ]
    if beyond_strips(problem):  # LM-cut does not support it
        stages += ["astar(blind())"]
    else:
        stages += [f"eager_wastar([lmcut()],w=2,{quick})", "astar(lmcut())"]
    return f"iterated([{','.join(stages)}],pass_bound=false)"
