"""The bench runs: a smoke run without competitors, whose figures mean nothing."""

import json
import os
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).parents[2]


def test_a_quick_round_measures_ours_against_numpy_by_hand_and_agrees_with_it(tmp_path):
    out = tmp_path / "bench.json"
    command = [
        sys.executable,
        "-m",
        "tests.bench",
        "--quick",
        "--ours-only",
        "--suite",
        "inference",
        "--out",
        str(out),
    ]
    path = os.pathsep.join(str(ROOT / room) for room in ("fis", "domain", "executor", "sim2d", "."))
    done = subprocess.run(
        command, cwd=ROOT, env={**os.environ, "PYTHONPATH": path}, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr
    rows = json.loads(out.read_text(encoding="utf-8"))["rows"]
    by_hand = [row for row in rows if row["contestant"] == "numpy by hand"]
    assert by_hand
    assert all(row["median_ratio"] > 0 for row in by_hand)
    agreement = {
        (row["contestant"], row["task"]): float(row["note"].split()[2])
        for row in rows
        if row["note"].startswith("answers within")
    }
    assert agreement["numpy by hand", "case 2, load"] < 1e-12
    assert agreement["plain Python by hand", "case 2, load"] < 1e-12
    assert agreement["numpy grid by hand", "Gaussians, load"] < 1e-3
    assert {"case 2, one", "bruno2017, one", "Gaussians, one", "6 inputs, 540 rules, one"} <= {
        row["task"] for row in rows
    }
    assert "times the first" in done.stdout


def test_what_a_competitor_leaves_behind_is_gone_with_its_worker(tmp_path):
    """ir-sim writes its log into the folder that it is imported in."""
    (tmp_path / "litterer.py").write_text(
        "from pathlib import Path\n"
        "Path('file.log').write_text('hello')\n"
        "class System:\n"
        "    def __init__(self, description): self.folder = Path.cwd()\n"
        "    def one(self, row): return float((self.folder / 'file.log').exists())\n"
    )
    (here := tmp_path / "here").mkdir()
    done = subprocess.run(
        [sys.executable, str(ROOT / "tests" / "bench" / "worker.py"), "litterer"],
        cwd=here,
        env={**os.environ, "PYTHONPATH": str(tmp_path), "TMPDIR": str(tmp_path)},
        input='{"do": "build", "description": {"inputs": {}}}\n{"do": "one", "calls": 1}\n',
        capture_output=True,
        text=True,
        check=True,
    )
    assert json.loads(done.stdout.splitlines()[1])["answers"] == [1.0, 1.0]
    assert {path.name for path in tmp_path.iterdir()} - {"__pycache__"} == {"here", "litterer.py"}
    assert not list(here.iterdir())
