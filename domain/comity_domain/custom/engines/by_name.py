"""An engine of unified-planning by its name, on PDDL, in a process of its own (`solving/worker.py`)."""

from __future__ import annotations

import json
import sys
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from comity_domain.custom.engines.fast_downward import MEMORY_MB, GroundAction
from comity_domain.custom.engines.process import run_limited
from comity_domain.custom.engines.workspace import workspace
from comity_domain.errors import NoPlan, OutOfTime, PlanningFailed
from comity_fis.errors import InputError, Where, closest

GRACE_S = 3.0
"""So much longer than its limit an engine may take to start and to answer, before it is ended."""


@dataclass(frozen=True, slots=True)
class Answered:
    """What an engine found, in the words of the PDDL that it got."""

    actions: tuple[GroundAction, ...]
    optimal: bool
    """The engine says so."""
    metric_ignored: bool
    """The problem has a metric, and the engine did not look at it."""


def solve_pddl(
    engine: str,
    domain: str,
    problem: str,
    *,
    time_limit_s: float,
    whole: bool = True,
    memory_mb: int = MEMORY_MB,
) -> Answered:
    """The plan of an engine.

    Args:
        engine: Its name in unified-planning.
        domain: PDDL.
        problem: PDDL.
        time_limit_s: Wall-clock seconds for the engine, > 0.
        whole: Whether all numbers are whole.
        memory_mb: Megabytes of address space for it, > 0.

    Raises:
        NoPlan: There is none.
        PlanningFailed: None was found within the limits, or the engine broke.
    """
    with workspace() as folder:
        for name, text in (("domain", domain), ("problem", problem)):
            (folder / f"{name}.pddl").write_text(text, encoding="utf-8", newline="\n")
        command = [
            *(
                sys.executable,
                "-m",
                "comity_domain.custom.solving.worker",
                engine,
                "whole" if whole else "real",
            ),
            *(f"{time_limit_s:g}", str(memory_mb)),
        ]
        exit_code, log = run_limited(command, folder, time_limit_s + GRACE_S)
        answer = _read(folder / "plan.json")
    if answer is None:
        raise _broken(engine, exit_code, log, time_limit_s)
    if answer["plan"] is None:
        raise _none_found(engine, answer["status"], time_limit_s)
    actions = tuple(
        GroundAction(step["action"], tuple(step["arguments"]), step["start_s"], step["duration_s"])
        for step in answer["plan"]
    )
    ignored = answer["metric_ignored"]
    return Answered(actions, answer["status"] == "SOLVED_OPTIMALLY" and not ignored, metric_ignored=ignored)


def require_installed(engine: str) -> None:
    """Refuse an engine that unified-planning does not find.

    Args:
        engine: Its name there.

    Raises:
        InputError: naming those that it finds.
    """
    from unified_planning.environment import get_environment

    installed = sorted(name for name in get_environment().factory.engines if "[" not in name)
    if engine not in installed:
        known = closest(engine, ["comity", *installed])
        raise InputError(
            expected="the name of a planning engine that is installed",
            got=repr(engine),
            remedy=f"{known} Others come with packages such as up-fast-downward.",
            where=Where("--engine"),
        )


def _read(file: Path) -> Any:
    return json.loads(file.read_text(encoding="utf-8")) if file.exists() else None


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
