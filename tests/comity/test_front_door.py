"""What `import comity` and the bare command give: errors by name, the version."""

from __future__ import annotations

import subprocess
import sys
from importlib.metadata import version
from pathlib import Path

import pytest
from py_trees.behaviours import Success

import comity as package

MAP = """\
schema_version: 1
name: shut
rooms: {left: {box_m: [0, 0, 4, 4]}, right: {box_m: [4, 0, 4, 4]}}
"""


def test_the_errors_of_its_functions_are_called_by_its_name(here: Path) -> None:
    with pytest.raises(package.InputError, match="nobody-there"):
        package.run("nobody-there")
    (here / "shut.map.yaml").write_text(MAP)
    (here / "s.scenario.yaml").write_text(
        "schema_version: 1\nname: s\nplace: {map: shut.map.yaml}\nrobot: {at_m: [1, 1]}\n"
        "people: {a: {at_m: [2, 2]}}\ngoals: [{greet: a}]\n"
    )
    with pytest.raises(package.InputError, match=r"shut\.map\.yaml:3: room right"):
        package.run("s.scenario.yaml")
    place = "place: {width_m: 5, height_m: 5}"
    (here / "one.scenario.yaml").write_text(
        f"schema_version: 1\nname: one\n{place}\nrobot: {{at_m: [1, 1]}}\n"
        "people: {a: {at_m: [3, 3]}, b: {at_m: [3, 3]}}\ngoals: [{greet: a}]\n"
    )
    with pytest.raises(package.SceneError, match=r"one\.scenario\.yaml:5"):
        package.run("one.scenario.yaml")
    assert "SceneError: " in package.run.__doc__
    assert issubclass(package.SceneError, package.InputError)
    assert issubclass(package.InputError, package.ComityError)
    assert issubclass(package.PlanningFailed, package.ComityError)


def test_an_act_that_no_greeting_has_is_bad_input_and_writes_nothing(here: Path) -> None:
    with pytest.raises(package.InputError, match=r"say, wave, nod.*acts\['juggle'\]"):
        package.run("johanna", acts={"juggle": lambda name, person: Success(name)}, out=here / "run")
    assert list(here.iterdir()) == []


def test_every_name_that_is_promised_is_there_and_no_other() -> None:
    assert set(package.__all__) <= set(dir(package))
    assert all(getattr(package, name) for name in package.__all__)
    with pytest.raises(AttributeError, match="no attribute 'InputErrors'"):
        _ = package.InputErrors


def test_the_import_and_the_version_load_nothing_heavy() -> None:
    script = (
        "import sys, comity\n"
        "assert not [name for name in sys.modules if name.startswith('comity_')]\n"
        "from comity.cli import app\n"
        "try:\n    app(['--version'])\n"
        "except SystemExit as end:\n    assert not end.code\n"
        "heavy = {'numpy', 'shapely', 'pymunk', 'py_trees', 'matplotlib', 'unified_planning', 'pydantic'}\n"
        "assert not heavy & set(sys.modules), heavy & set(sys.modules)\n"
    )
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=False)
    assert (done.returncode, done.stderr) == (0, "")
    assert done.stdout == f"comity {version('comity')}\n"


@pytest.mark.parametrize("command", [(), ("run",), ("profile", "show")])
def test_help_has_a_short_name_too(comity, command) -> None:
    assert comity(*command, "-h").out == comity(*command, "--help").out


def test_a_set_in_the_place_of_a_scenario_is_told_from_a_slip(comity) -> None:
    said = comity("run", "comity-bench-1")
    assert said.code == 2
    assert "comity scenarios --set comity-bench-1" in " ".join(said.err.split())


def test_the_help_names_the_version(comity) -> None:
    assert comity("--version").out == f"comity {version('comity')}\n"
    assert "--version" in comity("--help").out
