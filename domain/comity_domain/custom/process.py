"""Runs a request in a child process; at the time limit it is ended with everything that it started.

Reading, grounding, solving and validating may each run forever, in libraries without time limits. The child
process (`child.py`) runs one call and writes its answer to a folder. The parent waits, on every platform and
in any thread, and leaves neither processes nor files behind.
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
"""Address space limit of the process, and of each one it starts, where the system supports it [MB]."""
LATEST_S = 2.8
"""Time after the request's limit at which the process is ended [s] (our choice): it includes start-up."""
HAS_SESSIONS = hasattr(os, "killpg")
"""Whether processes can be ended by session, as in POSIX."""
CALL, ANSWER, STARTED, LOG = "call", "answer", "started", "log"
"""Files in the folder: the call, its answer, the ids of the started processes, and the printed output."""


def in_one_process(call: Callable[[], T], *, limit_s: float, plans: int = 1, memory_mb: int = MEMORY_MB) -> T:
    """Run a call in a child process; returns or raises what the call does.

    Args:
        call: Picklable, such as a `functools.partial` of a module-level function, with a picklable result.
        limit_s: Wall-clock time per plan [s], > 0; everything is ended `LATEST_S` later.
        plans: Maximum number of plans that the call searches for.
        memory_mb: Address space limit [MB], > 0.

    Raises:
        PlanningFailed: Time or memory ran out, or the process was killed from outside.
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
    """Exit code of the process, negative if a signal ended it; None on timeout."""
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
        end([process.pid])  # first, so that it starts no more processes
        end(started(folder))
        process.kill()
        process.wait()
        with suppress(OSError):
            process.stdin.close()  # type: ignore[union-attr]


def _environment(folder: Path, memory_mb: int) -> dict[str, str]:
    """Environment variables of the process and its engines.

    A fixed hash seed makes engines written in Python deterministic. Java is told to reserve less address
    space, since its default exceeds the limit; the user's own `JAVA_TOOL_OPTIONS` come later and take
    precedence. numpy's threads would also reserve address space. `PYTHONSAFEPATH` is not passed on: it would
    keep an engine that is a script from finding its modules.
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
    """Ids of the processes started by the process of a folder that have not ended.

    unified-planning starts engines in their own sessions, so ending the parent's session does not end them.
    """
    return [int(note.name) for note in (folder / STARTED).glob("[0-9]*")]


def end(processes: Iterable[int]) -> None:
    """End processes and their sessions, if they still run."""
    for number in processes:
        if HAS_SESSIONS:
            with suppress(ProcessLookupError, PermissionError):
                os.killpg(number, signal.SIGKILL)
        else:
            with suppress(FileNotFoundError):  # on Windows, only taskkill ends a process tree
                run(["taskkill", "/F", "/T", "/PID", str(number)], capture_output=True, check=False)


def _nothing(code: int | None, log: str, limit_s: float, memory_mb: int) -> PlanningFailed:
    """The failure to report when there is no answer."""
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
    """The failure to report when memory ran out."""
    reason = f"no plan was found within {memory_mb} MB of memory"
    return PlanningFailed(reason, remedy="Ask for less at once.", cut_off=True)
