"""Checks that a name can be printed safely: one line, without control or text direction characters."""

from __future__ import annotations

from comity_fis.errors import WrongValueError

JOINERS = "\u200c\u200d"
"""Joiners in names of several scripts, such as Persian, and in emoji; they are invisible themselves."""


def one_line(name: str) -> str:
    """Return the name unchanged, for use as a field validator.

    Raises:
        WrongValueError: It has line breaks, control or direction characters, or is blank.
    """
    letters = name.translate(dict.fromkeys(map(ord, JOINERS)))
    if not letters.isprintable() or not letters.strip():
        raise WrongValueError(
            expected="a name on one line, of printable characters",
            got=repr(name),
            remedy="Remove line breaks and other control characters, and write something.",
        )
    return name
