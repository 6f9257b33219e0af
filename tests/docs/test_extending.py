"""What "Where does X go?" says is enough: a command takes two files, a metric two, an action three.

A parameter, a gesture and a robot need no file of Comity; the page's own blocks add them (`test_documents`).
"""

from __future__ import annotations

import json
import os
import re
import subprocess
import sys
from pathlib import Path
from shutil import copytree, ignore_patterns
from textwrap import dedent

import pytest

ROOT = Path(__file__).parents[2]
PAGE = ROOT / "docs/extending.md"
SCENARIO = """\
schema_version: 1
name: shows-photos
place: {width_m: 5.0, height_m: 4.0}
robot: {at_m: [1.0, 2.0]}
people:
  johanna: {profile: german_woman, at_m: [3.5, 2.0], facing_deg: 180}
goals:
  - greet: johanna
  - {show: photos, to: johanna}
  - take_leave: johanna
"""


class Copy:
    """A copy of three packages, in which a recipe is followed."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.touched: set[str] = set()
        for package in (ROOT / "comity", ROOT / "domain/comity_domain", ROOT / "sim2d/comity_sim2d"):
            copytree(package, folder / package.name, ignore=ignore_patterns("__pycache__"))

    def edit(self, file: str, before: str, added: str) -> None:
        """Put something before the first place where something stands."""
        path = self.folder / file
        text = path.read_text(encoding="utf-8")
        assert before in text
        path.write_text(text.replace(before, added + before, 1), encoding="utf-8")
        self.touched.add(file)

    def run(self, *arguments: str) -> str:
        """What a module prints."""
        path = os.pathsep.join((str(self.folder), os.environ.get("PYTHONPATH", "")))
        done = subprocess.run(
            [sys.executable, "-m", *arguments],
            env=os.environ | {"PYTHONPATH": path},
            cwd=self.folder,
            capture_output=True,
            text=True,
            check=False,
        )
        assert done.returncode == 0, done.stdout + done.stderr
        return done.stdout


@pytest.fixture
def copy(tmp_path):
    return Copy(tmp_path)


def blocks(language: str) -> list[str]:
    """The blocks of the page in a language, without their indentation."""
    text = PAGE.read_text(encoding="utf-8")
    found = re.findall(rf"^( *)```{language}\n(.*?)^\1```$", text, re.MULTILINE | re.DOTALL)
    return [dedent(block) for _, block in found]


def test_a_command_is_a_file_and_two_lines(copy):
    (copy.folder / "comity/commands/sides.py").write_text(blocks("py")[0], encoding="utf-8")
    copy.edit("comity/cli.py", "    share,\n", "    sides,\n")
    copy.edit("comity/cli.py", "    share.share,\n", "    sides.sides,\n")
    sides = dict(line.split() for line in copy.run("comity", "sides", "arab_woman").splitlines())
    assert list(sides) == ["front", "left", "right"]
    assert all(0.0 <= float(each) <= 1.0 for each in sides.values())


def test_a_metric_is_two_files(copy):
    """It is measured in a run, and defined where `comity metrics` reads it."""
    _, function, field, *_ = blocks("py")
    (line,) = re.findall(r"`(turning_s=.*?)`", PAGE.read_text(encoding="utf-8"))
    metrics = "comity_sim2d/metrics/"
    copy.edit(metrics + "motion.py", "def turns_rad(", f"{function}\n\n")
    copy.edit(metrics + "episode.py", "    stalled_s: float", f"    {field}")
    copy.edit(metrics + "episode.py", "        stalled_s=", f"        {line}\n")
    assert len(copy.touched) == 2

    copy.run("comity", "run", "johanna", "--no-pictures", "--out", "run")
    told = json.loads(copy.run("comity", "metrics", "run", "--json"))
    assert told["definitions"]["turning_s"]["unit"] == "s"
    (value,) = (one["value"] for one in told["figures"] if one["metric"] == "turning_s")
    assert 0.0 < value < 60.0


def test_an_action_of_the_planner_is_three_files(copy):
    """It is in the problem as in the file, in the plan with its reason, and the robot performs it."""
    *_, task, row, field = blocks("py")
    (action,) = blocks("pddl")
    agenda, domain = "comity_domain/problem/agenda.py", "comity_domain/visit.pddl"
    goals = "comity/specification/goals.py"
    copy.edit(agenda, "\n\nPLAIN:", f"\n\n{task}")
    copy.edit(agenda, ')\n"""All kinds of plain tasks', ", Show")
    copy.edit(domain, "    (pause ?t - task)\n", "    (picture ?t - task)\n")
    copy.edit(domain, "\n  ; Say goodbye", f"\n{action}")
    copy.edit(goals, "from comity_fis", "from comity_domain.problem.agenda import Show\n")
    copy.edit(goals, '    "take_leave": _Kind', f"    {row}")
    copy.edit(goals, "    take_leave: Name", f"    {field}")
    assert len(copy.touched) == 3

    same = str(ROOT / "tests/domain/test_visit_domain.py")
    assert "passed" in copy.run("pytest", same, "-q", "-p", "no:cacheprovider", "--rootdir", str(copy.folder))
    (copy.folder / "shows.scenario.yaml").write_text(SCENARIO, encoding="utf-8")
    plan = json.loads(copy.run("comity", "plan", "shows.scenario.yaml", "--json"))
    assert [step["action"] for step in plan["steps"]] == ["Reach_user", "Greet_person", "Show", "Take_leave"]
    shown = plan["steps"][2]
    assert shown["arguments"] == ["robot", "johanna", "photos"]
    assert shown["parameters"] == {"thing": "photos"}
    assert shown["why"]["text"] == "the scenario's picture, without a choice"
    run = ("comity", "run", "shows.scenario.yaml", "--no-pictures", "--out", "run", "--json")
    assert json.loads(copy.run(*run))["outcome"] == "success"
    performed = copy.run("comity", "trace", "run", "--events")
    assert re.search(r"show\(johanna\)", performed)
    assert re.search(r"shown\?\(johanna\)", performed)


def test_the_files_that_it_names_are_there():
    text = PAGE.read_text(encoding="utf-8")
    named = re.findall(r"\]\((\.\./[^)#]+)\)", text)
    assert len(named) > 10
    assert all((PAGE.parent / one).exists() for one in named)
