"""A day of the calendar, as people write it: YYYY-MM-DD."""

from __future__ import annotations

import re
from datetime import date

from comity_fis.errors import WrongValueError

_WRITTEN = re.compile(r"\d{4}-\d{2}-\d{2}", re.ASCII)


def read_day(words: object) -> date:
    """The day that words say; a date stays what it is.

    Raises:
        WrongValueError: if it is none.
    """
    if isinstance(words, date):
        return words
    if isinstance(words, str) and _WRITTEN.fullmatch(words):
        try:
            return date.fromisoformat(words)
        except ValueError:  # as 2026-02-30
            pass
    raise WrongValueError(
        expected="a day as YYYY-MM-DD", got=repr(words), remedy="Write for example 2010-06-01."
    )
