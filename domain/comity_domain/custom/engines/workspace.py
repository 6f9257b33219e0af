"""A folder for one call of an engine: gone when the call ends, or after a power cut with the next call."""

from __future__ import annotations

import shutil
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

PREFIX = "comity-plan-"
OWNED = "owned"
"""The file that whoever works in a folder holds a lock on, for as long as their process lives."""
YOUNG_S = 60.0
"""A folder of this age may be one whose owner has not locked it yet."""


@contextmanager
def workspace() -> Iterator[Path]:
    """A new folder for temporary files; those whose owner has died are removed."""
    _remove_abandoned()
    from filelock import FileLock

    with (
        tempfile.TemporaryDirectory(prefix=PREFIX, ignore_cleanup_errors=True) as name,
        FileLock(Path(name) / OWNED),
    ):
        yield Path(name)


def _remove_abandoned() -> None:
    for folder in Path(tempfile.gettempdir()).glob(f"{PREFIX}*"):
        try:
            if _is_abandoned(folder):
                shutil.rmtree(folder, ignore_errors=True)
        except OSError:  # somebody else's, or gone in the meantime
            continue


def _is_abandoned(folder: Path) -> bool:
    """Whether nobody holds the lock any more; a process number may be somebody else's by now."""
    from filelock import FileLock, Timeout

    if time.time() - folder.stat().st_mtime < YOUNG_S or folder.is_symlink():
        return False
    if not (folder / OWNED).is_file():
        return False
    try:
        with FileLock(folder / OWNED, timeout=0):
            return True
    except Timeout:
        return False
