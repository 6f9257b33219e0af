"""How Fast Downward looks for a plan in a domain that it was not tuned for.

Greedy search comes first: it finds some plan where there is one, and that is what is left when time or memory
runs out. Each search between it and the proof has its share of the time, because any of them may be hopeless:
on a large round trip A* with h^FF never ends, where weighted A* with LM-cut takes a moment; elsewhere it is
the other way round. Greedy search itself has no such limit: where no plan is known yet, Fast Downward takes a
search that was cut off for the proof that there is none.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from comity_domain.custom.costs.classical import beyond_strips

if TYPE_CHECKING:
    from unified_planning.model import Problem

ANY_PLAN = "iterated([lazy_greedy([ff()])])"

_QUICK_SHARE = 1 / 8
"""Of the time limit, for each of the searches between (our choice)."""


def search_for(problem: Problem, time_limit_s: float) -> str:
    """The search for a classical problem with one whole number as each action's cost.

    Args:
        problem: It.
        time_limit_s: For all of the engine, > 0.
    """
    quick = f"max_time={_QUICK_SHARE * time_limit_s:.3f}"
    stages = [
        "lazy_greedy([ff()])",
        f"lazy_wastar([ff()],w=2,{quick})",
        f"eager_wastar([ff()],w=1,{quick})",
    ]
    if beyond_strips(problem):  # LM-cut does not know it
        stages += ["astar(blind())"]
    else:
        stages += [f"eager_wastar([lmcut()],w=2,{quick})", "astar(lmcut())"]
    return f"iterated([{','.join(stages)}],pass_bound=false)"
