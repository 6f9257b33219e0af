"""The libraries that Comity stands on are in use: with a stub in place of one, commands and tests fail."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

pytestmark = pytest.mark.integration
TESTS = Path(__file__).parents[1]
NEEDED = {
    "networkx": "draw apartment --graph --out graph.png",
    "py_trees": "run johanna --no-pictures --out run",
    "pymunk": "run johanna --no-pictures --out run",
    "pytest": "test johanna",
    "skfuzzy": "infer german_woman --mode skfuzzy",
    "unified_planning": "plan johanna --validate",
}
"""By library, a command that uses it."""
TESTED = {
    "networkx": "sim2d/test_topology.py",
    "py_trees": "executor/test_decorators.py",
    "pymunk": "sim2d/test_world.py",
    "pytest": "testing/test_plugin.py",
    "skfuzzy": "fis/test_to_skfuzzy.py",
    "unified_planning": "domain/test_visit_domain.py",
}
"""By library, tests of what it does for Comity."""


def python(folder: Path, *words: str, stub: Path | None = None) -> subprocess.CompletedProcess[str]:
    """A module in a folder, with a package in place of a library."""
    environment = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
    if stub is not None:
        environment["PYTHONPATH"] = str(stub.parent)
    command = [sys.executable, "-m", *words]
    return subprocess.run(
        command, cwd=folder, env=environment, capture_output=True, encoding="utf-8", check=False
    )


def package(folder: Path, name: str) -> Path:
    """An empty one."""
    path = folder / "stubs" / name
    path.mkdir(parents=True)
    (path / "__init__.py").write_text("")
    return path


@pytest.mark.parametrize("library", NEEDED)
def test_the_command_runs_with_the_library(library: str, tmp_path: Path) -> None:
    done = python(tmp_path, "comity", *NEEDED[library].split())
    assert done.returncode == 0, done.stderr


@pytest.mark.parametrize("library", NEEDED)
def test_with_an_empty_package_in_its_place_the_command_fails(library: str, tmp_path: Path) -> None:
    done = python(tmp_path, "comity", *NEEDED[library].split(), stub=package(tmp_path, library))
    assert done.returncode != 0
    assert library in done.stdout + done.stderr


def test_where_pytest_does_nothing_no_scenario_test_passes(tmp_path: Path) -> None:
    stub = package(tmp_path, "pytest")
    shutil.copy(TESTS / "platforms/nothing.py", stub / "__init__.py")
    done = python(tmp_path, "comity", *NEEDED["pytest"].split(), stub=stub)
    assert done.returncode == 2
    assert "expected pytest to look for tests" in done.stderr
    assert "passed" not in done.stdout


@pytest.mark.parametrize("library", TESTED)
def test_with_one_that_does_nothing_its_tests_fail(library: str, tmp_path: Path) -> None:
    """Although everything can be imported from it; without pytest no test can be run at all."""
    stub = package(tmp_path, library)
    shutil.copy(TESTS / "platforms/nothing.py", stub / "__init__.py")
    options = ("-q", "-x", "-p", "no:cacheprovider")
    done = python(TESTS.parent, "pytest", f"tests/{TESTED[library]}", *options, stub=stub)
    assert done.returncode != 0
    assert " failed" in done.stdout or " error" in done.stdout or library == "pytest"
