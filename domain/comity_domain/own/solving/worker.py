"""The process of an engine: `python -m comity_domain.own.solving.worker ENGINE whole|real SECONDS MEGABYTES`.

Reads `domain.pddl` and `problem.pddl` in the current folder and writes `plan.json` there.
"""

from __future__ import annotations

import json
import sys
from contextlib import suppress
from pathlib import Path
from typing import Any

from comity_domain.own.pddl.reading import deep_enough, own_environment


def main() -> None:
    """Solve one problem."""
    engine, numbers, seconds, megabytes = sys.argv[1:]
    _limit_memory(int(megabytes) * 1_000_000)
    answer = _solved(engine, whole=numbers == "whole", time_limit_s=float(seconds))
    part = Path("plan.part")
    part.write_text(json.dumps(answer), encoding="utf-8", newline="\n")
    part.replace("plan.json")


def _limit_memory(limit_bytes: int) -> None:
    """Limit the address space, where the system can: Windows has no such limit, macOS refuses this one."""
    try:
        import resource
    except ImportError:
        return
    with suppress(ValueError, OSError):
        resource.setrlimit(resource.RLIMIT_AS, (limit_bytes, limit_bytes))


def _solved(engine: str, *, whole: bool, time_limit_s: float) -> dict[str, Any]:
    from unified_planning.io import PDDLReader

    with own_environment(whole=whole) as environment:
        with deep_enough():
            problem = PDDLReader(environment).parse_problem("domain.pddl", "problem.pddl")
        with environment.factory.OneshotPlanner(name=engine) as planner:
            result = planner.solve(problem, timeout=time_limit_s)
    plan = None if result.plan is None else _steps(result.plan)
    return {"status": result.status.name, "plan": plan}


def _steps(plan: Any) -> list[dict[str, Any]]:
    timed = getattr(plan, "timed_actions", None)
    if timed is None:
        return [_step(action, None, None) for action in plan.actions]
    return [_step(action, start, duration) for start, action, duration in timed]


def _step(action: Any, start: Any, duration: Any) -> dict[str, Any]:
    return {
        "action": action.action.name,
        "arguments": [argument.object().name for argument in action.actual_parameters],
        "start_s": None if start is None else float(start),
        "duration_s": None if duration is None else float(duration),
    }


if __name__ == "__main__":
    main()
