"""Numeric and durative problems, solved by whichever engine of unified-planning is installed and can.

The engine runs in a process of its own, which gets the problem as PDDL.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, NoReturn

from comity_domain.custom.costs.classical import MAXIMIZED, beyond_classical
from comity_domain.custom.engines.by_name import require_installed, solve_pddl
from comity_domain.custom.engines.fast_downward import MEMORY_MB, Solution
from comity_domain.custom.engines.metrics import improves, optimizes
from comity_domain.custom.engines.writing import writer_of
from comity_domain.custom.solving.lacking import lacking
from comity_domain.errors import NoEngine

if TYPE_CHECKING:
    from unified_planning.model import Problem

_PREFERRED = ("aries", "enhsp-opt", "enhsp", "tamer", "lpg", "symk-opt", "pyperplan")
"""Tried in this order; others that are installed come after them, in the order of their names."""

_FREE = "pip install up-aries (MIT; whole numbers and durations)"
_JAVA = "pip install up-enhsp (GPL-3, needs Java 17; numeric, no durations)"


@dataclass(frozen=True, slots=True)
class Elsewhere:
    """A plan, and who found it."""

    engine: str
    solution: Solution
    metric_ignored: bool
    """The problem has a metric, and the engine did not look at it."""


def engine_for(problem: Problem) -> str:
    """The name of an installed engine that can solve a problem.

    Raises:
        PlanningFailed: naming an engine to install.
    """
    factory = problem.environment.factory
    able: list[str] = [name for name in sorted(factory.engines) if "[" not in name and _can(problem, name)]
    ranked = [name for name in _PREFERRED if name in able] + [name for name in able if name not in _PREFERRED]
    if not ranked:
        _refuse(problem)
    if problem.quality_metrics:
        ranked.sort(key=lambda name: not _sees_metric(problem, name))
    return ranked[0]


def _named(engine: str, problem: Problem) -> str:
    """The engine that somebody asks for.

    Raises:
        InputError: It is not installed.
        NoEngine: It cannot take the problem.
    """
    require_installed(engine)
    if not _can(problem, engine):
        others = [name for name in sorted(problem.environment.factory.engines) if _can(problem, name)]
        remedy = (
            f"Leave --engine out, or take one of: {', '.join(others)}." if others else "Leave --engine out."
        )
        raise NoEngine(f"the engine {engine} does not take this problem", remedy=remedy)
    return engine


def _sees_metric(problem: Problem, name: str) -> bool:
    """Whether an engine looks at the metric; aries breaks on costs of actions, and then leaves them aside."""
    engine = problem.environment.factory.engine(name)
    by_costs = problem.quality_metrics[0].is_minimize_action_costs()
    return optimizes(engine) or (improves(engine) and not (name == "aries" and by_costs))


def _can(problem: Problem, name: str) -> bool:
    try:
        engine = problem.environment.factory.engine(name)
    except Exception:  # an engine that does not even load, whatever its reason, is none
        return False
    return bool(engine.is_oneshot_planner() and engine.supports(problem.kind))


def _has_aries(problem: Problem) -> bool:
    return "aries" in problem.environment.factory.engines


def _refuse(problem: Problem) -> NoReturn:
    beyond, lack = beyond_classical(problem), lacking(problem)
    durative = problem.kind.has_continuous_time() or problem.kind.has_discrete_time()
    install = f"Install one: {_FREE}." if durative else f"Install one: {_FREE}, or {_JAVA}."
    if beyond == MAXIMIZED:
        install = f"Minimize what is lost instead, which needs no other engine; or: {_JAVA}."
    elif lack is not None:
        has = "is installed, and" if _has_aries(problem) else "could be installed, and"
        beyond = f"{beyond}; aries {has} takes no {lack.what}"
        first = lack.remedy if _has_aries(problem) else f"{lack.remedy}, and {_FREE}"
        install = f"{first}." if durative else f"{first}; or: {_JAVA}."
    raise NoEngine(f"no engine that is installed solves this problem, which has {beyond}", remedy=install)


def solve_elsewhere(
    problem: Problem, *, engine: str | None = None, time_limit_s: float, memory_mb: int = MEMORY_MB
) -> Elsewhere:
    """What an engine finds.

    Args:
        problem: Any that PDDL can say.
        engine: Its name in unified-planning; None takes one that can, by preference one that looks at the
            problem's metric.
        time_limit_s: Wall-clock seconds for the engine, > 0.
        memory_mb: Megabytes of address space for it, > 0.

    Raises:
        NoPlan: There is none.
        PlanningFailed: None was found within the limits, or no engine can.
    """
    engine = engine_for(problem) if engine is None else _named(engine, problem)
    writer = writer_of(problem)
    found = solve_pddl(
        engine,
        writer.get_domain(),
        writer.get_problem(),
        whole=not problem.kind.has_real_fluents(),
        time_limit_s=time_limit_s,
        memory_mb=memory_mb,
    )
    actions = tuple(
        replace(
            step,
            name=writer.get_item_named(step.name).name,
            arguments=tuple(writer.get_item_named(argument).name for argument in step.arguments),
        )
        for step in found.actions
    )
    return Elsewhere(engine, Solution(actions, finished=found.optimal), metric_ignored=found.metric_ignored)
