"""Robust standard output and standard error: limited encodings, closed streams, full disks.

The encoding of a terminal or log may lack characters that names, arrows and degrees need.
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
"""Replacements for characters that cannot be encoded; others lose their accents, or become a question
mark."""
_FULL = (errno.ENOSPC, errno.EDQUOT, errno.EFBIG, errno.EIO)
"""Errors of a full disk, an exhausted quota, a too large file, or a closed terminal."""
_HANDLER = "comity.stand-ins"


class _Unread(io.FileIO):
    """A file whose reader may close it: later output is dropped, and the writer continues."""

    def write(self, data: ReadableBuffer, /) -> int:
        """Write to the reader, if it still reads."""
        try:
            return super().write(data)
        except BrokenPipeError:
            drop(self)
            return super().write(data)


def take_any_text() -> None:
    """Replace characters that a stream cannot encode, and drop output of closed streams.

    A command whose reader has stopped reading, such as `head`, still ends normally, with its own exit code.
    """
    codecs.register_error(_HANDLER, _stand_in)
    for name in ("stdout", "stderr"):
        stream = getattr(sys, name)
        if stream is None:
            setattr(sys, name, open(os.devnull, "w", encoding="utf-8", newline="\n"))  # noqa: PTH123, SIM115  (as long as we run)
        elif isinstance(stream, io.TextIOWrapper):
            setattr(sys, name, _unread(stream))


def _unread(stream: io.TextIOWrapper) -> io.TextIOWrapper:
    """The stream with an optional reader, buffered or not as Python creates it."""
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
    """Whether an error means a full target; data still buffered for standard output is then dropped."""
    try:
        sys.stdout.flush()
    except OSError:
        drop(sys.stdout)
        return True
    return error.errno in _FULL


def drop(stream: TextIO | io.FileIO) -> None:
    """Drop a stream's buffered data and all further output."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), stream.fileno())


def _stand_in(error: UnicodeError) -> tuple[str | bytes, int]:
    """Replacement of one character, and the index to continue at. A path's undecodable byte is kept."""
    from unicodedata import normalize

    if not isinstance(error, UnicodeEncodeError):
        raise error
    character, after = error.object[error.start], error.start + 1
    if "\udc80" <= character <= "\udcff":
        return bytes([ord(character) - 0xDC00]), after
    plain = normalize("NFKD", character).encode("ascii", "ignore").decode()
    return STAND_INS.get(character) or plain or "?", after
