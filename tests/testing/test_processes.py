"""Processes of Comity seldom look for objects that nobody needs; other programs do as they did."""

from __future__ import annotations

import gc
import subprocess
import sys

import pytest

from comity.system.garbage import MANY
from comity.testing.runner import processes


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
    "imports", ["comity", "comity.testing.pytest_plugin", "comity.testing.runner.running"]
)
def test_what_is_imported_into_other_programs_leaves_them_theirs(imports):
    assert before_collecting(imports) < MANY


def test_a_process_for_tests_collects_seldom():
    with processes.pool(1) as pool:
        assert pool.submit(gc.get_threshold).result()[0] == MANY


def test_what_is_called_comity_in_the_current_folder_is_not_what_runs(tmp_path):
    package = tmp_path / "comity"
    package.mkdir()
    (package / "__init__.py").write_text("raise SystemExit('somebody else is called so, too')")
    script = tmp_path / "beside" / "script.py"
    script.parent.mkdir()
    script.write_text(
        "import os\n"
        "from comity.testing.runner import processes\n"
        "if __name__ == '__main__':\n"
        "    with processes.pool(1) as pool:\n"
        "        print(pool.submit(os.getcwd).result())\n"
    )
    command = [sys.executable, str(script)]
    done = subprocess.run(command, check=False, cwd=tmp_path, capture_output=True, text=True)
    assert (done.stdout, done.stderr) == (f"{tmp_path}\n", "")


def test_so_does_their_server_before_it_imports_the_rest():
    assert processes.NEEDED[0] == "comity.system.garbage"
