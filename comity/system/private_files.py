"""Files that only the user may read, each replaced whole, by one writer at a time."""

from __future__ import annotations

import os
import sys
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from comity_fis import InputError, Where


@contextmanager
def alone_in(folder: Path) -> Iterator[None]:
    """Nobody else writes or deletes below a folder meanwhile; who reads does not wait.

    Where there is no such folder, and on systems that lock no folders (Windows), nobody is kept out.

    Raises:
        InputError: if the system does not let us.
    """
    with permitted(folder):
        handle = _locked(folder) if folder.is_dir() else None
    try:
        yield
    finally:
        if handle is not None:
            os.close(handle)


def replace_whole(path: Path, text: str) -> None:
    """Write one file whole or not at all: whoever reads it meanwhile sees the old or the new one.

    Only the user may read it: `mkstemp` sees to that.

    Raises:
        OSError: if the system does not let us; what was there stays.
    """
    handle, part = tempfile.mkstemp(dir=path.parent, prefix=f".{path.name}.")
    try:
        with os.fdopen(handle, "w", encoding="utf-8") as file:
            file.write(text)
            file.flush()
            os.fsync(file.fileno())
        Path(part).replace(path)
    except BaseException:
        Path(part).unlink(missing_ok=True)
        raise


@contextmanager
def permitted(path: Path) -> Iterator[None]:
    """Make the system's refusals errors that say what to do."""
    try:
        yield
    except OSError as error:
        raise InputError(
            expected="a store that can be written",
            got=error.strerror or str(error),
            remedy="Check the permissions, or set COMITY_HOME to another folder.",
            where=Where(str(path)),
        ) from None


def _locked(folder: Path) -> int | None:
    """A handle that holds the folder's lock until it is closed; None where the system locks no folders."""
    if sys.platform == "win32":
        return None
    import fcntl

    handle = os.open(folder, os.O_RDONLY)
    fcntl.flock(handle, fcntl.LOCK_EX)
    return handle
