"""Decides whether a user's text is a shipped name or the path of a file."""

from __future__ import annotations

from pathlib import Path


def looks_like_a_file(name: str, path: Path) -> bool:
    """Whether the text denotes a file rather than a shipped name.

    Args:
        name: The text.
        path: The text as a path.
    """
    try:
        return bool(Path(name).suffix) or "/" in name or "\\" in name or path.exists()
    except (OSError, ValueError):  # shipped names have no NUL byte and are not too long for the system
        return True
