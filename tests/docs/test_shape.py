"""The shape of the code: each public class has a name of its own, folders are shallow, imports go one way."""

from __future__ import annotations

import ast
import tomllib
from collections import defaultdict
from collections.abc import Iterator
from pathlib import Path

ROOT = Path(__file__).parents[2]
PACKAGES = tuple(
    ROOT / folder
    for folder in (
        "comity",
        "domain/comity_domain",
        "executor/comity_executor",
        "fis/comity_fis",
        "sim2d/comity_sim2d",
    )
)
DEEPEST = 3
"""Folders below a package, one in the other."""


def classes() -> Iterator[tuple[str, Path]]:
    """The public classes at the top of every module, with their files."""
    for package in PACKAGES:
        for file in sorted(package.rglob("*.py")):
            for node in ast.parse(file.read_text(encoding="utf-8")).body:
                if isinstance(node, ast.ClassDef) and not node.name.startswith("_"):
                    yield node.name, file.relative_to(ROOT)


def test_a_public_class_name_exists_once_in_the_project():
    places = defaultdict(list)
    for name, file in classes():
        places[name].append(str(file))
    assert {name: files for name, files in places.items() if len(files) > 1} == {}


def test_folders_are_at_most_three_deep_below_a_package():
    deep = [
        str(file.relative_to(ROOT))
        for package in PACKAGES
        for file in package.rglob("*")
        if file.is_file() and "__pycache__" not in file.parts
        if len(file.relative_to(package).parts) - 1 > DEEPEST
    ]
    assert deep == []


def test_no_import_contract_makes_an_exception_and_one_forbids_circles_in_every_package():
    tools = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["tool"]["importlinter"]
    contracts = tools["contracts"]
    assert [one["name"] for one in contracts if one.get("ignore_imports")] == []
    (circles,) = (one for one in contracts if one["type"] == "acyclic_siblings")
    assert circles["ancestors"] == tools["root_packages"]
    assert "skip_descendants" not in circles
