"""Files that only the user may read, each replaced whole, by one writer at a time."""

from __future__ import annotations

import os
import tempfile
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path

from comity.system.locks import locked
from comity_fis import InputError, Where


@contextmanager
def alone_in(folder: Path) -> Iterator[None]:
    """Keep all others from writing and deleting below a folder; reading does not wait.

    Where there is no such folder, there is nothing to keep them from.

    Raises:
        InputError: if the system does not let us.
    """
    with ExitStack() as held:
        with permitted(folder):
            if folder.is_dir():
                held.enter_context(locked(folder))
        yield


def replace_whole(path: Path, text: str) -> None:
    """Write one file whole or not at all: a reader sees the old or the new one meanwhile.

    Only the user may read it: `mkstemp` sees to that.

    Raises:
        OSError: if the system does not let us; what was there stays.
    """
    handle, part = tempfile.mkstemp(dir=path.parent, prefix=f".{path.name}.")
    try:
        with os.fdopen(handle, "w", encoding="utf-8", newline="\n") as file:
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
