"""Describes an exception, with the location in the user's code where it was raised."""

from __future__ import annotations

import sys
from pathlib import Path
from traceback import walk_tb
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from types import FrameType

OURS = ("comity", "comity_domain", "comity_executor", "comity_fis", "comity_sim2d", "py_trees")
"""Packages whose frames do not count as user code, as those of the standard library."""


def raised(error: BaseException) -> str:
    """Type and text of an exception, and where the user's code raised it: file, line and call.

    The call is the one that Comity made, such as `motion` of a robot. The line is the last one in that call's
    file, so that for an exception deep in a library it is the user's line that led there.

    Args:
        error: The caught exception.
    """
    return f"{type(error).__name__}: {error}{raised_at(error)}"


def raised_at(error: BaseException) -> str:
    """The location alone, as ` (my_robot.py:41, in motion)`; empty if only Comity's code was involved."""
    frames = list(walk_tb(error.__traceback__))
    at = next((i for i, (frame, _) in enumerate(frames) if _is_users(frame)), None)
    if at is None:
        return ""
    code = frames[at][0].f_code
    line = next(line for frame, line in reversed(frames) if frame.f_code.co_filename == code.co_filename)
    call = "" if code.co_name == "<module>" else f", in {code.co_name}"
    return f" ({Path(code.co_filename).name}:{line}{call})"


def _is_users(frame: FrameType) -> bool:
    # The package, not the name: a module that runs as `__main__` still has its package.
    where = frame.f_globals
    package = where.get("__package__") or where.get("__name__") or ""
    top = str(package).partition(".")[0]
    return top not in OURS and top not in sys.stdlib_module_names
