"""Files that a command writes: whole or not at all, and never over something of the user's."""

from __future__ import annotations

from pathlib import Path

from comity_fis import InputError, Where


def refuse_foreign(path: Path, first_line: str) -> None:
    """Refuse a place where something stands that does not start as our own files do.

    Raises:
        InputError: if it must not be overwritten.
    """
    try:
        if not path.exists():
            return
        if path.is_file():
            with path.open("rb") as file:
                if file.read(len(first_line.encode())) == first_line.encode():
                    return
        got = "a folder" if path.is_dir() else "a file that Comity did not write"
    except OSError as error:
        got = error.strerror or str(error)
    raise InputError(
        expected="a new file, or one that Comity wrote",
        got=got,
        remedy="Name another one: nothing of yours is overwritten.",
        where=Where(str(path)),
    )


def write_whole(path: Path, text: str) -> None:
    """Write a file at once.

    Raises:
        InputError: if the system does not let us.
    """
    part = path.with_name(f".{path.name}.part")
    try:
        part.write_text(text, encoding="utf-8", newline="\n")
        part.replace(path)
    except OSError as error:
        part.unlink(missing_ok=True)
        raise InputError(
            expected="a file that can be written",
            got=error.strerror or str(error),
            remedy="Name a file in a folder that exists and that you may write to.",
            where=Where(str(path)),
        ) from None
