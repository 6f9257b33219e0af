"""The processes that carry tests out: they start clean, and where the system can, with all imports done."""

from __future__ import annotations

from multiprocessing import get_all_start_methods, get_context
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from multiprocessing.context import BaseContext

_SERVER = "forkserver"


def context() -> BaseContext:
    """How they are started: from a server that has imported once for all of them what tests need."""
    if _SERVER not in get_all_start_methods():
        return get_context("spawn")
    server = get_context(_SERVER)
    server.set_forkserver_preload(["comity.testing.running"])
    return server


def start() -> None:
    """Let the server begin to import, on another core, while this process finds out which tests there are."""
    if context().get_start_method() == _SERVER:
        from multiprocessing.forkserver import ensure_running

        ensure_running()
