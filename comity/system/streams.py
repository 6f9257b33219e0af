"""Standard output and standard error of every kind: of few characters, closed, full.

A terminal or a log may know fewer characters than names, arrows and degrees need.
"""

from __future__ import annotations

import codecs
import errno
import io
import os
import sys
from typing import TextIO

STAND_INS = {"→": "->", "⇉": "=>", "─": "-", "“": '"', "”": '"', "°": " deg", "±": "+/-", "ß": "ss"}
"""What is written where a character cannot be; others lose their accents, or are a question mark."""
_FULL = (errno.ENOSPC, errno.EDQUOT, errno.EFBIG, errno.EIO)
"""No room on the disk, for this user, in a file of this size; or the terminal is gone."""
_HANDLER = "comity.stand-ins"


def take_any_text() -> None:
    """Have characters that a stream cannot write replaced, and a stream that is closed swallow all."""
    codecs.register_error(_HANDLER, _stand_in)
    for name in ("stdout", "stderr"):
        stream = getattr(sys, name)
        if stream is None:
            setattr(sys, name, open(os.devnull, "w", encoding="utf-8"))  # noqa: PTH123, SIM115  (as long as we run)
        elif isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(errors=_HANDLER)


def is_full(error: OSError) -> bool:
    """Whether it says that what we write has no room; what standard output still holds is then dropped."""
    try:
        sys.stdout.flush()
    except OSError:
        drop(sys.stdout)
        return True
    return error.errno in _FULL


def drop(stream: TextIO) -> None:
    """Let go of what a stream still holds, which has nowhere to go, and of all that follows."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), stream.fileno())


def _stand_in(error: UnicodeError) -> tuple[str | bytes, int]:
    """One character's, and where to go on. A byte of a path that is no text stays that byte, to be copied."""
    from unicodedata import normalize

    if not isinstance(error, UnicodeEncodeError):
        raise error
    character, after = error.object[error.start], error.start + 1
    if "\udc80" <= character <= "\udcff":
        return bytes([ord(character) - 0xDC00]), after
    plain = normalize("NFKD", character).encode("ascii", "ignore").decode()
    return STAND_INS.get(character) or plain or "?", after
