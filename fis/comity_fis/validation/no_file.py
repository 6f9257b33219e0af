"""What stands where a file was looked for, in the words of a refusal."""

from __future__ import annotations

from pathlib import Path


def no_file(path: Path) -> str:
    """What stands at a path that leads to no file.

    Raises:
        OSError: if the system does not let us look.
    """
    return "a folder" if path.is_dir() else "no regular file" if path.exists() else "no such file"
