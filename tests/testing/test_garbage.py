"""Processes of Comity seldom look for objects that nobody needs; other programs do as they did."""

from __future__ import annotations

import subprocess
import sys

import pytest

from comity.system.garbage import MANY


def before_collecting(imports: str) -> int:
    """How many objects a process makes first that imports this and no more."""
    code = f"import {imports}, gc; print(gc.get_threshold()[0])"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    return int(done.stdout)


def test_the_command_line_collects_seldom():
    assert before_collecting("comity.cli") == MANY


def test_nor_does_it_at_its_end():
    code = "import atexit, gc; atexit.register(lambda: print(len(gc.get_objects()))); import comity.cli"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert int(done.stdout) < 1_000, "what is left to look through"


@pytest.mark.parametrize(
    "imports", ["comity", "comity.testing.pytest_plugin", "comity.testing.runner.result"]
)
def test_what_is_imported_into_other_programs_leaves_them_theirs(imports):
    assert before_collecting(imports) < MANY
