from __future__ import annotations

import json
import os
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

from comity_domain import make_plan
from comity_fis.record import plain

PROGRAM = """
import json, runpy, sys
from dataclasses import replace
from comity_domain import make_plan
from comity_fis.record import plain
random_request = runpy.run_path(sys.argv[1])["random_request"]
print(json.dumps([plain(replace(make_plan(random_request(4, seed)), request=None)) for seed in (1, 2, 4)]))
"""


def test_the_same_request_gives_the_same_plan_under_another_hash_seed(random_request, tmp_path):
    """Here with the seed of this process, there with one of its own."""
    plans = [make_plan(random_request(4, seed)) for seed in (1, 2, 4)]
    here = json.dumps([plain(replace(plan, request=None)) for plan in plans])
    conftest = str(Path(__file__).with_name("conftest.py"))
    environment = {**os.environ, "PYTHONHASHSEED": "12345", "PYTHONPATH": os.pathsep.join(sys.path)}
    command = [sys.executable, "-c", PROGRAM, conftest]
    there = subprocess.run(command, env=environment, cwd=tmp_path, capture_output=True, text=True, check=True)
    assert there.stdout == here + "\n"
    assert there.stderr == ""
