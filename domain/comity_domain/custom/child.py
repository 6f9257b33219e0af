"""The child process of a request: `python -m comity_domain.custom.child FOLDER MEGABYTES SECONDS`.

It runs the call stored in the folder and writes its answer there (`process.py`).
"""

from __future__ import annotations

import os
import pickle
import shutil
import subprocess
import sys
import threading
import traceback
from contextlib import suppress
from pathlib import Path
from typing import Any

from comity_domain.custom.process import ANSWER, CALL, STARTED, end, out_of_memory, started
from comity_domain.errors import PlanningFailed
from comity_fis.errors import ComityError

FRAMES = 10_000
"""Recursion limit: unified-planning's reader takes about 20 frames per bracket pair; 60 may be nested."""


def main() -> None:
    """Run one call."""
    folder, megabytes, seconds = Path(sys.argv[1]), int(sys.argv[2]), int(sys.argv[3])
    ending = threading.Event()
    threading.Thread(target=_end_with_parent, args=(folder, ending), daemon=True).start()
    _note_engines(folder / STARTED)
    _limit(megabytes, seconds)
    sys.setrecursionlimit(FRAMES)
    try:
        answer = (True, pickle.loads((folder / CALL).read_bytes())())
        written = pickle.dumps(answer)
    except Exception as error:
        written = pickle.dumps(
            (False, error if isinstance(error, ComityError) else _failure(error, megabytes))
        )
    if ending.is_set():
        threading.Event().wait()  # the other thread ends the process
    (folder / "part").write_bytes(written)
    (folder / "part").replace(folder / ANSWER)
    os._exit(0)  # an engine may have left threads that never end


def _failure(error: Exception, megabytes: int) -> PlanningFailed:
    """The failure to report for an exception in a library or caused by the files."""
    if isinstance(error, MemoryError):
        return out_of_memory(megabytes)
    if isinstance(error, ZeroDivisionError):
        remedy = "Keep 0 out of what divides in conditions, effects and goals."
        return PlanningFailed("something is divided by 0", remedy=remedy)
    place = traceback.extract_tb(error.__traceback__)[-1]
    at = f"{type(error).__name__}: {error}, in {place.name} of {Path(place.filename).name}"
    return PlanningFailed(f"planning broke off ({at})", remedy="Plan with another engine, or report this.")


def _end_with_parent(folder: Path, ending: threading.Event) -> None:
    """Wait until the parent process ends, however it ends, then end all processes started here."""
    while os.read(sys.stdin.fileno(), 1):
        pass
    ending.set()
    end(started(folder))
    shutil.rmtree(folder, ignore_errors=True)
    end([os.getpid()])


def _note_engines(folder: Path) -> None:
    """Record every process that this one starts, until it has ended: each engine has its own session."""

    class Noted(subprocess.Popen):  # type: ignore[type-arg]
        def __init__(self, *args: Any, **kwargs: Any) -> None:
            super().__init__(*args, **kwargs)
            (folder / str(self.pid)).touch()

        def wait(self, timeout: float | None = None) -> int:
            code = super().wait(timeout)
            (folder / str(self.pid)).unlink(missing_ok=True)
            return code

    subprocess.Popen = Noted  # type: ignore[misc]


def _limit(megabytes: int, seconds: int) -> None:
    """Limit address space and processor time, where the system supports it.

    Windows has no such limits; macOS refuses the memory limit. The processor time limit also ends a process
    whose parent was killed before it could end it.
    """
    try:
        import resource
    except ImportError:
        return
    processor = (seconds + 60) * (os.cpu_count() or 1)
    limits = {resource.RLIMIT_AS: megabytes * 1_000_000, resource.RLIMIT_CPU: processor}
    for limit, most in limits.items():
        with suppress(ValueError, OSError):
            resource.setrlimit(limit, (most, most))


if __name__ == "__main__":
    main()
