"""Going to a moment of the page, and reading what it shows then."""

from __future__ import annotations

from playwright.sync_api import Page


def cursor_of(page: Page) -> float:
    """The time [s] that the page shows."""
    return float(page.locator(".moment").inner_text().split(" / ")[0])


def go(page: Page, t: float) -> None:
    """Let the page show a time [s]."""
    page.evaluate("t => { location.hash = `#t=${t}`; }", f"{t:.2f}")
    page.wait_for_function(
        "t => document.querySelector('.moment').textContent.startsWith(t)", arg=f"{t:.2f} "
    )
