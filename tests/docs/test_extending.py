"""What "Where does X go?" says is enough: a command by one new file and two lines of another.

A parameter, a gesture and a robot need no file of Comity; the page's own blocks add them (`test_documents`).
"""

from __future__ import annotations

import os
import re
import subprocess
import sys
from pathlib import Path
from shutil import copytree, ignore_patterns

ROOT = Path(__file__).parents[2]
PAGE = ROOT / "docs/extending.md"


def test_a_command_is_a_file_and_two_lines(tmp_path):
    source = tmp_path / "comity"
    copytree(ROOT / "comity", source, ignore=ignore_patterns("__pycache__"))
    (written,) = re.findall(r"^```py\n(.*?)^```$", PAGE.read_text(encoding="utf-8"), re.MULTILINE | re.DOTALL)
    (source / "commands/sides.py").write_text(written, encoding="utf-8")
    cli = (source / "cli.py").read_text(encoding="utf-8")
    cli = cli.replace("    share,\n", "    share,\n    sides,\n", 1)
    cli = cli.replace("    share.share,\n", "    share.share,\n    sides.sides,\n", 1)
    (source / "cli.py").write_text(cli, encoding="utf-8")
    path = os.pathsep.join((str(tmp_path), os.environ.get("PYTHONPATH", "")))
    done = subprocess.run(
        [sys.executable, "-m", "comity", "sides", "arab_woman"],
        env=os.environ | {"PYTHONPATH": path},
        cwd=tmp_path,
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    sides = dict(line.split() for line in done.stdout.splitlines())
    assert list(sides) == ["front", "left", "right"]
    assert all(0.0 <= float(each) <= 1.0 for each in sides.values())


def test_the_files_that_it_names_are_there():
    text = PAGE.read_text(encoding="utf-8")
    named = re.findall(r"\]\((\.\./[^)#]+)\)", text)
    assert len(named) > 10
    assert all((PAGE.parent / one).exists() for one in named)
