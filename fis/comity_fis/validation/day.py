"""Parses a calendar date: YYYY-MM-DD."""

from __future__ import annotations

import re
from datetime import date

from comity_fis.errors import WrongValueError

_WRITTEN = re.compile(r"\d{4}-\d{2}-\d{2}", re.ASCII)


def read_day(words: object) -> date:
    """A date from text; a date is returned unchanged.

    Raises:
        WrongValueError: It is not a date.
    """
    if isinstance(words, date):
        return words
    if isinstance(words, str) and _WRITTEN.fullmatch(words):
        try:
            return date.fromisoformat(words)
        except ValueError:  # such as 2026-02-30
            pass
    raise WrongValueError(
        expected="a day as YYYY-MM-DD", got=repr(words), remedy="Write for example 2010-06-01."
    )
