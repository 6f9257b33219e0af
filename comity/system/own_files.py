"""Files that Comity writes where the user says so: none that another person wrote is ever replaced."""

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
"""Bytes at the start and at the end of a file among which its mark must stand."""


def refuse_foreign(marks: Mapping[Path, bytes]) -> None:
    """Refuse to write before anything is computed.

    Args:
        marks: Every file that is to be written, with the bytes near an end of it that say it is ours.

    Raises:
        InputError: for a file that does not bear its mark, or a place that cannot hold one.
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


def check_suffix(picture: Path) -> None:
    """Refuse a picture's name that promises another format than PNG.

    Raises:
        InputError: for a name such as why.pdf.
    """
    if picture.suffix.lower() not in {"", ".png"}:
        raise InputError(
            expected="a PNG file to write",
            got=repr(picture.name),
            remedy=f"Pictures are PNG: name it {picture.with_suffix('.png').name}, or convert it afterwards.",
            where=Where("--picture"),
        )


PRIVATE, PRIVATE_FOLDER = 0o600, 0o700
"""Permissions of what tells of people: the user alone may read it."""
ASIDE = ".part."
"""What the name of a folder begins with that is not whole yet."""


def write_whole(path: Path, content: bytes, *, private: bool = False) -> None:
    """Write one file whole or not at all.

    Args:
        path: Of the file.
        content: All of it.
        private: Whether it tells of people, so that only the user may read it.

    Raises:
        InputError: if the system does not let us.
    """
    with writing(path), written_whole(path, private=private) as part:
        part.write_bytes(content)


def create_private(path: Path) -> Path:
    """Create an empty file that only the user may read, in the place of one of that name.

    Raises:
        OSError: if the system does not let us.
    """
    path.unlink(missing_ok=True)
    os.close(os.open(path, os.O_WRONLY | os.O_CREAT | os.O_EXCL, PRIVATE))
    return path


@contextmanager
def written_whole(path: Path, *, private: bool = False) -> Iterator[Path]:
    """Where to write a file that has its name once it is all there, and leaves nothing otherwise.

    Args:
        path: Of the file.
        private: Whether only the user may read it.

    Raises:
        OSError: if the system does not let us.
    """
    part = path.with_name(f".part.{path.name}")  # pictures are written in the format of their ending
    try:
        if private:
            create_private(part)
        yield part
        part.replace(path)
    finally:
        part.unlink(missing_ok=True)


@contextmanager
def folder_written_whole(path: Path) -> Iterator[Path]:
    """Where to write a private folder that has its name once it is all there, and leaves nothing otherwise.

    A folder of that name stays where it is. At the end each new file takes the place of the one of its
    name there, those on top first; other files stay.

    Raises:
        InputError: if the system does not let us.
    """
    base = path if path.exists() else path.parent  # a folder that is there may be a disk of its own
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
    """The content of a file, never of a pipe, which would be waited for, or a device, which may have no end.

    Raises:
        OSError: if it cannot be read, or is no regular file.
    """
    mode = path.stat().st_mode
    if not stat.S_ISREG(mode):
        raise OSError(errno.EINVAL, "a folder" if stat.S_ISDIR(mode) else "no regular file", str(path))
    return path.read_bytes()


def make_folder(path: Path, *, private: bool = False) -> None:
    """Create a folder, unless it is there.

    Args:
        path: Of the folder.
        private: Whether what goes there tells of people, so that only the user may look into a new one.

    Raises:
        InputError: if the system does not let us.
    """
    with writing(path):
        path.mkdir(parents=True, exist_ok=True, mode=PRIVATE_FOLDER if private else 0o777)


@contextmanager
def writing(path: Path) -> Iterator[None]:
    """Make the system's refusals errors that say what to do."""
    try:
        yield
    except (OSError, ValueError) as error:
        reason = (error.strerror if isinstance(error, OSError) else None) or str(error)
        if isinstance(error, FileExistsError):
            raise _refusal(path, "something else of this name", "Remove or rename it.") from None
        raise _refusal(path, reason, "Name a place that you may write to.") from None


def _ends(path: Path) -> bytes:
    """What a file begins and ends with."""
    with path.open("rb") as file:
        head = file.read(HEAD)
        file.seek(max(file.seek(0, os.SEEK_END) - TAIL, 0))
        return head + file.read()


def _refusal(path: Path, got: str, remedy: str) -> InputError:
    return InputError(expected="a place to write to", got=got, remedy=remedy, where=Where(str(path)))
