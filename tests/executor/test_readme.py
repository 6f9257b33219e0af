from __future__ import annotations

import re
from pathlib import Path

import pytest


def test_the_example_runs(capsys: pytest.CaptureFixture[str]) -> None:
    """The package's README, in the real world."""
    readme = Path(__file__).parents[2] / "executor" / "README.md"
    (example,) = re.findall(r"```python\n(.*?)```", readme.read_text(encoding="utf-8"), flags=re.DOTALL)
    exec(compile(example, str(readme), "exec"), {})
    printed = capsys.readouterr().out
    assert printed.startswith("('say', 'wave')\n[o] Safe [✓]\n")
    assert "achieved_early because distance" in printed
