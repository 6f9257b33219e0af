"""The process of an engine: `python -m comity_domain.own.solving.worker ENGINE whole|real SECONDS MEGABYTES`.

Reads `domain.pddl` and `problem.pddl` in the current folder and writes `plan.json` there.
"""

from __future__ import annotations

import json
import resource
import sys
from pathlib import Path
from typing import Any

from comity_domain.own.pddl.reading import deep_enough, own_environment


def main() -> None:
    """Solve one problem."""
    engine, numbers, seconds, megabytes = sys.argv[1:]
    limit = int(megabytes) * 1_000_000
    resource.setrlimit(resource.RLIMIT_AS, (limit, limit))
    answer = _solved(engine, whole=numbers == "whole", time_limit_s=float(seconds))
    part = Path("plan.part")
    part.write_text(json.dumps(answer), encoding="utf-8")
    part.replace("plan.json")


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
