"""Cross-platform locks on folders for one process at a time, released however the process ends."""

from __future__ import annotations

import errno
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

LOCK = ".lock"
"""Lock file in a folder; it exists while the folder is locked, and after a process was killed."""


@contextmanager
def locked(folder: Path, *, waits: bool = True) -> Iterator[None]:
    """Lock an existing folder against other processes and threads that also lock it.

    Args:
        folder: The folder; reading needs no lock.
        waits: Whether to wait until it is free.

    Raises:
        filelock.Timeout: if it is locked, and `waits` is False.
        OSError: if the system denies writing in the folder.
    """
    from filelock import FileLock

    path = folder / LOCK
    with FileLock(path, timeout=-1 if waits else 0, mode=0o600):
        try:
            yield
        finally:
            with suppress(OSError):  # Windows cannot remove an open file; filelock does so there
                path.unlink()


def is_locked(folder: Path) -> bool:
    """Whether a process holds the lock of a folder."""
    from filelock import Timeout

    if not (folder / LOCK).exists():
        return False
    try:
        with locked(folder, waits=False):
            return False
    except (Timeout, PermissionError):  # no permission: another user's file, whose process may be running
        return True
    except OSError as error:
        if error.errno == errno.EROFS:  # read-only: nothing on this machine writes there
            return False
        raise
