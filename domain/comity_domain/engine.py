"""Running Fast Downward on a unified-planning problem, within a time limit, without leaving anything behind.

unified-planning writes the PDDL and reads the plan back. The process is ours: unified-planning's own runner
writes `output.sas` into the current folder, where two runs overwrite each other's, and lets the search go on
after Ctrl-C.
"""

from __future__ import annotations

import math
import os
import re
import signal
import sys
from dataclasses import dataclass
from importlib.util import find_spec
from pathlib import Path
from subprocess import PIPE, STDOUT, Popen, TimeoutExpired
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING

from comity_domain.errors import PlanningFailed

if TYPE_CHECKING:
    from unified_planning.model import Problem

ENGINE = "fast-downward"
"""The engine's name in unified-planning."""

SEARCH = "iterated([eager_wastar([ff()],w=1),eager_wastar([lmcut()],w=2),astar(lmcut())],pass_bound=false)"
"""Two quick searches, so that there is a plan when time runs out, then the one that proves the optimum.

On this domain A* with LM-cut expands hundreds of states where blind A* expands 150 000 (12 people, three
sides each), because every person still to be visited is a landmark with a least price.
"""

MEMORY_MB = 2048
"""What the engine may take, unless more or less is said."""

_UNSOLVABLE = (10, 11, 12)
"""Fast Downward's exit codes for "no plan", shown by the translator, the search, or an incomplete search."""


@dataclass(frozen=True, slots=True)
class Found:
    """The best plan of a search, as the engine wrote it."""

    text: str
    finished: bool
    """The search ended by itself, which proves the plan optimal; otherwise a limit ended it."""
    bound: int
    """What the search has proven that no plan costs less than; 0 where it proved nothing."""


@dataclass(frozen=True, slots=True)
class GroundAction:
    """An action of a plan, in the words of the planning problem."""

    name: str
    arguments: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Solution:
    """The best plan of a search, read back."""

    actions: tuple[GroundAction, ...]
    finished: bool
    """As in `Found`."""
    bound: int
    """As in `Found`."""


def solve(problem: Problem, *, time_limit_s: float, memory_mb: int = MEMORY_MB) -> Solution:
    """The cheapest plan for a unified-planning problem, or the best that was found in time.

    Args:
        problem: A classical problem with one integer fluent as each action's cost.
        time_limit_s: Wall-clock seconds for the engine, > 0.
        memory_mb: Megabytes for the engine, > 0.

    Raises:
        PlanningFailed: There is no plan, none was found in time, or the engine is missing or broke.
    """
    from unified_planning.io import PDDLReader, PDDLWriter

    writer = PDDLWriter(problem)
    texts = writer.get_domain(), writer.get_problem()
    found = search(*texts, time_limit_s=time_limit_s, memory_mb=memory_mb)
    plan = PDDLReader(problem.environment).parse_plan_string(problem, found.text, writer.get_item_named)
    actions = tuple(
        GroundAction(step.action.name, tuple(argument.object().name for argument in step.actual_parameters))
        for step in plan.actions
    )
    return Solution(actions, found.finished, found.bound)


def search(domain: str, problem: str, *, time_limit_s: float, memory_mb: int = MEMORY_MB) -> Found:
    """The same for PDDL texts.

    Raises:
        PlanningFailed: As `solve` does.
    """
    driver = _driver()
    with TemporaryDirectory(prefix="comity-plan-") as name:
        folder = Path(name)
        (folder / "domain.pddl").write_text(domain, encoding="utf-8")
        (folder / "problem.pddl").write_text(problem, encoding="utf-8")
        exit_code, log = _run(_command(driver, time_limit_s, memory_mb), folder, time_limit_s)
        text = _best_plan(folder)
    if text is None:
        raise _failure(exit_code, log, time_limit_s)
    return Found(text, finished=exit_code == 0, bound=_proven_bound(log))


def _command(driver: Path, time_limit_s: float, memory_mb: int) -> list[str]:
    """Fast Downward's driver; its own limit of CPU time ends a search whose parent was killed."""
    return [
        *(sys.executable, str(driver), "--plan-file", "plan"),
        *("--overall-time-limit", f"{math.ceil(time_limit_s) + 1}s"),
        *("--overall-memory-limit", f"{memory_mb}M"),
        *("domain.pddl", "problem.pddl", "--search", SEARCH),
    ]


def _driver() -> Path:
    package = find_spec("up_fast_downward")
    if package is None or not package.submodule_search_locations:
        raise PlanningFailed(
            "the planning engine Fast Downward is not installed",
            remedy="Install it with: pip install up-fast-downward.",
        )
    return Path(package.submodule_search_locations[0]) / "downward" / "fast-downward.py"


def _run(command: list[str], folder: Path, time_limit_s: float) -> tuple[int | None, str]:
    """The exit code, None where the limit ended it, and what was printed."""
    # The translator is Python, too: with a fixed hash seed it names and orders everything alike in every run.
    environment = {**os.environ, "PYTHONHASHSEED": "0"}
    with Popen(
        command, cwd=folder, env=environment, stdout=PIPE, stderr=STDOUT, text=True, start_new_session=True
    ) as process:
        try:
            log, _ = process.communicate(timeout=time_limit_s)
        except TimeoutExpired:
            return None, _end(process)
        finally:
            _end(process)
        return process.returncode, log


def _end(process: Popen[str]) -> str:
    """End the driver and the search below it, unless they already did; also when we were interrupted.

    Returns:
        What was printed until then.
    """
    if process.poll() is not None:
        return ""
    os.killpg(process.pid, signal.SIGKILL)
    log, _ = process.communicate()  # until the last of them has let go of its output
    return log


def _proven_bound(log: str) -> int:
    """The last layer that A* began: it alone prints any, and its heuristic never overrates."""
    layers = re.findall(r"\bf = (\d+)", log)
    return int(layers[-1]) if layers else 0


def _best_plan(folder: Path) -> str | None:
    """The text of the cheapest plan: each search writes one, and its cost last, unless it was cut short."""
    costs: dict[str, int] = {}
    for file in sorted(folder.glob("plan.*")):
        text = file.read_text(encoding="utf-8")
        if cost := re.search(r"^; cost = (\d+) ", text, re.MULTILINE):
            costs[text] = int(cost[1])
    return min(costs, key=lambda text: costs[text], default=None)


def _failure(exit_code: int | None, log: str, time_limit_s: float) -> PlanningFailed:
    if exit_code is None:
        return PlanningFailed(
            f"no plan was found within {time_limit_s:g} s",
            remedy="Allow more time, or ask for fewer people.",
        )
    if exit_code in _UNSOLVABLE:
        return PlanningFailed(
            "no plan visits everybody: the routes do not lead from one person to the next",
            remedy="Look at the map for a person who can only be reached by a detour that is blocked.",
        )
    last_lines = " / ".join(line.strip() for line in log.splitlines() if line.strip())[-300:]
    return PlanningFailed(
        f"Fast Downward ended with exit code {exit_code} ({last_lines})",
        remedy="Export the problem with plan_pddl and run the engine on it by hand.",
    )
