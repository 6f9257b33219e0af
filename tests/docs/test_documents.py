"""What the documents say is so: their commands print what stands below them, and their Python runs."""

from __future__ import annotations

import doctest
import os
import re
import shlex
import subprocess
import sys
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest

ROOT = Path(__file__).parents[2]
PAGES = sorted([ROOT / "README.md", *ROOT.glob("docs/**/*.md"), *ROOT.glob("[!.]*/README.md")])
FENCE = re.compile(r"^```(\w+)(?: (\S+))?\n(.*?)^```$", re.MULTILINE | re.DOTALL)
LOOSE = doctest.ELLIPSIS | doctest.NORMALIZE_WHITESPACE


@dataclass(frozen=True)
class Block:
    """A fenced block: its language, a file name where it has one, its text and line."""

    language: str
    file: str | None
    text: str
    line: int


def blocks(page: Path) -> Iterator[Block]:
    text = page.read_text(encoding="utf-8")
    for found in FENCE.finditer(text):
        yield Block(found[1], found[2], found[3], text[: found.start()].count("\n") + 1)


def commands(block: Block) -> Iterator[tuple[str, str]]:
    """Each `$ ` line with the output that stands below it; `...` there stands for anything."""
    for part in re.split(r"^\$ ", block.text, flags=re.MULTILINE)[1:]:
        command, _, output = part.partition("\n")
        yield command, output


def output(line: str, comity: Callable[..., Any]) -> str:
    """What a line of the shell prints; a line that is only `comity`, or that into a file, starts no process.

    Output into a file is what standard output got, and what is printed is the rest.
    """
    words = shlex.split(line)
    if words[0] != "comity" or {"|", "||", "&&", "<", ";"} & set(words):
        done = subprocess.run(line, shell=True, capture_output=True, text=True, check=False)
        return done.stdout + done.stderr
    if ">" not in words:
        said = comity(*words[1:])
        return said.out + said.err
    *words, _, file = words
    said = comity(*words[1:])
    Path(file).write_text(said.out, encoding="utf-8")
    return said.err


@pytest.mark.parametrize("page", PAGES, ids=lambda page: str(page.relative_to(ROOT)))
@pytest.mark.nobody_agreed
def test_a_page_says_what_happens(page, comity, here, monkeypatch):
    """In one folder, in the order of the page: files are written, commands run, Python runs."""
    monkeypatch.setenv("COMITY_HOME", str(here / "kept"))
    monkeypatch.setenv("PATH", f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}")
    names: dict[str, Any] = {"__name__": "__main__"}  # a page goes on where its last block ended
    for block in blocks(page):
        place = f"{page.relative_to(ROOT)}:{block.line}"
        if block.file:
            Path(block.file).write_text(block.text, encoding="utf-8")
        elif block.language == "python":
            exec(compile("\n" * block.line + block.text, str(page), "exec"), names)
        elif block.language == "console":
            for command, expected in commands(block):
                got = output(command, comity)
                assert "Traceback" not in got, f"{place}\n$ {command}\n{got}"
                assert doctest.OutputChecker().check_output(expected, got, LOOSE), (
                    f"{place}\n$ {command}\nexpected:\n{expected}\ngot:\n{got}"
                )


@pytest.mark.parametrize("page", PAGES, ids=lambda page: str(page.relative_to(ROOT)))
def test_no_link_leads_nowhere(page: Path):
    for target in re.findall(r"\]\(([^)#\s]+)(?:#[^)]*)?\)", page.read_text(encoding="utf-8")):
        if not target.startswith(("http://", "https://", "mailto:")):
            assert (page.parent / target).exists(), f"{page.name} links to {target}"
