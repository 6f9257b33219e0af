"""Names that can be printed as they are: on one line, in signs that neither steer terminals nor turn text."""

from __future__ import annotations

from comity_fis.errors import WrongValueError

JOINERS = "\u200c\u200d"
"""Of letters in names of several scripts, such as Persian, and in emoji: not printed themselves."""


def one_line(name: str) -> str:
    """The name as it is, for a field that checks it.

    Raises:
        WrongValueError: where it has line breaks, control characters or marks of direction, or is blank.
    """
    letters = name.translate(dict.fromkeys(map(ord, JOINERS)))
    if not letters.isprintable() or not letters.strip():
        raise WrongValueError(
            expected="a name on one line, of printable characters",
            got=repr(name),
            remedy="Remove line breaks and other control characters, and write something.",
        )
    return name
