"""Runs a request in a separate process, which is ended at its limit with everything that it started.

Reading, grounding, solving and validating may each take forever, in libraries without time limits. The
process (`child.py`) computes one call and writes its answer to a folder; this one waits, on every platform,
in any thread, and leaves neither a process nor a file behind.
"""

from __future__ import annotations

import os
import pickle
import signal
import sys
import tempfile
from collections.abc import Callable, Iterable
from contextlib import suppress
from pathlib import Path
from subprocess import PIPE, STDOUT, Popen, TimeoutExpired, run
from typing import TypeVar

from comity_domain.errors import PlanningFailed, out_of_time

T = TypeVar("T")

MEMORY_MB = 2048
"""Address space of the process, and of each one that it starts, where the system can limit it."""
LATEST_S = 2.8
"""Time after the limit of a request at which the process is ended [s] (our choice): it has to start, too."""
HAS_SESSIONS = hasattr(os, "killpg")
"""Processes can be ended by session, as POSIX has it."""
CALL, ANSWER, STARTED, LOG = "call", "answer", "started", "log"
"""In the folder: what to compute, what came of it, the processes that were started, and what was printed."""


def in_one_process(call: Callable[[], T], *, limit_s: float, plans: int = 1, memory_mb: int = MEMORY_MB) -> T:
    """What a call returns, or raises.

    Args:
        call: Picklable, such as a `functools.partial` of a function of a module; so must be its answer.
        limit_s: Wall-clock seconds for a plan, > 0; `LATEST_S` later all of it is ended.
        plans: How many plans it may look for.
        memory_mb: Megabytes of address space, > 0.

    Raises:
        PlanningFailed: The time or the memory was over, or the process was ended from outside.
    """
    with tempfile.TemporaryDirectory(prefix="comity-plan-", ignore_cleanup_errors=True) as name:
        folder = Path(name)
        (folder / STARTED).mkdir()
        (folder / CALL).write_bytes(pickle.dumps(call))
        code = _run(folder, plans * limit_s + LATEST_S, memory_mb)
        answer = folder / ANSWER
        if answer.exists():
            returned, value = pickle.loads(answer.read_bytes())
            if returned:
                return value  # type: ignore[no-any-return]
            raise value
        raise _nothing(code, (folder / LOG).read_text(encoding="utf-8", errors="replace"), limit_s, memory_mb)


def _run(folder: Path, seconds: float, memory_mb: int) -> int | None:
    """The exit code of the process, negative where a signal ended it; None where the time was over."""
    words = (str(folder), str(memory_mb), f"{seconds:.0f}")
    command = [sys.executable, "-P", "-m", "comity_domain.custom.child", *words]
    with (folder / LOG).open("wb") as log:
        process = Popen(
            command,
            stdin=PIPE,  # closed when this process ends, however it ends
            stdout=log,
            stderr=STDOUT,
            env=_environment(folder, memory_mb),
            start_new_session=HAS_SESSIONS,
        )
    try:
        return process.wait(seconds)
    except TimeoutExpired:
        return None
    finally:
        end([process.pid])  # first, so that it starts no more
        end(started(folder))
        process.kill()
        process.wait()
        with suppress(OSError):
            process.stdin.close()  # type: ignore[union-attr]


def _environment(folder: Path, memory_mb: int) -> dict[str, str]:
    """What the process and its engines find in their surroundings.

    Engines may be written in Python, too: with a fixed hash seed they order everything alike in every run.
    Java takes little enough of the address space to start under its limit: by default it reserves more; what
    the user's own `JAVA_TOOL_OPTIONS` say comes after, and so wins. numpy's threads would reserve it, too.
    `PYTHONSAFEPATH` is not passed on: an engine that is a script finds its modules beside it, or says that
    there is no plan.
    """
    java = f"-Xmx{memory_mb // 4}m -XX:CompressedClassSpaceSize=64m -XX:ReservedCodeCacheSize=64m"
    return {
        **{name: value for name, value in os.environ.items() if name != "PYTHONSAFEPATH"},
        **dict.fromkeys(("TMPDIR", "TEMP", "TMP"), str(folder)),
        "PYTHONHASHSEED": "0",
        "PYTHONPATH": os.pathsep.join(str(Path(path).absolute()) for path in sys.path if path),
        "JAVA_TOOL_OPTIONS": f"{java} {os.environ.get('JAVA_TOOL_OPTIONS', '')}".strip(),
        "OPENBLAS_NUM_THREADS": "1",
    }


def started(folder: Path) -> list[int]:
    """The processes that the one in a folder started, and that have not ended.

    unified-planning starts engines in sessions of their own: to end that of the process would not end them.
    """
    return [int(note.name) for note in (folder / STARTED).glob("[0-9]*")]


def end(processes: Iterable[int]) -> None:
    """End processes with their sessions, as far as they still run."""
    for number in processes:
        if HAS_SESSIONS:
            with suppress(ProcessLookupError, PermissionError):
                os.killpg(number, signal.SIGKILL)
        else:
            with suppress(
                FileNotFoundError
            ):  # Windows ends a process and what it started by this program alone
                run(["taskkill", "/F", "/T", "/PID", str(number)], capture_output=True, check=False)


def _nothing(code: int | None, log: str, limit_s: float, memory_mb: int) -> PlanningFailed:
    """Why there is no answer."""
    if code is None:
        return out_of_time(limit_s)
    if "MemoryError" in log:
        return out_of_memory(memory_mb)
    if code < 0:
        remedy = "Plan again; where memory is short, the system ends the largest process."
        return PlanningFailed("planning was killed from outside", remedy=remedy)
    lines = " / ".join(line.strip() for line in log.splitlines() if line.strip())[-300:]
    return PlanningFailed(f"planning broke off ({lines})", remedy="Plan with another engine, or report this.")


def out_of_memory(memory_mb: int) -> PlanningFailed:
    """That no plan was found within so many megabytes."""
    reason = f"no plan was found within {memory_mb} MB of memory"
    return PlanningFailed(reason, remedy="Ask for less at once.", cut_off=True)
