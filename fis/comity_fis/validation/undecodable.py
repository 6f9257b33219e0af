"""Which byte of a file is no text, in the words of a refusal."""

from __future__ import annotations

from comity_fis.errors import Where

REMEDY = "Save the file as UTF-8 text."


def undecodable(error: UnicodeDecodeError, name: str) -> tuple[Where, str]:
    """Where the byte stands, and which it is.

    Args:
        error: What decoding the whole file came to.
        name: Of the file, as the user gave it.
    """
    before = error.object[: error.start]
    where = Where(name, before.count(b"\n") + 1, error.start - before.rfind(b"\n"))
    return where, f"a byte that is no UTF-8 (0x{error.object[error.start]:02x})"
