"""The picture of the page in the README and the docs: `python tests/page_picture.py` takes it anew."""

from __future__ import annotations

import shutil
import tempfile
from pathlib import Path

from playwright.sync_api import sync_playwright

from comity.preparation import prepare
from comity.recording import record
from comity.replay import replay_page
from comity.scenario import load_scenario

PICTURE = Path(__file__).parents[1] / "docs" / "pictures" / "replay.png"
SCENARIO, AT_S = "two-visits", 20.0
"""The robot greets the second person."""
SCREEN = {"width": 1366, "height": 768}


def main() -> None:
    """Run the scenario, open its page, and keep what a laptop shows."""
    chromium = shutil.which("chromium") or shutil.which("google-chrome")
    with tempfile.TemporaryDirectory() as folder, sync_playwright() as driver:
        done = record(prepare(load_scenario(SCENARIO)), out=Path(folder) / "run", views=())
        page = Path(folder) / "page.html"
        page.write_text(replay_page(done.folder), encoding="utf-8")
        browser = driver.chromium.launch(executable_path=chromium, args=["--no-sandbox", "--disable-gpu"])
        view = browser.new_page(viewport=SCREEN, color_scheme="light")
        view.goto(f"{page.as_uri()}#t={AT_S:.2f}")
        view.wait_for_selector("html[data-ready]")
        view.screenshot(path=PICTURE)
        browser.close()


if __name__ == "__main__":
    main()
