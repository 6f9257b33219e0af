"""A room's README lists its folders and files as they build on one another, in their own words."""

from __future__ import annotations

import ast
import re
import tomllib
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
TOOLS = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["tool"]
CONTRACTS = TOOLS["importlinter"]["contracts"]
ROOMS = {
    "comity_fis": "fis",
    "comity_domain": "domain",
    "comity_executor": "executor",
    "comity_sim2d": "sim2d",
    "comity": "comity",
    "comity.testing": "comity",
}
ROW = re.compile(r"^\| \[[a-z0-9_]+(?:/|\.py)\]\(([^)]+)\) \| (.*) \|$", re.MULTILINE)


def layers(package: str) -> list[str]:
    """The contract's parts, what is built on first."""
    (contract,) = (one for one in CONTRACTS if one.get("containers") == [package])
    return [part for layer in reversed(contract["layers"]) for part in layer.split(" | ")]


def folder(package: str) -> Path:
    room = ROOT / ROOMS[package]
    return room.joinpath(*package.split(".")[1:]) if ROOMS[package] == "comity" else room / package


@pytest.mark.parametrize("package", ROOMS)
def test_the_readme_says_what_each_part_says_of_itself_in_the_order_of_the_contract(package: str):
    readme = ROOT / ROOMS[package] / "README.md"
    told = {(readme.parent / path): words for path, words in ROW.findall(readme.read_text(encoding="utf-8"))}
    here = [path for path in told if path.parent == folder(package)]
    named = [path.stem for path in here]
    assert named == [part for part in layers(package) if part != "__main__"]
    for path in here:
        file = path / "__init__.py" if path.is_dir() else path
        words = ast.get_docstring(ast.parse(file.read_text(encoding="utf-8"))) or ""
        assert told[path] == words.split("\n")[0]
