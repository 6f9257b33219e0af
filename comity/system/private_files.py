"""Private files, readable by the user only, replaced atomically by one writer at a time."""

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
    """Lock a folder against other writers; readers do not wait.

    Without such a folder there is nothing to lock.

    Raises:
        InputError: if the system refuses.
    """
    with ExitStack() as held:
        with permitted(folder):
            if folder.is_dir():
                held.enter_context(locked(folder))
        yield


def replace_whole(path: Path, text: str) -> None:
    """Write a file atomically: concurrent readers see the old or the new content.

    Only the user may read it, due to `mkstemp`.

    Raises:
        OSError: if the system refuses; the old file remains.
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
    """Convert the system's errors to `InputError` with a remedy."""
    try:
        yield
    except OSError as error:
        raise InputError(
            expected="a store that can be written",
            got=error.strerror or str(error),
            remedy="Check the permissions, or set COMITY_HOME to another folder.",
            where=Where(str(path)),
        ) from None
