"""Which runs, tables and other files below some folders hold a person."""

from __future__ import annotations

import os
import re
from codecs import BOM_UTF16_BE, BOM_UTF16_LE
from collections.abc import Collection, Iterator
from dataclasses import dataclass
from pathlib import Path

from comity.answers.run import RunAnswer
from comity.output.run_folder import RUN, RunFolder, is_run
from comity.system.locks import LOCK
from comity.system.own_files import read_regular
from comity_fis import InputError, Where

LARGEST = 64_000_000
"""Bytes; a larger file is named as not searched."""
CONVERT = "unpack or convert it to UTF-8 text and search again, or look yourself"
OPENED = "look yourself, or make it readable and search again"


@dataclass(frozen=True, slots=True)
class Holding:
    """A run that a person took part in, or a file that names them."""

    path: Path
    as_: str
    """In what way, for a reader."""
    run: bool


@dataclass(frozen=True, slots=True)
class Unread:
    """Something that may hold a person and was not looked into."""

    path: Path
    why: str
    remedy: str


@dataclass(frozen=True, slots=True)
class Searched:
    """One folder that was searched."""

    folder: Path
    runs: int
    """Runs that were looked at."""
    files: int
    """Other files that were looked into."""
    found: tuple[Holding, ...]
    unread: tuple[Unread, ...]
    """What could not be looked into: damaged, too large, no text, a link, or not ours to read."""


def search(folders: Collection[Path], names: Collection[str]) -> tuple[Searched, ...]:
    """Look for a person below some folders; links are not followed.

    Args:
        folders: Where; one below another is searched twice.
        names: What the person is called.

    Raises:
        InputError: for a folder that there is not.
    """
    for folder in folders:
        if not folder.is_dir():
            raise InputError(
                expected="a folder to search",
                got=f"no such folder: {folder}",
                remedy="Check the path.",
                where=Where("--in"),
            )
    return tuple(_searched(folder, frozenset(names)) for folder in folders)


def _searched(folder: Path, names: frozenset[str]) -> Searched:
    found: list[Holding] = []
    unread: list[Unread] = []
    runs = files = 0
    for path in _entries(folder, unread):
        is_folder = path.is_dir()
        try:
            found += _in_run(path, names) if is_folder else _in_file(path, names)
        except _NoTextError as error:
            unread.append(Unread(path, str(error), CONVERT))
        except InputError as error:
            unread.append(Unread(path, f"damaged: {error.got}", OPENED))
        except OSError as error:
            unread.append(Unread(path, error.strerror or str(error), OPENED))
        else:
            runs, files = runs + is_folder, files + (not is_folder)
    return Searched(folder, runs, files, tuple(found), tuple(unread))


def _entries(folder: Path, unread: list[Unread]) -> Iterator[Path]:
    """Runs, and the files that are in none, in the order of their names; links are named as not read."""

    def refused(error: OSError) -> None:
        unread.append(Unread(Path(error.filename), error.strerror or str(error), OPENED))

    for place, below, files in os.walk(folder, onerror=refused):
        below.sort()
        if is_run(Path(place)):
            below.clear()
            yield Path(place)
            continue
        for path in (Path(place) / name for name in sorted([*files, *below])):
            if path.is_symlink():
                unread.append(
                    Unread(path, "a link, which is not followed", "search where it leads with --in")
                )
            elif path.name in files and path.name != LOCK:
                yield path


def _in_run(path: Path, names: frozenset[str]) -> Iterator[Holding]:
    account = RunFolder(path).read(RUN, RunAnswer)
    for person, profile in account.profiles.items():
        if profile in names:
            yield Holding(path, f"as the profile of {person}", run=True)
            return
        if person in names:
            yield Holding(path, "as a person of that name", run=True)
            return


class _NoTextError(Exception):
    """A file whose content cannot be searched for words."""


def _in_file(path: Path, names: frozenset[str]) -> Iterator[Holding]:
    if path.stat().st_size > LARGEST:
        raise _NoTextError("too large")
    text = _text(read_regular(path))
    words = "|".join(map(re.escape, sorted(names)))
    found = re.search(rf"(?<!\w)(?:{words})(?!\w)", text)
    if found:
        yield Holding(path, f"in line {text.count(chr(10), 0, found.start()) + 1}", run=False)


def _text(content: bytes) -> str:
    """What a file says: UTF-8, or UTF-16 that begins with its mark.

    Raises:
        _NoTextError: for whatever else.
    """
    marked = content.startswith((BOM_UTF16_LE, BOM_UTF16_BE))
    try:
        text = content.decode("utf-16" if marked else "utf-8-sig")
    except UnicodeDecodeError:
        raise _NoTextError("no text that can be read") from None
    if "\0" in text:
        raise _NoTextError("no text that can be read")
    return text
