"""Solves a problem with an engine of unified-planning: the best plan found within the time limit.

Engines write to the current folder, start processes and keep time limits only roughly, so all of this is
meant to run in the child process that ends at the limit (`comity_domain.custom.process`).
"""

from __future__ import annotations

import re
import tempfile
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import chdir
from fractions import Fraction
from queue import Empty, Queue
from typing import TYPE_CHECKING, Any

from comity_domain.custom.reading.reading import as_global
from comity_domain.custom.solving.choosing import (
    FAST_DOWNWARD,
    broken_off,
    engine_for,
    improves,
    installed,
    optimizes,
    without_quantifiers,
)
from comity_domain.custom.solving.searching import ANY_PLAN, search_for
from comity_domain.custom.solving.solution import Solution, ground_actions
from comity_domain.custom.solving.stated import stated
from comity_domain.errors import NoEngine, NoPlan, PlanningFailed, out_of_time

if TYPE_CHECKING:
    from unified_planning.model import Problem

GRACE_S = 1.5
"""Time beyond its limit that an engine gets to end by itself and answer [s] (our choice)."""
LEAST_S = 0.1
"""Minimum time that an engine gets, even if the budget is used up [s] (our choice)."""
EPSILON = Fraction(1, 1000)
"""Minimum time between the end of an action and the start of a dependent one, if the problem states none [s]
(our choice); aries alone would take 0.1 s."""


def solve(
    problem: Problem, *, engine: str | None = None, time_limit_s: float, any_plan: bool = False
) -> Solution:
    """Solve a problem with an engine.

    Args:
        problem: Any problem that PDDL can express.
        engine: Its name in unified-planning; if None or not installed, a suitable one is chosen, preferably
            one that respects the metric.
        time_limit_s: Wall-clock time for the engine [s], > 0.
        any_plan: Whether Fast Downward stops at its first plan.

    Raises:
        NoPlan: There is no plan.
        PlanningFailed: No plan was found within the limit, or no engine supports the problem.
    """
    name, problem, back = _chosen(problem, engine)
    search = ANY_PLAN if any_plan else search_for(problem, time_limit_s)
    runs = _fast_downward if name == FAST_DOWNWARD else _other
    copy = stated(problem) if _writes_pddl(problem, name) else problem.clone()
    if copy.epsilon is None and copy.kind.has_continuous_time():
        copy.epsilon = EPSILON
    results = runs(copy, name, search, time.monotonic() + time_limit_s)
    best, last, ignored = None, None, False
    with (
        tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as folder,
        chdir(folder),
        as_global(problem.environment),
    ):
        try:
            for last, ignored in _in_time(results, time_limit_s + GRACE_S):  # noqa: B007 - the last one counts
                if last.plan is not None and (best is None or _is_better(last.plan, best, copy, name)):
                    best = last.plan
        except Exception as broke:  # an engine may fail with any exception
            text = " ".join(f"{type(broke).__name__}: {broke}".split())[:200]
            raise broken_off(name, problem, text) from None
    if best is None:
        raise _none_found(name, last, time_limit_s)
    best = best.replace_action_instances(back) if back else best
    return _solution(name, best, last, ignored=ignored)


Back = Callable[[Any], Any]
"""Maps an action of the compiled problem to the original one."""


def _chosen(problem: Problem, engine: str | None) -> tuple[str, Problem, Back | None]:
    """The engine, and the problem it gets: compiled if no engine supports the original."""
    if engine is not None and engine in installed(problem.environment.factory):
        return engine, problem, None
    try:
        return engine_for(problem), problem, None
    except NoEngine:
        compiled, back = without_quantifiers(problem) or (None, None)
        if compiled is None:
            raise
        try:
            return engine_for(compiled), compiled, back
        except NoEngine:
            pass
        raise  # the original problem is the user's own


def _writes_pddl(problem: Problem, name: str) -> bool:
    from unified_planning.engines import PDDLPlanner

    return issubclass(problem.environment.factory.engine(name), PDDLPlanner)


Results = Iterator[tuple[Any, bool]]
"""Results of unified-planning, each with whether the engine ignored the metric."""


def _fast_downward(problem: Problem, name: str, search: str, until: float) -> Results:
    """Plans in the order in which the searches find them; the last result has the exit status."""
    params = {"fast_downward_anytime_search_config": search}
    with problem.environment.factory.AnytimePlanner(name=name, params=params) as planner:
        planner.skip_checks = True  # functions that nothing reads do not matter
        for result in planner.get_solutions(problem, timeout=_left(until)):
            yield result, False


def _other(problem: Problem, name: str, _: str, until: float) -> Results:
    """Successively better plans from an anytime engine; one plan from any other."""
    factory = problem.environment.factory
    engine = factory.engine(name)
    if problem.quality_metrics and improves(engine):
        found = False
        try:
            with factory.AnytimePlanner(name=name) as planner:
                for result in planner.get_solutions(problem, timeout=_left(until)):
                    found |= result.plan is not None
                    yield result, False
        except Exception:  # aries fails on costs that depend on objects
            if found:
                return
        if found:
            return
    ignored = bool(problem.quality_metrics) and not optimizes(engine)
    if ignored and improves(engine):
        problem.clear_quality_metrics()  # the engine failed on it
    with factory.OneshotPlanner(name=name) as planner:
        planner.skip_checks = True  # functions that nothing reads do not matter
        yield planner.solve(problem, timeout=_left(until)), ignored


def _left(until: float) -> float:
    return max(until - time.monotonic(), LEAST_S)


def _in_time(results: Results, seconds: float) -> Results:
    """The results that arrive in time; the engine runs in a thread that may be abandoned."""
    queue: Queue[tuple[Any, bool] | Exception | None] = Queue()

    def run() -> None:
        try:
            for result in results:
                queue.put(result)
            queue.put(None)
        except Exception as broke:
            queue.put(broke)

    threading.Thread(target=run, daemon=True).start()
    until = time.monotonic() + seconds
    while True:
        try:
            found = queue.get(timeout=_left(until))
        except Empty:
            return
        if found is None:
            return
        if isinstance(found, Exception):
            raise found
        yield found


def _is_better(plan: Any, than: Any, problem: Problem, name: str) -> bool:
    """Whether a plan costs no more: at equal cost the later, proven one counts; it is deterministic."""
    return name != FAST_DOWNWARD or _cost(plan, problem) <= _cost(than, problem)


def _cost(plan: Any, problem: Problem) -> int:
    metric = problem.quality_metrics[0] if problem.quality_metrics else None
    if metric is None or not metric.is_minimize_action_costs():
        return len(plan.actions)
    total = 0
    for action in plan.actions:
        cost: Any = metric.get_action_cost(action.action)
        if cost.is_fluent_exp():
            chosen = dict(zip(action.action.parameters, action.actual_parameters, strict=True))
            objects = (chosen[one.parameter()] if one.is_parameter_exp() else one for one in cost.args)
            cost = problem.initial_value(cost.fluent()(*objects))
        total += cost.constant_value()
    return total


def _solution(name: str, plan: Any, last: Any, *, ignored: bool) -> Solution:
    """The best plan, with what the last result says about optimality."""
    actions, status, log = tuple(ground_actions(plan)), last.status.name, _log(last)
    if name == FAST_DOWNWARD:
        finished = status.startswith("SOLVED") and "search exit code: 0" in log
        return Solution(name, actions, finished, bound=_proven_bound(log), killed=status == "INTERNAL_ERROR")
    return Solution(name, actions, status == "SOLVED_OPTIMALLY" and not ignored, metric_ignored=ignored)


def _log(result: Any) -> str:
    return "".join(message.message for message in result.log_messages or ())


def _proven_bound(log: str) -> int:
    """The initial LM-cut value or the last f-layer that A* began: both are admissible lower bounds.

    Only A* prints layers.
    """
    return max(map(int, re.findall(r"(?:\bf = |heuristic value for lmcut: )(\d+)", log)), default=0)


_MEMORY = ("MemoryError", "emergency_memory", "memory limit has been reached")


def _none_found(name: str, last: Any, time_limit_s: float) -> PlanningFailed:
    status = "TIMEOUT" if last is None else last.status.name
    log = "" if last is None else _log(last)
    if status.startswith("UNSOLVABLE"):
        remedy = "Look for a goal that nothing leads to."
        said = "" if name == FAST_DOWNWARD else f", says {name}"
        return NoPlan(f"no plan reaches all goals{said}", remedy=remedy)
    if status == "MEMOUT" or any(sign in log for sign in _MEMORY):
        reason = f"{name} found no plan within its memory"
        return PlanningFailed(reason, remedy="Ask for less at once.", cut_off=True)
    if status in ("TIMEOUT", "INTERMEDIATE"):
        return out_of_time(time_limit_s)
    if name == FAST_DOWNWARD and re.search(r"exit code: -\d|^$", log.strip()):
        remedy = "Plan again; where memory is short, the system ends the largest process."
        return PlanningFailed(f"{name} was killed from outside before it found a plan", remedy=remedy)
    lines = " / ".join(line.strip() for line in log.splitlines() if line.strip())[-300:]
    said = f"{status}: {lines}" if lines else status
    return PlanningFailed(
        f"{name} ended without a plan ({said})", remedy="Plan with another engine, or change the domain."
    )
