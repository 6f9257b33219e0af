"""Fast Downward as an oracle: what a visit costs at least, by the PDDL that is exported."""

from __future__ import annotations

import re
import subprocess
import sys
from importlib.util import find_spec
from pathlib import Path
from tempfile import TemporaryDirectory

import pytest

from comity_domain import VisitRequest, plan_pddl

PROOF = "iterated([eager_wastar([ff()],w=1),eager_wastar([lmcut()],w=2),astar(lmcut())],pass_bound=false)"
"""Two quick searches, whose plans bound nothing, and then the proof.

A* with LM-cut expands hundreds of states where blind A* expands 150 000 (12 people, three sides each): every
person still to be visited is a landmark with a least price.
"""
NO_PLAN = (10, 11, 12)
"""Exit codes."""

needs_fast_downward = pytest.mark.skipif(
    find_spec("up_fast_downward") is None, reason="Fast Downward is not installed: comity[fast-downward]"
)


def driver() -> Path:
    """The script that runs it."""
    package = find_spec("up_fast_downward")
    assert package is not None
    assert package.submodule_search_locations
    return Path(package.submodule_search_locations[0]) / "downward" / "fast-downward.py"


def cost_by_fast_downward(request: VisitRequest, *, time_limit_s: float = 60.0) -> int | None:
    """The cost of a cheapest plan, deadlines not counted, in cm; None where there is none."""
    with TemporaryDirectory() as name:
        folder = Path(name)
        for file, text in zip(("domain.pddl", "problem.pddl"), plan_pddl(request), strict=True):
            (folder / file).write_text(text, encoding="utf-8")
        words = ["--plan-file", "plan", "domain.pddl", "problem.pddl", "--search", PROOF]
        command = [sys.executable, str(driver()), *words]
        done = subprocess.run(command, cwd=folder, timeout=time_limit_s, capture_output=True, check=False)
        if done.returncode in NO_PLAN:
            return None
        assert done.returncode == 0, done.stdout
        texts = "\n".join(file.read_text("utf-8") for file in folder.glob("plan.*"))
    return min(map(int, re.findall(r"^; cost = (\d+) ", texts, re.MULTILINE)))
