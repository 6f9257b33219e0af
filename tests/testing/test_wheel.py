"""The plugin in a project elsewhere on disk, from the built wheel: nothing of the checkout is there."""

from __future__ import annotations

import os
import subprocess
import sys
from email.parser import Parser
from pathlib import Path

import pytest
from packaging.requirements import Requirement
from rooms import scenario

ROOT = Path(__file__).parents[2]


@pytest.fixture(scope="module")
def site(tmp_path_factory) -> Path:
    """A folder that holds the wheel's contents."""
    folder = tmp_path_factory.mktemp("wheel")
    pip = [sys.executable, "-m", "pip", "--disable-pip-version-check", "--quiet"]
    built = subprocess.run(
        [*pip, "wheel", "--no-deps", "--wheel-dir", str(folder), str(ROOT)],
        capture_output=True,
        text=True,
        check=False,
        timeout=300,
    )
    wheels = list(folder.glob("comity-*.whl"))
    if not wheels:
        pytest.skip(f"no wheel can be built here: {built.stderr.strip()[-200:]}")
    install = [*pip, "install", "--no-deps", "--no-index", "--target", str(folder / "site"), str(wheels[0])]
    subprocess.run(install, check=True, capture_output=True)
    return folder / "site"


@pytest.fixture
def project(tmp_path: Path) -> Path:
    """A project with a `domain` package of its own, and a scenario test."""
    (tmp_path / "domain").mkdir()
    (tmp_path / "domain" / "__init__.py").write_text('OWN = "a domain that is not Comity\'s"\n')
    (tmp_path / "test_own.py").write_text("import domain\n\n\ndef test_own():\n    assert domain.OWN\n")
    (tmp_path / "room.scenario.yaml").write_text(scenario("duration at most 60 s", "duration at most 1 s"))
    return tmp_path


def run_in(project: Path, site: Path, *command: str) -> subprocess.CompletedProcess[str]:
    environment = {**os.environ, "PYTHONPATH": str(site)}
    return subprocess.run(
        [sys.executable, "-m", *command],
        cwd=project,
        env=environment,
        capture_output=True,
        text=True,
        check=False,
    )


def test_what_the_page_uses_comes_with_comity(site):
    """`pytest -n auto`."""
    (metadata,) = site.glob("comity-*.dist-info/METADATA")
    needed = [Requirement(line) for line in Parser().parsestr(metadata.read_text()).get_all("Requires-Dist")]
    always = {one.name for one in needed if not one.marker or one.marker.evaluate({"extra": ""})}
    assert {"pytest", "pytest-xdist"} <= always


def test_it_is_the_wheel_that_runs(site, project):
    """All five packages come from there, whatever else this Python knows."""
    names = "comity", "comity_domain", "comity_executor", "comity_fis", "comity_sim2d"
    script = f"import importlib as i; [print(i.import_module(name).__file__) for name in {names}]"
    said = subprocess.run(
        [sys.executable, "-c", script],
        cwd=project,
        env={**os.environ, "PYTHONPATH": str(site)},
        capture_output=True,
        text=True,
        check=True,
    ).stdout.split()
    assert len(said) == len(names)
    assert all(Path(file).is_relative_to(site) for file in said)


def test_the_wheel_tests_a_project_elsewhere(site, project):
    """Its own `domain` is imported; the scenario is collected without any configuration, and fails so."""
    done = run_in(project, site, "pytest", "-p", "no:cacheprovider", "--import-mode=prepend")
    assert "2 items" in done.stdout or "collected 2" in done.stdout, done.stdout + done.stderr
    assert "1 failed, 1 passed" in done.stdout
    assert "room.scenario.yaml:14: duration at most 1 s" in done.stdout
    where = run_in(project, site, "comity", "test", "--failed", "")
    assert where.returncode == 1
    assert "1 test: 0 passed, 1 failed" in where.stdout


def test_the_shipped_scenarios_are_in_the_wheel(site, project):
    done = run_in(
        project, site, "comity", "test", "--shipped", "-k", "empty-room and arab_woman", "--failed", ""
    )
    assert "1 test: 1 passed" in done.stdout, done.stdout + done.stderr
