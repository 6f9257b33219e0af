"""Processor time of whole commands from the shell to its prompt, with all that they import and start."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Sequence
from tempfile import TemporaryDirectory

from tests.bench.contest import Bench
from tests.bench.rows import Row

COMMANDS = {
    "run johanna": ("run", "johanna"),
    "run johanna --no-pictures": ("run", "johanna", "--no-pictures"),
    "run johanna --gif": ("run", "johanna", "--gif"),
    "plan johanna": ("plan", "johanna"),
    "infer german_man": ("infer", "german_man"),
    "--help": ("--help",),
}


def run(bench: Bench) -> list[Row]:
    """Each command once a round, in turn, in a folder of its own."""
    rounds = [{name: _seconds(words) for name, words in COMMANDS.items()} for _ in range(bench.rounds)]
    first = next(iter(COMMANDS))
    return [
        Row(
            suite="commands",
            task="from command to prompt",
            contestant=name,
            seconds=tuple(one[name] for one in rounds),
            ratios=() if name == first else tuple(one[name] / one[first] for one in rounds),
        )
        for name in COMMANDS
    ]


def _seconds(words: Sequence[str]) -> float:
    """Of the process and of those that it started."""
    with TemporaryDirectory() as folder:
        before = os.times()
        subprocess.run(
            [sys.executable, "-m", "comity", *words], cwd=folder, stdout=subprocess.DEVNULL, check=True
        )
        after = os.times()
    return after.children_user + after.children_system - before.children_user - before.children_system
