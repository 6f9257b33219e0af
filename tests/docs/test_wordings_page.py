"""The page about the wordings that ship says what their files say."""

from __future__ import annotations

from wordings_page import PAGE, page


def test_the_page_is_the_wordings():
    assert PAGE.read_text(encoding="utf-8") == page(), "write the page again: python tests/wordings_page.py"
