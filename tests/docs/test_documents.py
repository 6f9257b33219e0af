"""What the documents say is so: their commands print what stands below them, and their Python runs."""

from __future__ import annotations

import doctest
import os
import re
import subprocess
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
PAGES = sorted([ROOT / "README.md", *ROOT.glob("docs/**/*.md"), *ROOT.glob("*/README.md")])
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


def run_in(folder: Path, command: list[str] | str) -> subprocess.CompletedProcess[str]:
    """Run a program, or a line for the shell, where `comity` is on the path."""
    environment = {
        **os.environ,
        "COMITY_HOME": str(folder / "kept"),
        "PATH": f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}",
    }
    return subprocess.run(
        command,
        shell=isinstance(command, str),
        cwd=folder,
        env=environment,
        capture_output=True,
        text=True,
        check=False,
    )


@pytest.mark.parametrize("page", PAGES, ids=lambda page: str(page.relative_to(ROOT)))
def test_a_page_says_what_happens(page: Path, tmp_path: Path):
    """In one folder, in the order of the page: files are written, commands run, Python runs."""
    told = ""
    for block in blocks(page):
        place = f"{page.relative_to(ROOT)}:{block.line}"
        if block.file:
            (tmp_path / block.file).write_text(block.text, encoding="utf-8")
        elif block.language == "python":
            told += block.text  # a page goes on where its last block ended
            done = run_in(tmp_path, [sys.executable, "-c", told])
            assert done.returncode == 0, f"{place}\n{done.stderr}"
        elif block.language == "console":
            for command, expected in commands(block):
                done = run_in(tmp_path, command)
                got = done.stdout + done.stderr
                assert "Traceback" not in got, f"{place}\n$ {command}\n{got}"
                assert doctest.OutputChecker().check_output(expected, got, LOOSE), (
                    f"{place}\n$ {command}\nexpected:\n{expected}\ngot:\n{got}"
                )


@pytest.mark.parametrize("page", PAGES, ids=lambda page: str(page.relative_to(ROOT)))
def test_no_link_leads_nowhere(page: Path):
    for target in re.findall(r"\]\(([^)#\s]+)(?:#[^)]*)?\)", page.read_text(encoding="utf-8")):
        if not target.startswith(("http://", "https://", "mailto:")):
            assert (page.parent / target).exists(), f"{page.name} links to {target}"
