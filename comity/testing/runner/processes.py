"""The processes that carry tests out: they start clean, and where the system can, with all imports done."""

from __future__ import annotations

import gc
import os
import signal
from collections.abc import Iterator
from contextlib import contextmanager
from multiprocessing import active_children, get_all_start_methods, get_context
from pathlib import Path
from typing import TYPE_CHECKING

from comity_fis.errors import ComityError

if TYPE_CHECKING:
    from concurrent.futures import ProcessPoolExecutor
    from multiprocessing.context import BaseContext

MOST = 61
"""Processes: Windows waits for no more at once."""
_SERVER = "forkserver"
_SAFE_PATH = "PYTHONSAFEPATH"
"""What keeps Python from looking for modules in the current folder first."""
NEEDED = (
    "comity.system.garbage",  # first: it is about the import of the others
    "comity.testing.runner.running",
    "comity.output.run_folder",
    "comity_fis.rulebook.reader",
    "comity_sim2d.people.foot_traffic",
    "comity_sim2d.people.reactions",
    "scipy.sparse.csgraph",
    "shapely",
    "typer",
)
"""What tests and the program import, now or when they come to need it: once for all processes, and while
others work."""


class ProcessLost(ComityError):  # noqa: N818 - it says what happened; the family's base carries the suffix
    """A process that carried out tests was ended from outside, and what it had under way has no result."""

    def __init__(self) -> None:
        super().__init__(
            "expected that processes carry their tests out to the end, got that one was ended from outside, "
            "as where memory runs out. Run the tests again, with `--jobs 1` where it happens again."
        )


def context() -> BaseContext:
    """How they are started: from a server that has imported once for all of them what tests need."""
    if _SERVER not in get_all_start_methods():
        return get_context("spawn")
    server = get_context(_SERVER)
    server.set_forkserver_preload(list(NEEDED))
    return server


def start() -> None:
    """Let the server begin to import, on another core, while this process finds out which tests there are.

    Raises:
        FileNotFoundError: where the current folder was removed.
    """
    if context().get_start_method() == _SERVER:
        from multiprocessing import forkserver, resource_tracker

        Path.cwd()  # where it was removed, this is the process to say so, and not the ones it starts
        with _on_safe_path():
            resource_tracker.ensure_running()  # the server would start it, and unblock Ctrl-C then
            with _deaf():
                forkserver.ensure_running()


@contextmanager
def pool(count: int) -> Iterator[ProcessPoolExecutor]:
    """So many processes. They end with the block: at once where it is left early, with whatever they do.

    Raises:
        ProcessLost: if one was ended from outside.
    """
    from concurrent.futures import ProcessPoolExecutor
    from concurrent.futures.process import BrokenProcessPool

    start()
    workers = ProcessPoolExecutor(min(count, MOST), mp_context=context(), initializer=_begin)
    try:
        yield workers
    except BrokenProcessPool:
        _end_all()
        raise ProcessLost from None
    except BaseException:
        _end_all()
        raise
    finally:
        workers.shutdown(cancel_futures=True)


def _end_all() -> None:
    """Also the server: it would go on to start whom it was told of, for nobody."""
    for child in active_children():
        child.terminate()
    if context().get_start_method() != _SERVER:
        return
    from multiprocessing import forkserver

    server: int | None = getattr(forkserver._forkserver, "_forkserver_pid", None)  # has no public name
    if server is not None:
        os.kill(server, signal.SIGKILL)


def _begin() -> None:
    """What a process does before its first test."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # it reaches every process of a terminal: one ends them all
    gc.freeze()  # what was imported is needed to the end
    import comity.system.garbage  # noqa: F401  (it sets what it is about, where no server did)


@contextmanager
def _on_safe_path() -> Iterator[None]:
    """Whoever is started inside does not take for Comity what is called so in the current folder."""
    before = os.environ.get(_SAFE_PATH)
    os.environ[_SAFE_PATH] = "1"
    try:
        yield
    finally:
        if before is None:
            del os.environ[_SAFE_PATH]
        else:
            os.environ[_SAFE_PATH] = before


@contextmanager
def _deaf() -> Iterator[None]:
    """Whoever is started inside is deaf to Ctrl-C, also while it imports; here it comes a little later."""
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)
