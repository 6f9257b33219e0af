"""Run Fast Downward on a unified-planning problem, within a time limit, without leaving anything behind.

unified-planning writes the PDDL and reads the plan back. The process is ours: unified-planning's own runner
writes `output.sas` into the current folder, where two runs overwrite each other's, and lets the search go on
after Ctrl-C.
"""

from __future__ import annotations

import math
import re
import sys
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING

from comity_domain.custom.engines.process import run_limited
from comity_domain.custom.engines.workspace import workspace
from comity_domain.custom.engines.writing import writer_of
from comity_domain.errors import NoPlan, PlanningFailed, out_of_time

if TYPE_CHECKING:
    from unified_planning.model import Problem

ENGINE = "fast-downward"
"""The engine's name in unified-planning."""


@dataclass(frozen=True, slots=True)
class Search:
    """What Fast Downward is asked for: quick searches that leave a plan, then one that proves the optimum."""

    text: str
    """As Fast Downward writes it; plans that are found are not to bound what later searches look for."""
    is_timed: bool = False
    """The quick ones are cut off by the clock, so that of plans that cost the same the last one counts: the
    proof's own, which no clock has a part in. Otherwise the first one does."""


MEMORY_MB = 2048
"""Of one search, the translation included."""

_UNSOLVABLE = (10, 11, 12)
"""Fast Downward's exit codes for "no plan", shown by the translator, the search, or an incomplete search."""
_OUT_OF_MEMORY = (20, 22, 24)
_NO_MEMORY_TO_TRANSLATE = ("MemoryError", "emergency_memory")
"""What the translator's last words hold where the limit is reached while it works."""
_NOT_STARTED, _STARTS_MB = (30, 127), 40
"""With less memory the translator, which is Python, may end so as it starts, with whatever words: with Python
3.13 it did at 8 to 16 MB."""
_OUT_OF_TIME = (21, 23)
_KILLED = range(128, 256)
"""The driver passes the signal that ended the search on like a shell does."""


@dataclass(frozen=True, slots=True)
class Found:
    """The best plan of a search, as the engine wrote it."""

    text: str
    finished: bool
    """The search ended by itself, which proves the plan optimal; otherwise a limit ended it."""
    bound: int
    """What the search has proven that no plan costs less than; 0 where it proved nothing."""
    killed: bool = False
    """Somebody else ended the search: there might have been time for more."""


@dataclass(frozen=True, slots=True)
class GroundAction:
    """An action of a plan, in the words of the planning problem."""

    name: str
    arguments: tuple[str, ...]
    start_s: float | None = None
    """When it starts; None where the plan is a mere order."""
    duration_s: float | None = None


@dataclass(frozen=True, slots=True)
class Solution:
    """The best plan of a search, read back."""

    actions: tuple[GroundAction, ...]
    finished: bool
    """As in `Found`."""
    bound: int = 0
    """As in `Found`."""
    killed: bool = False
    """As in `Found`."""


def solve(
    problem: Problem, *, time_limit_s: float, search_for: Search, memory_mb: int = MEMORY_MB
) -> Solution:
    """The cheapest plan for a unified-planning problem, or the best that was found within the limits.

    Args:
        problem: A classical problem with one integer fluent as each action's cost.
        time_limit_s: Wall-clock seconds for the engine, > 0.
        search_for: How it is looked for.
        memory_mb: Megabytes for the engine, > 0.

    Raises:
        NoPlan: There is none.
        PlanningFailed: None was found within the limits, or the engine is missing or broke.
    """
    writer = writer_of(problem)
    texts = writer.get_domain(), writer.get_problem()
    found = search(*texts, time_limit_s=time_limit_s, memory_mb=memory_mb, search_for=search_for)
    actions = tuple(
        GroundAction(*_named(words, lambda word: writer.get_item_named(word).name))
        for words in ground_actions(found.text)
    )
    return Solution(actions, found.finished, found.bound, found.killed)


def _named(words: list[str], name_of: Callable[[str], str]) -> tuple[str, tuple[str, ...]]:
    name, *arguments = map(name_of, words)
    return name, tuple(arguments)


def ground_actions(text: str) -> Iterator[list[str]]:
    """A plan as the engine wrote it: on each line an action with its words, and a comment at the end."""
    return (line.strip("()").split() for line in text.splitlines() if line.startswith("("))


def search(
    domain: str,
    problem: str,
    *,
    time_limit_s: float,
    search_for: Search,
    memory_mb: int = MEMORY_MB,
) -> Found:
    """The same for PDDL texts.

    Raises:
        NoPlan: As `solve` does.
        PlanningFailed: As `solve` does.
    """
    script = driver()
    with workspace() as folder:
        (folder / "domain.pddl").write_text(domain, encoding="utf-8", newline="\n")
        (folder / "problem.pddl").write_text(problem, encoding="utf-8", newline="\n")
        command = _command(script, time_limit_s, memory_mb, search_for)
        exit_code, log = run_limited(command, folder, time_limit_s)
        text = _best_plan(folder, last=search_for.is_timed)
    if text is None:
        raise _failure(exit_code, log, time_limit_s, memory_mb)
    return Found(text, exit_code == 0, _proven_bound(log), killed=_was_killed(exit_code))


def _command(driver: Path, time_limit_s: float, memory_mb: int, search_for: Search) -> list[str]:
    """Fast Downward's driver; its own limit of CPU time ends a search whose parent was killed.

    It refuses limits where the system has none: of time on Windows, of memory there and on macOS.
    """
    time, memory = f"{math.ceil(time_limit_s) + 1}s", f"{memory_mb}M"
    has_limits = find_spec("resource") is not None
    return [
        *(sys.executable, str(driver), "--plan-file", "plan"),
        *(("--overall-time-limit", time) if has_limits else ()),
        *(("--overall-memory-limit", memory) if has_limits and sys.platform != "darwin" else ()),
        *("domain.pddl", "problem.pddl", "--search", search_for.text),
    ]


def driver() -> Path:
    """The script that runs Fast Downward.

    Raises:
        PlanningFailed: It is not installed.
    """
    package = find_spec("up_fast_downward")
    if package is None or not package.submodule_search_locations:
        raise PlanningFailed(
            "a custom domain needs the planning engine Fast Downward, which is not installed",
            remedy="Install it with: pip install 'comity[fast-downward]'.",
        )
    return Path(package.submodule_search_locations[0]) / "downward" / "fast-downward.py"


def _proven_bound(log: str) -> int:
    """What LM-cut says of the start, or the last layer that A* began: neither ever overrates.

    A* alone prints layers.
    """
    return max(map(int, re.findall(r"(?:\bf = |heuristic value for lmcut: )(\d+)", log)), default=0)


def _best_plan(folder: Path, *, last: bool) -> str | None:
    """The text of the cheapest plan: each search writes one, and its cost last, unless it was cut short.

    Args:
        folder: Where they are.
        last: Whether the last one of several counts, and not the first.
    """
    costs: dict[str, int] = {}
    for file in sorted(folder.glob("plan.*"), reverse=last):
        text = file.read_text(encoding="utf-8")
        if cost := re.search(r"^; cost = (\d+) ", text, re.MULTILINE):
            costs[text] = int(cost[1])
    return min(costs, key=lambda text: costs[text], default=None)


def _was_killed(exit_code: int | None) -> bool:
    """Whether a signal ended the search, or what runs it, and no limit of ours did."""
    return exit_code is not None and (exit_code < 0 or exit_code in _KILLED)


def _is_out_of_memory(exit_code: int | None, log: str, memory_mb: int) -> bool:
    has_not_started = exit_code in _NOT_STARTED and memory_mb < _STARTS_MB
    return (
        exit_code in _OUT_OF_MEMORY or has_not_started or any(sign in log for sign in _NO_MEMORY_TO_TRANSLATE)
    )


def _failure(exit_code: int | None, log: str, time_limit_s: float, memory_mb: int) -> PlanningFailed:
    if exit_code is None or exit_code in _OUT_OF_TIME:
        return out_of_time(time_limit_s)
    if _is_out_of_memory(exit_code, log, memory_mb):
        return PlanningFailed(
            f"no plan was found within {memory_mb} MB of memory",
            remedy="Ask for less at once.",
            cut_off=True,
        )
    if exit_code in _UNSOLVABLE:
        return NoPlan(
            "no plan reaches all goals",
            remedy="Look for a goal that nothing leads to.",
        )
    if _was_killed(exit_code):
        return PlanningFailed(
            "Fast Downward was killed from outside before it found a plan",
            remedy="Plan again; where memory is short, the system ends the largest process.",
        )
    last_lines = " / ".join(line.strip() for line in log.splitlines() if line.strip())[-300:]
    return PlanningFailed(
        f"Fast Downward ended with exit code {exit_code} ({last_lines})",
        remedy="Export the problem with --pddl and run the engine on it by hand.",
    )
