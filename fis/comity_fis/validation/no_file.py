"""Describes what is at a path where a file was expected, for error messages."""

from __future__ import annotations

from pathlib import Path


def no_file(path: Path) -> str:
    """What is at a path that is not a file.

    Raises:
        OSError: The system denies access.
    """
    return "a folder" if path.is_dir() else "no regular file" if path.exists() else "no such file"
