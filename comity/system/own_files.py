"""Output files at the user's paths: a file not written by Comity is never replaced."""

from __future__ import annotations

import errno
import os
import stat
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory

from comity_fis import InputError, Where

HEAD, TAIL = 1024, 16
"""Number of bytes at the start and the end of a file that are searched for its marker."""


def refuse_foreign(marks: Mapping[Path, bytes]) -> None:
    """Refuse to overwrite foreign files, before anything is computed.

    Args:
        marks: Marker bytes, near the start or the end, of every file to be written.

    Raises:
        InputError: for a file without its marker, or a path that cannot hold a file.
    """
    for path, mark in marks.items():
        with writing(path):
            if path.is_dir():
                raise _refusal(path, "a folder", "Name a file.")
            if not path.parent.is_dir():
                raise _refusal(path, "no such folder", "Create the folder first, or name another.")
            if path.exists() and mark not in _ends(path):
                raise _refusal(
                    path,
                    f"a {path.name} that Comity did not write",
                    "Name another file: nothing is overwritten.",
                )


PRIVATE, PRIVATE_FOLDER = 0o600, 0o700
"""Permissions of personal data: readable by the user only."""
ASIDE = ".part."
"""Name prefix of an incomplete folder."""


def write_whole(path: Path, content: bytes, *, private: bool = False) -> None:
    """Write a file atomically.

    Args:
        path: Path of the file.
        content: Content of the file.
        private: Whether it holds personal data, so that only the user may read it.

    Raises:
        InputError: if the system refuses.
    """
    with writing(path), written_whole(path, private=private) as part:
        part.write_bytes(content)


def create_private(path: Path) -> Path:
    """Create an empty file that only the user may read, replacing an existing one.

    Raises:
        OSError: if the system refuses.
    """
    path.unlink(missing_ok=True)
    os.close(os.open(path, os.O_WRONLY | os.O_CREAT | os.O_EXCL, PRIVATE))
    return path


@contextmanager
def written_whole(path: Path, *, private: bool = False) -> Iterator[Path]:
    """Temporary path for writing a file atomically; on an error nothing remains.

    Args:
        path: Path of the file.
        private: Whether only the user may read it.

    Raises:
        OSError: if the system refuses.
    """
    part = path.with_name(f".part.{path.name}")  # keeps the suffix, which determines a picture's format
    try:
        if private:
            create_private(part)
        yield part
        part.replace(path)
    finally:
        part.unlink(missing_ok=True)


@contextmanager
def folder_written_whole(path: Path) -> Iterator[Path]:
    """Temporary path for writing a private folder; on an error nothing remains.

    An existing folder is kept. At the end each new file replaces the one with its name there, top-level files
    first; other files stay.

    Raises:
        InputError: if the system refuses.
    """
    base = path if path.exists() else path.parent  # an existing folder may be on its own disk
    make_folder(base)
    with writing(path):
        aside = TemporaryDirectory(prefix=ASIDE, dir=base)
    with aside as name:
        new = Path(name) / path.name
        new.mkdir(mode=PRIVATE_FOLDER)
        yield new
        with writing(path):
            _move(new, path)


def _move(new: Path, path: Path) -> None:
    if not path.exists():
        new.rename(path)
        return
    files = (file.relative_to(new) for file in new.rglob("*") if file.is_file())
    for file in sorted(files, key=lambda file: (len(file.parts), file)):
        (path / file).parent.mkdir(parents=True, exist_ok=True, mode=PRIVATE_FOLDER)
        (new / file).replace(path / file)


def read_regular(path: Path) -> bytes:
    """The content of a regular file; a pipe might block, and a device might never end.

    Raises:
        OSError: if it cannot be read, or is no regular file.
    """
    mode = path.stat().st_mode
    if not stat.S_ISREG(mode):
        raise OSError(errno.EINVAL, "a folder" if stat.S_ISDIR(mode) else "no regular file", str(path))
    return path.read_bytes()


def make_folder(path: Path, *, private: bool = False) -> None:
    """Create a folder, unless it exists.

    Args:
        path: Path of the folder.
        private: Whether it will hold personal data, so that only the user may look into a new folder.

    Raises:
        InputError: if the system refuses.
    """
    with writing(path):
        path.mkdir(parents=True, exist_ok=True, mode=PRIVATE_FOLDER if private else 0o777)


@contextmanager
def writing(path: Path) -> Iterator[None]:
    """Convert the system's errors to `InputError` with a remedy."""
    try:
        yield
    except (OSError, ValueError) as error:
        reason = (error.strerror if isinstance(error, OSError) else None) or str(error)
        if isinstance(error, FileExistsError):
            raise _refusal(path, "something else of this name", "Remove or rename it.") from None
        raise _refusal(path, reason, "Name a place that you may write to.") from None


def _ends(path: Path) -> bytes:
    """The first and last bytes of a file."""
    with path.open("rb") as file:
        head = file.read(HEAD)
        file.seek(max(file.seek(0, os.SEEK_END) - TAIL, 0))
        return head + file.read()


def _refusal(path: Path, got: str, remedy: str) -> InputError:
    return InputError(expected="a place to write to", got=got, remedy=remedy, where=Where(str(path)))
