"""One step of the time cursor on the page of an episode, in a real browser: script and layout."""

from __future__ import annotations

import shutil
import tempfile
from pathlib import Path
from statistics import mean
from typing import TYPE_CHECKING

import yaml

from tests.bench.contest import Bench
from tests.bench.rows import Row

if TYPE_CHECKING:
    from playwright.sync_api import CDPSession

DISPLAY_S = 1 / 60
"""What a step may take if the page is to keep up with a laptop's display."""
PEOPLE = 10
SCRUB = """async (steps) => {
  const scrubber = document.querySelector(".scrubber");
  const costs = [];
  for (let i = 0; i < steps; i++) {
    const start = performance.now();
    scrubber.value = (scrubber.max * i) / steps;
    scrubber.dispatchEvent(new Event("input"));
    document.body.offsetHeight; // lay it out now
    costs.push((performance.now() - start) / 1000);
    await new Promise((done) => requestAnimationFrame(done));
  }
  return costs;
}"""


def run(bench: Bench) -> list[Row]:
    """Scrub through an episode with ten people of whom half are visited."""
    chromium = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")
    if chromium is None:
        return [Row(suite="page", task="scrubbing", contestant="comity", note="no Chromium on this machine")]
    with tempfile.TemporaryDirectory() as folder:
        page, task = _page(Path(folder))
        rounds, spent = _scrubbed(chromium, page, rounds=bench.rounds, steps=30 if bench.quick else 240)
    worst = max(map(max, rounds))
    return [
        Row(
            suite="page",
            task=task,
            contestant="comity",
            seconds=tuple(map(mean, rounds)),
            per="step",
            note=f"a display of 60 Hz leaves {DISPLAY_S * 1000:.1f} ms; slowest step {worst * 1000:.0f} ms",
        ),
        Row(
            suite="page",
            task=f"{task}, CPU",
            contestant="comity",
            seconds=tuple(spent),
            per="step",
            note="of the page's thread, with painting: what else the machine does is not in it",
        ),
    ]


def _page(folder: Path) -> tuple[Path, str]:
    from comity.preparation import prepare
    from comity.recording import record
    from comity.replay import replay_page
    from comity.scenario import load_scenario

    names = [f"person {i}" for i in range(PEOPLE)]
    scenario = {
        "schema_version": 1,
        "name": "scrubbing",
        "place": {"width_m": 14, "height_m": 8},
        "robot": {"at_m": [0.6, 0.6]},
        "people": {name: {"at_m": [2.0 + 2.5 * (i % 5), 2.5 + 3 * (i // 5)]} for i, name in enumerate(names)},
        "goals": [{"greet": name} for name in names[: PEOPLE // 2]],
    }
    path = folder / "scrubbing.scenario.yaml"
    path.write_text(yaml.safe_dump(scenario), encoding="utf-8")
    done = record(prepare(load_scenario(str(path))), out=folder / "run", views=())
    page = folder / "page.html"
    page.write_text(replay_page(done.folder), encoding="utf-8")
    episode = done.episode
    seconds = episode.events[-1].t
    return page, f"scrubbing {seconds:.0f} s, {len(episode.nodes)} nodes, {PEOPLE} people"


def _scrubbed(chromium: str, page: Path, *, rounds: int, steps: int) -> tuple[list[list[float]], list[float]]:
    """Per round what each step took [s], and the mean CPU time of a step [s]."""
    from playwright.sync_api import sync_playwright

    with sync_playwright() as driver:
        browser = driver.chromium.launch(executable_path=chromium, args=["--no-sandbox"])
        view = browser.new_page(viewport={"width": 1280, "height": 800})
        view.goto(page.as_uri())
        view.wait_for_selector("html[data-ready]")
        meter = view.context.new_cdp_session(view)
        meter.send("Performance.enable", {"timeDomain": "threadTicks"})
        costs, spent = [], []
        for _ in range(rounds):
            before = _cpu_s(meter)
            costs.append(view.evaluate(SCRUB, steps))
            spent.append((_cpu_s(meter) - before) / steps)
        browser.close()
    return costs, spent


def _cpu_s(meter: CDPSession) -> float:
    metrics = meter.send("Performance.getMetrics")["metrics"]
    return next(one["value"] for one in metrics if one["name"] == "TaskDuration")
