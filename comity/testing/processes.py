"""The processes that carry tests out: they start clean, and where the system can, with all imports done."""

from __future__ import annotations

from multiprocessing import get_all_start_methods, get_context
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from multiprocessing.context import BaseContext

_SERVER = "forkserver"
_NEEDED = (
    "comity.testing.running",
    "comity.run_folder",
    "comity_fis.rulebook_file",
    "comity_sim2d.foot_traffic",
    "comity_sim2d.reactions",
    "scipy.ndimage",
    "scipy.sparse.csgraph",
    "shapely",
)
"""What tests import, now or when they come to need it: once for all processes, and while others work."""


def context() -> BaseContext:
    """How they are started: from a server that has imported once for all of them what tests need."""
    if _SERVER not in get_all_start_methods():
        return get_context("spawn")
    server = get_context(_SERVER)
    server.set_forkserver_preload(list(_NEEDED))
    return server


def start() -> None:
    """Let the server begin to import, on another core, while this process finds out which tests there are."""
    if context().get_start_method() == _SERVER:
        from multiprocessing.forkserver import ensure_running

        ensure_running()
