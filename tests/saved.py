"""A run on disk, as what shows it reads it back."""

from __future__ import annotations

from pathlib import Path

from comity.preparation import prepare
from comity.recording import record
from comity.replay.saved_run import SavedRun, read_run
from comity.scenario import load_scenario


def saved(scenario: str | Path, out: Path) -> SavedRun:
    """Run a scenario, without a page or a picture."""
    return read_run(record(prepare(load_scenario(str(scenario))), out=out, views=()).folder)
