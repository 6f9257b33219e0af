"""Running an engine in a process of its own, within limits, without leaving anything behind.

On Windows there are no sessions and no `sh`: an engine whose Comity is killed there goes on to its own end.
"""

from __future__ import annotations

import os
import signal
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from subprocess import DEVNULL, PIPE, STDOUT, Popen, TimeoutExpired, run

HAS_SESSIONS = hasattr(os, "killpg")
"""Processes can be ended by session, as POSIX has it."""
OVER = "over"
GUARD = f'read group; [ "$group" = {OVER} ] || read over || {{ kill -9 -- "-$group"; rm -rf -- "$1"; }}'
"""Waits for word that all is over; where none can come any more, ends the engine and removes its folder."""


def run_limited(command: list[str], folder: Path, time_limit_s: float) -> tuple[int | None, str]:
    """Run a command in a folder; whatever ends the wait, the process and all below it end, too.

    Returns:
        The exit code, negative where a signal ended it, None where the time limit did; and what was printed.
    """
    # Engines may be written in Python, too: with a fixed hash seed they order everything alike in every run.
    # What they write for a while is written into the folder, and goes with it.
    places = dict.fromkeys(("TMPDIR", "TEMP", "TMP"), str(folder))
    environment = {**os.environ, "PYTHONHASHSEED": "0", **places}
    with (
        _guarded(folder) as watch_over,
        Popen(
            command,
            cwd=folder,
            env=environment,
            stdout=PIPE,
            stderr=STDOUT,
            encoding="utf-8",
            errors="replace",
            start_new_session=HAS_SESSIONS,
        ) as process,
    ):
        watch_over(process.pid)
        try:
            log, _ = process.communicate(timeout=time_limit_s)
        except TimeoutExpired:
            return None, _end(process)
        finally:
            _end(process)
        return process.returncode, log


@contextmanager
def _guarded(folder: Path) -> Iterator[Callable[[int], None]]:
    """Let nothing outlive this process, even where it is killed in a way that it cannot answer to (SIGKILL).

    Yields:
        What tells the guard which session to end.
    """
    if not HAS_SESSIONS:
        yield lambda _: None
        return
    with Popen(
        ["sh", "-c", GUARD, "comity-guard", str(folder)],
        stdin=PIPE,
        stdout=DEVNULL,
        stderr=DEVNULL,
        bufsize=0,  # what cannot be told must not come up again when the pipe is closed
        start_new_session=True,
    ) as guard:
        try:
            yield lambda group: _tell(guard, str(group))
        finally:
            _tell(guard, OVER)


def _tell(guard: Popen[bytes], line: str) -> None:
    assert guard.stdin is not None  # a pipe was asked for
    with suppress(BrokenPipeError):  # the guard was killed, too
        guard.stdin.write(f"{line}\n".encode())


def _end(process: Popen[str]) -> str:
    """End the session of the process, unless it was waited for: then everybody who could print is gone.

    The process may be dead already, killed by somebody else, and what it started go on.

    Returns:
        What was printed that nobody has read.
    """
    if process.returncode is not None:
        return ""
    if HAS_SESSIONS:
        os.killpg(process.pid, signal.SIGKILL)
    else:
        with suppress(FileNotFoundError):  # Windows ends a process and what it started by this program alone
            run(["taskkill", "/F", "/T", "/PID", str(process.pid)], capture_output=True, check=False)
        process.kill()
    log, _ = process.communicate()  # until the last of them has let go of its output
    return log
