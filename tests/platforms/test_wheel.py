"""What users install: the wheel, in an environment of its own, elsewhere on disk, without Fast Downward."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path
from zipfile import ZipFile

import pytest
from tiny_domain import PLAN, write_tiny_domain

pytestmark = pytest.mark.integration
ROOT = Path(__file__).parents[2]
TESTS = ROOT / "tests"
PACKAGES = {
    "comity": ROOT / "comity",
    **{f"comity_{name}": ROOT / name / f"comity_{name}" for name in ("domain", "executor", "fis", "sim2d")},
}


def uv(*words: object) -> None:
    subprocess.run([sys.executable, "-m", "uv", *map(str, words)], check=True, capture_output=True)


@dataclass(frozen=True)
class Installed:
    """An environment with the wheel, and a folder to work in."""

    environment: Path
    folder: Path

    def run(self, program: str, *words: str) -> subprocess.CompletedProcess[str]:
        """Run one of its programs in the folder."""
        clean = {
            name: value for name, value in os.environ.items() if not name.startswith(("PYTHON", "COMITY"))
        }
        path = self.environment / ("Scripts" if os.name == "nt" else "bin") / program
        return subprocess.run(
            [path, *words], cwd=self.folder, env=clean, capture_output=True, encoding="utf-8", check=False
        )


@pytest.fixture(scope="module")
def wheel(tmp_path_factory: pytest.TempPathFactory) -> Path:
    out = tmp_path_factory.mktemp("wheel")
    uv("build", "--quiet", "--wheel", "--out-dir", out, ROOT)
    (path,) = out.glob("*.whl")
    return path


def installed(path: Path, *packages: object) -> Installed:
    uv("venv", "--quiet", "--python", sys.executable, path / "environment")
    uv("pip", "install", "--quiet", "--python", path / "environment", *packages)
    (path / "work").mkdir()
    return Installed(path / "environment", path / "work")


@pytest.fixture(scope="module")
def alone(wheel: Path, tmp_path_factory: pytest.TempPathFactory) -> Installed:
    """The wheel with what it needs, and nothing else."""
    return installed(tmp_path_factory.mktemp("alone"), wheel)


def test_it_holds_every_file_of_the_packages(wheel: Path) -> None:
    with ZipFile(wheel) as file:
        shipped = {name for name in file.namelist() if ".dist-info/" not in name}
    files = {
        f"{name}/{path.relative_to(folder).as_posix()}"
        for name, folder in PACKAGES.items()
        for path in folder.rglob("*")
        if path.is_file() and path.suffix != ".pyc"
    }
    assert shipped == files - {"comity/README.md"}


def test_it_is_what_is_imported_there_and_no_engine_is(alone: Installed) -> None:
    script = "import comity, importlib.util as u; print(comity.__file__, u.find_spec('up_fast_downward'))"
    done = alone.run("python", "-c", script)
    assert Path(done.stdout.split()[0]).is_relative_to(alone.environment)
    assert done.stdout.split()[1] == "None"


@pytest.mark.parametrize("scenario", ["johanna", "two-visits", "tea-visit"])
def test_a_visit_is_planned_and_played(scenario: str, alone: Installed) -> None:
    done = alone.run("comity", "run", scenario, "--out", scenario, "--no-pictures", "--json")
    assert (done.returncode, done.stderr) == (0, "")
    assert json.loads(done.stdout)["outcome"] == "success"
    plan = json.loads((alone.folder / scenario / "plan.json").read_text(encoding="utf-8"))
    assert (plan["engine"], plan["optimal"]) == ("comity", True)


def test_a_classical_domain_names_the_extra_that_it_needs(alone: Installed) -> None:
    write_tiny_domain(alone.folder)
    done = alone.run("comity", *PLAN)
    assert done.returncode == 1
    assert "pip install 'comity[fast-downward]'" in " ".join(done.stderr.split())
    assert "Traceback" not in done.stderr


def test_the_front_door_tests_pass_there(wheel: Path, tmp_path: Path) -> None:
    """With pytest, Hypothesis and the tests' shared files, and no other file of this repository."""
    testing = installed(tmp_path, wheel, "hypothesis")
    for name in (
        "conftest.py",
        "terminal.py",
        "saved.py",
        "comity/test_front_door.py",
        "comity/test_start.py",
    ):
        shutil.copy(TESTS / name, testing.folder)
    options = ["-o", "pythonpath=.", "--import-mode=importlib", "-p", "no:cacheprovider", "-q"]
    done = testing.run("python", "-m", "pytest", *options, "test_front_door.py", "test_start.py")
    assert done.returncode == 0, done.stdout
