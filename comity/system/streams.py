"""Standard output and standard error of every kind: of few characters, closed, full.

A terminal or a log may know fewer characters than names, arrows and degrees need.
"""

from __future__ import annotations

import codecs
import errno
import io
import os
import sys
from typing import TYPE_CHECKING, TextIO

if TYPE_CHECKING:
    from _typeshed import ReadableBuffer

STAND_INS = {"→": "->", "⇉": "=>", "─": "-", "“": '"', "”": '"', "°": " deg", "±": "+/-", "ß": "ss"}
"""What is written where a character cannot be; others lose their accents, or are a question mark."""
_FULL = (errno.ENOSPC, errno.EDQUOT, errno.EFBIG, errno.EIO)
"""No room on the disk, for this user, in a file of this size; or the terminal is gone."""
_HANDLER = "comity.stand-ins"


class _Unread(io.FileIO):
    """A file whose reader may go: what is written from then on is dropped, and the writer goes on."""

    def write(self, data: ReadableBuffer, /) -> int:
        """Write to the reader, or to nobody."""
        try:
            return super().write(data)
        except BrokenPipeError:
            drop(self)
            return super().write(data)


def take_any_text() -> None:
    """Have characters that a stream cannot write replaced, and one that is closed or unread swallow all.

    A command whose reader has seen enough, such as `head`, comes to its own end, with its own exit code.
    """
    codecs.register_error(_HANDLER, _stand_in)
    for name in ("stdout", "stderr"):
        stream = getattr(sys, name)
        if stream is None:
            setattr(sys, name, open(os.devnull, "w", encoding="utf-8", newline="\n"))  # noqa: PTH123, SIM115  (as long as we run)
        elif isinstance(stream, io.TextIOWrapper):
            setattr(sys, name, _unread(stream))


def _unread(stream: io.TextIOWrapper) -> io.TextIOWrapper:
    """The same stream, which nobody need read: as Python makes its own, with or without a buffer."""
    if type(getattr(stream.buffer, "raw", stream.buffer)) is not io.FileIO:  # a console, or a test's
        stream.reconfigure(errors=_HANDLER)
        return stream
    stream.flush()
    file = _Unread(stream.fileno(), "w", closefd=False)
    return io.TextIOWrapper(
        file if stream.write_through else io.BufferedWriter(file),
        encoding=stream.encoding,
        errors=_HANDLER,
        line_buffering=stream.line_buffering,
        write_through=stream.write_through,
    )


def is_full(error: OSError) -> bool:
    """Whether it says that what we write has no room; what standard output still holds is then dropped."""
    try:
        sys.stdout.flush()
    except OSError:
        drop(sys.stdout)
        return True
    return error.errno in _FULL


def drop(stream: TextIO | io.FileIO) -> None:
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
