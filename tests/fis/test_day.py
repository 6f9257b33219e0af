"""Days of the calendar, as people write them."""

import contextlib
import re

import pytest
from hypothesis import given
from hypothesis import strategies as st

from comity_fis.errors import WrongValueError
from comity_fis.validation.day import read_day


@given(st.dates())
def test_a_day_reads_back_as_it_is_written(day):
    assert read_day(day.isoformat()) == read_day(day) == day


@given(st.from_regex(re.compile(r"\d{4}-?W?\d{2}-?\d{1,2}", re.ASCII), fullmatch=True))
def test_whatever_is_taken_for_a_day_was_written_as_one(words):
    """No ISO week and no day without its hyphens."""
    with contextlib.suppress(WrongValueError):
        assert read_day(words).isoformat() == words


@pytest.mark.parametrize("words", ["2026-02-30", "2026-W48-6", "20261128", 2026, None, True])
def test_what_is_no_day_is_refused(words):
    with pytest.raises(WrongValueError, match="YYYY-MM-DD"):
        read_day(words)
