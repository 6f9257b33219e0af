"""What a command loads: only what it uses, so that a prompt comes back soon."""

from __future__ import annotations

import json
import subprocess
import sys

import pytest

DRAWING, STATISTICS = {"matplotlib", "PIL"}, {"pandas", "scipy", "skfuzzy"}
WORLD = {"networkx", "numpy", "pydantic", "pymunk", "py_trees", "rich", "shapely", "unified_planning"}
LOADED = """
import atexit, json, sys
atexit.register(lambda: print(json.dumps(sorted(sys.modules)), file=sys.stderr))
sys.argv = ["comity", *sys.argv[1:]]
from comity.__main__ import main
main()
"""


@pytest.mark.parametrize(
    ("words", "unused"),
    [
        (("--help",), WORLD | DRAWING | STATISTICS),
        (("run", "johanna", "--no-pictures"), DRAWING | STATISTICS),
        (("run", "johanna"), STATISTICS),
    ],
    ids=["help", "a run without a picture", "a run"],
)
def test_a_command_loads_no_library_that_it_does_not_use(words, unused, here):
    done = subprocess.run(
        [sys.executable, "-c", LOADED, *words], check=False, capture_output=True, text=True, encoding="utf-8"
    )
    assert done.returncode == 0, done.stderr
    assert unused & set(json.loads(done.stderr.splitlines()[-1])) == set()


@pytest.mark.parametrize(("said", "threads"), [({}, "1"), ({"OPENBLAS_NUM_THREADS": "4"}, "4")], ids=str)
def test_linear_algebra_runs_in_one_thread_unless_the_user_says_otherwise(said, threads):
    script = "import os, comity.cli; print(os.environ['OPENBLAS_NUM_THREADS'])"
    done = subprocess.run(
        [sys.executable, "-c", script], check=True, capture_output=True, text=True, env={"PATH": "", **said}
    )
    assert done.stdout.strip() == threads
