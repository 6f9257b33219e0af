"""The libraries that Comity stands on are in use: with an empty package in place of one, commands fail."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

pytestmark = pytest.mark.integration
NEEDED = {
    "networkx": "draw apartment --graph --out graph.png",
    "py_trees": "run johanna --no-pictures --out run",
    "pymunk": "run johanna --no-pictures --out run",
    "pytest": "test johanna",
    "skfuzzy": "infer german_woman --mode skfuzzy",
    "unified_planning": "plan johanna --validate",
}
"""By library, a command that uses it."""


def comity(folder: Path, words: str, without: str | None = None) -> subprocess.CompletedProcess[str]:
    """A command in a folder, with an empty package in place of a library."""
    environment = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
    if without is not None:
        stub = folder / "stubs" / without
        stub.mkdir(parents=True)
        (stub / "__init__.py").write_text("")
        environment["PYTHONPATH"] = str(stub.parent)
    command = [sys.executable, "-m", "comity", *words.split()]
    return subprocess.run(
        command, cwd=folder, env=environment, capture_output=True, encoding="utf-8", check=False
    )


@pytest.mark.parametrize("library", NEEDED)
def test_the_command_runs_with_the_library(library: str, tmp_path: Path) -> None:
    done = comity(tmp_path, NEEDED[library])
    assert done.returncode == 0, done.stderr


@pytest.mark.parametrize("library", NEEDED)
def test_with_an_empty_package_in_its_place_the_command_fails(library: str, tmp_path: Path) -> None:
    done = comity(tmp_path, NEEDED[library], without=library)
    assert done.returncode != 0
    assert library in done.stdout + done.stderr
