"""What users install: the wheel, in an environment of its own, elsewhere on disk, without Fast Downward."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path
from typing import Any
from zipfile import ZipFile

import pytest
import yaml
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


RULE = "if posture is standing then conversational_distance is {}"
"""The rule that the user changes. The greeting depends on the distance, so it changes with it."""
GREETING = (
    "if conversational_distance is far then greeting_gesture is wave",
    "if conversational_distance is close then greeting_gesture is nod",
    "if posture is standing then greeting_modality is both",
)


@pytest.fixture(scope="module")
def planning(wheel: Path, tmp_path_factory: pytest.TempPathFactory) -> Installed:
    """The wheel with Fast Downward, and two rulebooks that differ in one word of one rule.

    What the paper has of culture weighs less in them, so that each profile still has a distance of its own.
    """
    place = installed(tmp_path_factory.mktemp("planning"), f"comity[fast-downward] @ {wheel.as_uri()}")
    shipped = place.environment.glob("**/comity_fis/rulebooks/bruno2017.yaml")
    data = yaml.safe_load(next(shipped).read_text(encoding="utf-8"))
    others = [{**rule, "weight": 0.3} for rule in data["rules"] if "then greeting_" not in rule["rule"]]
    for term in ("close", "far"):
        own = [
            {"rule": rule, "sources": ["design"], "evidence": "design"}
            for rule in (RULE.format(term), *GREETING)
        ]
        text = yaml.safe_dump({**data, "name": "own", "rules": [*own, *others]}, sort_keys=False)
        (place.folder / f"{term}.yaml").write_text(text, encoding="utf-8")
    return place


@pytest.mark.parametrize("engine", ["comity", "fast-downward-opt"])
@pytest.mark.parametrize("profile", ["arab_woman", "german_woman", "arab_man", "german_man"])
def test_a_changed_rule_is_planned_reached_and_named(planning: Installed, profile: str, engine: str) -> None:
    """From the rule to the parameters of both actions, the distance reached and the cause in the trace."""

    def answer(*words: str) -> dict[str, Any]:
        done = planning.run("comity", *words, "--json")
        assert done.returncode == 0, done.stderr
        return dict(json.loads(done.stdout))

    distances, gestures = {}, {}
    for term in ("close", "far"):
        out = f"{term}-{profile}-{engine}"
        options = ("--as", f"johanna={profile}", "--rulebook", f"{term}.yaml", "--engine", engine)
        run = answer("run", "johanna", *options, "--out", out, "--no-pictures")
        plan = json.loads((planning.folder / out / "plan.json").read_text(encoding="utf-8"))
        assert plan["engine"] == engine
        reach, greet = plan["steps"]
        assert (reach["action"], greet["action"]) == ("Reach_user", "Greet_person")
        inferred = answer("infer", profile, "--rulebook", f"{term}.yaml", "--set", "posture=standing")
        values = {name: one["value"] for name, one in inferred["parameters"].items()}
        distances[term] = reach["parameters"]["conversational_distance"]
        gestures[term] = greet["parameters"]["greeting_gesture"]
        assert distances[term] == pytest.approx(values["conversational_distance"], abs=1e-9)
        (visit,) = run["visits"]
        assert visit["distance_actual_m"] == pytest.approx(distances[term], abs=0.01)
        assert visit["greeting"][-1] == gestures[term]
        causes = [
            {cause["kind"]: cause for cause in event["because"]}
            for event in answer("trace", out, "--events")["events"]
            if any(cause["text"].startswith("conversational_distance") for cause in event["because"])
        ]
        assert {cause["parameter"]["value"] for cause in causes} == {round(distances[term], 6)}
        assert {cause["step"]["text"] for cause in causes} == {"Reach_user(robot, johanna, front)"}
        assert {cause["rule"]["text"] for cause in causes} == {RULE.format(term)}
    assert distances["far"] > distances["close"] + 0.1
    assert gestures == {"close": "nod", "far": "wave"}


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
