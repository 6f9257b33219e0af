"""Going to a moment of the page, and reading what it shows then."""

from __future__ import annotations

from pathlib import Path

from playwright.sync_api import Page

CONTRAST = (Path(__file__).parent / "contrast.js").read_text(encoding="utf-8")


def cursor_of(page: Page) -> float:
    """The time [s] that the page shows."""
    return float(page.locator(".moment").inner_text().split(" / ")[0])


def go(page: Page, t: float) -> None:
    """Let the page show a time [s]."""
    page.evaluate("t => { location.hash = `#t=${t}`; }", f"{t:.2f}")
    page.wait_for_function(
        "t => document.querySelector('.moment').textContent.startsWith(t)", arg=f"{t:.2f} "
    )


def weak_texts(page: Page) -> list[str]:
    """Texts that stand out too little from their ground, as the browser shows them now."""
    return page.evaluate(f"({CONTRAST.rstrip().rstrip(';')})()")
