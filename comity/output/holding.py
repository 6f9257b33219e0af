"""Finds the runs, tables and other files below some folders that contain data about a person."""

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
"""Maximum file size to search [bytes]; larger files are listed as unread."""
CONVERT = "unpack or convert it to UTF-8 text and search again, or look yourself"
OPENED = "look yourself, or make it readable and search again"


@dataclass(frozen=True, slots=True)
class Holding:
    """A run in which a person took part, or a file that names them."""

    path: Path
    as_: str
    """How it contains the person, in words."""
    run: bool


@dataclass(frozen=True, slots=True)
class Unread:
    """A file or folder that could not be searched and may contain the person."""

    path: Path
    why: str
    remedy: str


@dataclass(frozen=True, slots=True)
class Searched:
    """The result for one folder."""

    folder: Path
    runs: int
    """Number of runs searched."""
    files: int
    """Number of other files searched."""
    found: tuple[Holding, ...]
    unread: tuple[Unread, ...]
    """What could not be searched: damaged, too large, not text, a link, or not readable."""


def search(folders: Collection[Path], names: Collection[str]) -> tuple[Searched, ...]:
    """Search for a person below some folders; links are not followed.

    Args:
        folders: The folders; nested ones are searched twice.
        names: Names of the person.

    Raises:
        InputError: A folder does not exist.
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
    """Runs, and files outside runs, in order of their names; links are added to `unread`."""

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
    """Decode text: UTF-8, or UTF-16 with a byte-order mark.

    Raises:
        _NoTextError: It is neither.
    """
    marked = content.startswith((BOM_UTF16_LE, BOM_UTF16_BE))
    try:
        text = content.decode("utf-16" if marked else "utf-8-sig")
    except UnicodeDecodeError:
        raise _NoTextError("no text that can be read") from None
    if "\0" in text:
        raise _NoTextError("no text that can be read")
    return text
