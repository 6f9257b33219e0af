"""What lies below a folder, and behind links in it: what pytest looks into, and each real folder once."""

from __future__ import annotations

import os
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass
from fnmatch import fnmatch
from pathlib import Path

PASSED_OVER = (
    "*.egg",
    ".*",
    "_darcs",
    "build",
    "CVS",
    "dist",
    "node_modules",
    "venv",
    "{arch}",
    "__pycache__",
)
"""Names of folders that pytest does not look into: `norecursedirs` as it comes, and what Python caches."""
_OF_ENVIRONMENTS = ("pyvenv.cfg", "conda-meta/history")
"""Files by which pytest knows a virtual environment, which it leaves out, too."""


@dataclass(frozen=True, slots=True)
class Below:
    """What lies below a folder, each in the order of its paths."""

    files: tuple[Path, ...]
    """All that is no folder."""
    folders: tuple[Path, ...]
    barred: tuple[Path, ...] = ()
    """Folders that the system does not let us look into."""


def below(folder: Path, *, file_suffix: str, folder_suffix: str) -> Below:
    """The files and the folders below a folder whose names end so.

    Of several ways to a folder, the one of fewest links counts. pytest takes every way, and goes round in
    circles of links until the system stops it. A pipe, or a link to nowhere, is for whoever reads it to
    refuse by its name, where pytest passes it over.
    """
    files: list[Path] = []
    folders: list[Path] = []
    barred: list[Path] = []
    seen: set[tuple[int, int]] = set()
    real, linked = [folder], deque[Path]()
    while real or linked:  # links wait until all that is there without them has been seen
        here = real.pop() if real else linked.popleft()
        for entry in _entries(here, seen, barred):
            path = Path(entry.path)
            if _granted(entry.is_dir):
                if not _passed_over(path):
                    (linked if entry.is_symlink() else real).append(path)
                    folders += [path] if path.name.endswith(folder_suffix) else []
            elif entry.name.endswith(file_suffix):
                files.append(path)
    return Below(tuple(sorted(files)), tuple(sorted(folders)), tuple(sorted(barred)))


def _entries(folder: Path, seen: set[tuple[int, int]], barred: list[Path]) -> list[os.DirEntry[str]]:
    """What is in a folder that was not seen yet; one that the system does not let us look into is noted."""
    try:
        known = folder.stat()
        if (known.st_dev, known.st_ino) in seen:
            return []
        seen.add((known.st_dev, known.st_ino))
        with os.scandir(folder) as entries:
            return sorted(entries, key=lambda entry: entry.name)
    except PermissionError:
        barred.append(folder)
    except OSError:  # it was removed meanwhile, or is a link to itself
        pass
    return []


def _passed_over(folder: Path) -> bool:
    return any(fnmatch(folder.name, over) for over in PASSED_OVER) or any(
        _granted((folder / name).is_file) for name in _OF_ENVIRONMENTS
    )


def _granted(question: Callable[[], bool]) -> bool:
    """The system's answer; no where it refuses one, as of a link to itself."""
    try:
        return question()
    except OSError:
        return False
