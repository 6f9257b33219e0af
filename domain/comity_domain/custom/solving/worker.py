"""The process of an engine.

`python -m comity_domain.custom.solving.worker ENGINE whole|real SECONDS MEGABYTES` reads `domain.pddl` and
`problem.pddl` in the current folder and writes `plan.json` there.
"""

from __future__ import annotations

import json
import os
import sys
import time
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING, Any

from comity_domain.custom.engines.metrics import improves, optimizes
from comity_domain.custom.reading.reading import fresh_environment

if TYPE_CHECKING:
    from unified_planning.model import Problem


def main() -> None:
    """Solve one problem."""
    engine, numbers, seconds, megabytes = sys.argv[1:]
    _limit_java(int(megabytes))
    _limit_memory(int(megabytes) * 1_000_000)
    for answer in _answers(engine, whole=numbers == "whole", time_limit_s=float(seconds)):
        part = Path("plan.part")
        part.write_text(json.dumps(answer), encoding="utf-8", newline="\n")
        part.replace("plan.json")


def _limit_java(limit_mb: int) -> None:
    """Let Java take little enough of the address space to start under the limit: by default it reserves more.

    What the user's own `JAVA_TOOL_OPTIONS` say comes after, and so wins.
    """
    ours = f"-Xmx{limit_mb // 4}m -XX:CompressedClassSpaceSize=64m -XX:ReservedCodeCacheSize=64m"
    os.environ["JAVA_TOOL_OPTIONS"] = f"{ours} {os.environ.get('JAVA_TOOL_OPTIONS', '')}".strip()


def _limit_memory(limit_bytes: int) -> None:
    """Limit the address space, where the system can: Windows has no such limit, macOS refuses this one."""
    try:
        import resource
    except ImportError:
        return
    with suppress(ValueError, OSError):
        resource.setrlimit(resource.RLIMIT_AS, (limit_bytes, limit_bytes))


def _answers(engine: str, *, whole: bool, time_limit_s: float) -> Iterator[dict[str, Any]]:
    """Each better than the one before."""
    from unified_planning.io import PDDLReader

    until = time.monotonic() + time_limit_s
    with fresh_environment(whole=whole) as environment:
        sys.setrecursionlimit(10_000)
        problem = PDDLReader(environment).parse_problem("domain.pddl", "problem.pddl")
        found = False
        if problem.quality_metrics and improves(environment.factory.engine(engine)):
            for answer in _better_and_better(engine, problem, until):
                found = True
                yield answer
        if not found:
            yield _once(engine, problem, until)


def _better_and_better(engine: str, problem: Problem, until: float) -> Iterator[dict[str, Any]]:
    """None where the engine breaks on the metric, as aries does on costs that depend on objects."""
    factory = problem.environment.factory
    with suppress(Exception), factory.AnytimePlanner(name=engine) as planner:  # whatever it breaks with
        for result in planner.get_solutions(problem, timeout=until - time.monotonic()):
            if result.plan is not None:
                yield _answer(result, metric_ignored=False)


def _once(engine: str, problem: Problem, until: float) -> dict[str, Any]:
    factory = problem.environment.factory
    ignored = bool(problem.quality_metrics) and not optimizes(factory.engine(engine))
    if ignored and improves(factory.engine(engine)):
        problem.clear_quality_metrics()  # it broke on it
    with factory.OneshotPlanner(name=engine) as planner:
        result = planner.solve(problem, timeout=max(until - time.monotonic(), 0.1))
    return _answer(result, metric_ignored=ignored)


def _answer(result: Any, *, metric_ignored: bool) -> dict[str, Any]:
    plan = None if result.plan is None else _steps(result.plan)
    return {"status": result.status.name, "plan": plan, "metric_ignored": metric_ignored}


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
