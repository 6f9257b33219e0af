"""Which runs, tables and other files below some folders hold a person."""

from __future__ import annotations

import os
import re
from collections.abc import Collection, Iterator
from dataclasses import dataclass
from pathlib import Path

from comity.answers import RunAnswer
from comity.output.run_folder import RUN, RunFolder, is_run
from comity.system.own_files import read_regular
from comity_fis import InputError, Where

TEXTS = frozenset({".csv", ".html", ".json", ".jsonl", ".md", ".toml", ".tsv", ".txt", ".yaml", ".yml"})
"""Endings of files that are looked into beside runs, such as the tables of a study."""
LARGEST = 64_000_000
"""Bytes; a larger file is named as not searched."""


@dataclass(frozen=True, slots=True)
class Holding:
    """A run that a person took part in, or a file that names them."""

    path: Path
    as_: str
    """In what way, for a reader."""
    run: bool


@dataclass(frozen=True, slots=True)
class Searched:
    """One folder that was searched."""

    folder: Path
    runs: int
    """Runs that were looked at."""
    files: int
    """Other files that were looked into."""
    found: tuple[Holding, ...]
    unread: tuple[Path, ...]
    """What could not be looked into: damaged, too large, or not ours to read."""


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
    unread: list[Path] = []
    runs = files = 0
    for path in _entries(folder, unread):
        try:
            if path.is_dir():
                runs += 1
                found += _in_run(path, names)
            else:
                files += 1
                found += _in_file(path, names)
        except (OSError, InputError):
            unread.append(path)
    return Searched(folder, runs, files, tuple(found), tuple(unread))


def _entries(folder: Path, unread: list[Path]) -> Iterator[Path]:
    """Runs, and the text files that are in none, in the order of their names."""
    for place, below, files in os.walk(folder, onerror=lambda error: unread.append(Path(error.filename))):
        below.sort()
        if is_run(Path(place)):
            below.clear()
            yield Path(place)
            continue
        yield from (Path(place) / name for name in sorted(files) if Path(name).suffix.lower() in TEXTS)


def _in_run(path: Path, names: frozenset[str]) -> Iterator[Holding]:
    account = RunFolder(path).read(RUN, RunAnswer)
    for person, profile in account.profiles.items():
        if profile in names:
            yield Holding(path, f"as the profile of {person}", run=True)
            return
        if person in names:
            yield Holding(path, "as a person of that name", run=True)
            return


def _in_file(path: Path, names: frozenset[str]) -> Iterator[Holding]:
    if path.stat().st_size > LARGEST:
        raise OSError(27, "too large")
    text = read_regular(path).decode(errors="replace")
    words = "|".join(map(re.escape, sorted(names)))
    found = re.search(rf"(?<!\w)(?:{words})(?!\w)", text)
    if found:
        yield Holding(path, f"in line {text.count(chr(10), 0, found.start()) + 1}", run=False)
