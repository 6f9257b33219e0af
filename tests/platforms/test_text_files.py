"""A text file has the same characters and the same bytes on every platform."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
PACKAGES = ("comity", "domain", "executor", "fis", "sim2d")


def opened_as_text(package: str) -> Iterator[tuple[str, dict[str | None, str], bool]]:
    """The calls that open text files: where they are, their keywords, and whether they write."""
    for path in (ROOT / package).rglob("*.py"):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.Call) and (mode := text_mode(node)):
                keywords = {each.arg: ast.unparse(each.value) for each in node.keywords}
                yield f"{path.relative_to(ROOT)}:{node.lineno}", keywords, mode != "r"


def text_mode(call: ast.Call) -> str | None:
    """The mode of a call that opens a text file; None of any other call."""
    words = [each.value for each in call.args if isinstance(each, ast.Constant)]
    mode = str(words[-1]) if words else "r"
    match call.func:
        case ast.Attribute(attr="read_text"):
            return "r"
        case ast.Attribute(attr="write_text"):
            return "w"
        case ast.Attribute(attr="open") if len(call.args) == len(
            words
        ):  # of a path: others name what to open
            return None if "b" in mode else mode
        case ast.Attribute(attr="fdopen") | ast.Name(id="open"):
            return None if "b" in mode else mode
    return None


@pytest.mark.parametrize("package", PACKAGES)
def test_every_text_file_names_its_encoding_and_is_written_with_the_line_ends_of_unix(package: str) -> None:
    """Left to themselves, both differ on Windows."""
    for where, keywords, writes in opened_as_text(package):
        assert (where, keywords.get("encoding")) != (where, None)
        named = (where, keywords.get("encoding"), keywords.get("newline"))
        assert not writes or named == (where, "'utf-8'", r"'\n'")


def test_the_calls_are_found() -> None:
    found = [writes for package in PACKAGES for _, _, writes in opened_as_text(package)]
    assert found.count(True) >= 8
    assert found.count(False) >= 8
