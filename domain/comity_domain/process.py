"""Running an engine in a process of its own, within limits, without leaving anything behind."""

from __future__ import annotations

import os
import signal
from pathlib import Path
from subprocess import PIPE, STDOUT, Popen, TimeoutExpired


def run_limited(command: list[str], folder: Path, time_limit_s: float) -> tuple[int | None, str]:
    """Run a command in a folder; whatever ends the wait, the process and all below it end, too.

    Returns:
        The exit code, negative where a signal ended it, None where the time limit did; and what was printed.
    """
    # Engines may be written in Python, too: with a fixed hash seed they order everything alike in every run.
    environment = {**os.environ, "PYTHONHASHSEED": "0"}
    with Popen(
        command,
        cwd=folder,
        env=environment,
        stdout=PIPE,
        stderr=STDOUT,
        text=True,
        errors="replace",
        start_new_session=True,
    ) as process:
        try:
            log, _ = process.communicate(timeout=time_limit_s)
        except TimeoutExpired:
            return None, _end(process)
        finally:
            _end(process)
        return process.returncode, log


def _end(process: Popen[str]) -> str:
    """End the session of the process, unless it was waited for: then everybody who could print is gone.

    The process may be dead already, killed by somebody else, and what it started go on.

    Returns:
        What was printed that nobody has read.
    """
    if process.returncode is not None:
        return ""
    os.killpg(process.pid, signal.SIGKILL)
    log, _ = process.communicate()  # until the last of them has let go of its output
    return log
