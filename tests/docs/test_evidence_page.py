"""The page about the rulebook `evidence` says what the rulebook says."""

from __future__ import annotations

from evidence_page import PAGE, page

from comity_fis import load_rulebook


def test_the_page_is_the_rulebook():
    assert PAGE.read_text(encoding="utf-8") == page(load_rulebook("evidence")), (
        "write the page again: python tests/evidence_page.py"
    )
