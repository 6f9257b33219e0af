"""Whether what a user wrote is the name of something that ships, or the path of a file."""

from __future__ import annotations

from pathlib import Path


def looks_like_a_file(name: str, path: Path) -> bool:
    """Whether a user who wrote this meant a file rather than a shipped name.

    Args:
        name: As it is written.
        path: Where it leads as a path.
    """
    try:
        return bool(Path(name).suffix) or "/" in name or "\\" in name or path.exists()
    except (OSError, ValueError):  # no name that ships has a NUL byte, or is too long for the system
        return True
