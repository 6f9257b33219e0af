"""Locates the byte of a file that is not text, for error messages."""

from __future__ import annotations

from comity_fis.errors import Where

REMEDY = "Save the file as UTF-8 text."


def undecodable(error: UnicodeDecodeError, name: str) -> tuple[Where, str]:
    """The location of the byte, and its value in words.

    Args:
        error: The error from decoding the whole file.
        name: Name of the file, as the user gave it.
    """
    before = error.object[: error.start]
    where = Where(name, before.count(b"\n") + 1, error.start - before.rfind(b"\n"))
    return where, f"a byte that is no UTF-8 (0x{error.object[error.start]:02x})"
