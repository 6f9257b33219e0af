"""Locks on folders, on every platform: one process at a time, and free again however that process ends."""

from __future__ import annotations

import errno
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

LOCK = ".lock"
"""The file that is in a folder while it is locked, and after a process was killed."""


@contextmanager
def locked(folder: Path, *, waits: bool = True) -> Iterator[None]:
    """Keep every other process, and every other thread that asks, out of a folder that exists.

    Args:
        folder: The folder; reading it needs no lock.
        waits: Whether to wait until it is free.

    Raises:
        filelock.Timeout: It is not free, and this does not wait.
        OSError: The system does not allow to write in the folder.
    """
    from filelock import FileLock

    path = folder / LOCK
    with FileLock(path, timeout=-1 if waits else 0, mode=0o600):
        try:
            yield
        finally:
            with suppress(OSError):  # Windows removes no open file; there, filelock removes it
                path.unlink()


def is_locked(folder: Path) -> bool:
    """Whether a process holds the lock of a folder now."""
    from filelock import Timeout

    if not (folder / LOCK).exists():
        return False
    try:
        with locked(folder, waits=False):
            return False
    except (Timeout, PermissionError):  # no permission: the file is another user's, whose process may run
        return True
    except OSError as error:
        if error.errno == errno.EROFS:  # nothing on this machine writes there
            return False
        raise
