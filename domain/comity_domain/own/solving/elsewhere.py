"""Numeric and durative problems, solved by whichever engine of unified-planning is installed and can.

The engine runs in a process of its own (`worker.py`), which gets the problem as PDDL and answers with JSON.
"""

from __future__ import annotations

import json
import sys
from typing import TYPE_CHECKING, NoReturn

from comity_domain.errors import NoEngine, NoPlan, OutOfTime, PlanningFailed
from comity_domain.own.costs.classical import MAXIMIZED, beyond_classical
from comity_domain.own.engines.fast_downward import MEMORY_MB, GroundAction, Solution
from comity_domain.own.engines.process import run_limited
from comity_domain.own.engines.workspace import workspace
from comity_domain.own.solving.lacking import lacking

if TYPE_CHECKING:
    from unified_planning.model import Problem

_PREFERRED = ("aries", "enhsp-opt", "enhsp", "tamer", "lpg", "symk-opt", "pyperplan")
"""Tried in this order; others that are installed come after them, in the order of their names."""

_FREE = "pip install up-aries (MIT; whole numbers and durations)"
_JAVA = "pip install up-enhsp (GPL-3, needs Java 17; numeric, no durations)"


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
    return ranked[0]


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
    problem: Problem, *, time_limit_s: float, memory_mb: int = MEMORY_MB
) -> tuple[str, Solution]:
    """The engine's name and its plan.

    Args:
        problem: Any that PDDL can say.
        time_limit_s: Wall-clock seconds for the engine, > 0.
        memory_mb: Megabytes of address space for it, > 0.

    Raises:
        NoPlan: There is none.
        PlanningFailed: None was found within the limits, or no engine can.
    """
    from unified_planning.io import PDDLWriter

    engine = engine_for(problem)
    writer = PDDLWriter(_taken_by(engine, problem))
    with workspace() as folder:
        for name, text in (("domain", writer.get_domain()), ("problem", writer.get_problem())):
            (folder / f"{name}.pddl").write_text(text, encoding="utf-8", newline="\n")
        whole = "whole" if not problem.kind.has_real_fluents() else "real"
        command = [
            *(sys.executable, "-m", "comity_domain.own.solving.worker", engine, whole),
            *(f"{time_limit_s:g}", str(memory_mb)),
        ]
        exit_code, log = run_limited(command, folder, time_limit_s + 3.0)
        file = folder / "plan.json"
        answer = json.loads(file.read_text(encoding="utf-8")) if file.exists() else None
    if answer is None:
        raise _broken(engine, exit_code, log, time_limit_s)
    if answer["plan"] is None:
        raise _none_found(engine, answer["status"], time_limit_s)
    actions = tuple(
        GroundAction(
            writer.get_item_named(step["action"]).name,
            tuple(writer.get_item_named(argument).name for argument in step["arguments"]),
            step["start_s"],
            step["duration_s"],
        )
        for step in answer["plan"]
    )
    return engine, Solution(actions, finished=answer["status"] == "SOLVED_OPTIMALLY")


def _taken_by(engine: str, problem: Problem) -> Problem:
    """The problem without costs of actions for aries, which fails on whatever has some."""
    if engine != "aries" or not any(one.is_minimize_action_costs() for one in problem.quality_metrics):
        return problem
    costless = problem.clone()
    costless.clear_quality_metrics()
    return costless


def _none_found(engine: str, status: str, time_limit_s: float) -> PlanningFailed:
    if status.startswith("UNSOLVABLE"):
        return NoPlan(
            f"no plan reaches all goals, says {engine}", remedy="Look for a goal that nothing leads to."
        )
    if status in ("TIMEOUT", "MEMOUT"):
        return OutOfTime(
            f"{engine} found no plan within its limits ({time_limit_s:g} s)",
            remedy="Allow more time, or ask for less at once.",
        )
    return PlanningFailed(
        f"{engine} ended without a plan ({status})", remedy="Plan with another engine, or change the domain."
    )


def _broken(engine: str, exit_code: int | None, log: str, time_limit_s: float) -> PlanningFailed:
    if exit_code is None:
        return _none_found(engine, "TIMEOUT", time_limit_s)
    last_lines = " / ".join(line.strip() for line in log.splitlines() if line.strip())[-300:]
    how = "was killed from outside" if exit_code < 0 else f"ended with exit code {exit_code} ({last_lines})"
    return PlanningFailed(f"{engine} {how}", remedy="Plan again, or with another engine.")
