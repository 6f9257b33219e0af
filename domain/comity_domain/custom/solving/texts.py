"""PDDL that is at hand as text, solved by an engine that is named, in one process that ends at the limit."""

from __future__ import annotations

from functools import partial

from comity_domain.custom.process import in_one_process
from comity_domain.custom.reading.reading import fresh_environment
from comity_domain.custom.solving.engines import solve
from comity_domain.custom.solving.solution import Solution


def solve_pddl(engine: str, domain: str, problem: str, *, time_limit_s: float) -> Solution:
    """The plan of an engine, in the words of the PDDL.

    Args:
        engine: Its name in unified-planning.
        domain: PDDL that unified-planning's reader takes, with whole numbers alone.
        problem: Likewise.
        time_limit_s: Wall-clock seconds for the engine, > 0.

    Raises:
        NoPlan: There is none.
        PlanningFailed: None was found within the limit, or the engine broke.
    """
    call = partial(_solved, engine, domain, problem, time_limit_s)
    return in_one_process(call, limit_s=time_limit_s)


def _solved(engine: str, domain: str, problem: str, time_limit_s: float) -> Solution:
    from unified_planning.io import PDDLReader

    with fresh_environment(whole=True) as environment:
        read = PDDLReader(environment).parse_problem_string(domain, problem)
        return solve(read, engine=engine, time_limit_s=time_limit_s)
