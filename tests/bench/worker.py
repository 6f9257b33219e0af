"""One contestant's process: reads a task per line, answers with seconds. Standard library only.

Run by another interpreter than the bench itself, so that it must stand alone: `python worker.py MODULE`.
Seconds are of processor time: what else the machine does counts less.
"""

from __future__ import annotations

import importlib
import json
import os
import random
import sys
import tempfile
import time
import tracemalloc
import warnings
from pathlib import Path
from typing import Any

ROWS = 512
"""Different inputs that single calls walk through: an answer kept from the call before is of no use."""


def main() -> None:
    """Answer every line until the input ends."""
    warnings.simplefilter("ignore")
    sys.path.insert(0, str(Path(__file__).resolve().parent / "competitors"))
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)  # what a library leaves behind, such as a log, must not stay
        _answer()
        os.chdir("/")


def _answer() -> None:
    answers, sys.stdout = sys.stdout, sys.stderr  # what a library prints must not look like an answer
    contestant = Contestant(importlib.import_module(sys.argv[1]))
    for line in sys.stdin:
        task = json.loads(line)
        try:
            answer = getattr(contestant, task.pop("do"))(**task)
        except Exception as error:  # whatever a competitor fails with is a result
            answer = {"error": f"{type(error).__name__}: {error}"[:200]}
        print(json.dumps(answer), file=answers, flush=True)


class Contestant:
    """A competitor's module with the system that it was given."""

    def __init__(self, module: Any) -> None:
        self.module = module
        self.system: Any = None
        self.description: Any = None

    def build(self, description: dict[str, Any]) -> dict[str, Any]:
        """Build the system: seconds from the description to the first answer."""
        self.description = description
        rows = self._rows(1)
        start = time.process_time()
        self.system = self.module.System(description)
        self.system.one(rows[0])
        return {"seconds": time.process_time() - start}

    def one(self, calls: int) -> dict[str, Any]:
        """Seconds per call for so many single inputs, and the first few answers."""
        rows = self._rows(ROWS)
        one = self.system.one
        start = time.process_time()
        for i in range(calls):
            one(rows[i % ROWS])
        seconds = (time.process_time() - start) / calls
        return {"seconds": seconds, "answers": [float(one(row)) for row in rows[:2]]}

    def many(self, size: int, calls: int, memory: bool = False) -> dict[str, Any]:
        """Seconds per input for columns of a size; bytes held beyond the columns where asked for."""
        columns = self._columns(size)
        if memory:
            tracemalloc.start()
            self.system.many(columns)
            peak = tracemalloc.get_traced_memory()[1]
            tracemalloc.stop()
            return {"peak_bytes": peak}
        start = time.process_time()
        for _ in range(calls):
            answers = self.system.many(columns)
        seconds = (time.process_time() - start) / calls / size
        return {"seconds": seconds, "answers": [float(answer) for answer in answers[:8]]}

    def _rows(self, count: int) -> list[dict[str, float]]:
        draw = random.Random(0)
        return [
            {name: self._draw(draw, variable) for name, variable in self.description["inputs"].items()}
            for _ in range(count)
        ]

    def _columns(self, size: int) -> dict[str, Any]:
        import numpy as np

        draw = np.random.default_rng(0)
        return {
            name: draw.integers(0, variable["categories"], size)
            if variable["categories"]
            else draw.uniform(*variable["range"], size)
            for name, variable in self.description["inputs"].items()
        }

    @staticmethod
    def _draw(draw: random.Random, variable: dict[str, Any]) -> float:
        if variable["categories"]:
            return draw.randrange(variable["categories"])
        low, high = variable["range"]
        return draw.uniform(low, high)


if __name__ == "__main__":
    main()
