"""A folder with an unchanged copy of the software, and processes that try changed ones."""

from __future__ import annotations

import json
import os
import shutil
import sys
from collections.abc import Mapping
from dataclasses import dataclass
from multiprocessing.context import ForkServerContext
from pathlib import Path

from tests.mutants import reach
from tests.mutants.attempt import attempt
from tests.mutants.mutation import Mutation
from tests.mutants.outcome import Outcome
from tests.mutants.reach import Reach

ROOT = Path(__file__).parents[2]
PACKAGES = ("comity", "domain", "executor", "fis", "sim2d")
TIMEOUT_S = 1800


@dataclass(frozen=True)
class Bench:
    """Where changes are tried."""

    folder: Path
    context: ForkServerContext
    turns: int

    def measure(self) -> dict[str, Reach]:
        """What each scenario reaches, and that the library holds without any change."""
        if not (self.folder / "measured" / reach.FILE).exists():
            shutil.rmtree(self.folder / "measured", ignore_errors=True)
            for name in PACKAGES:
                shutil.copytree(ROOT / name, self.unchanged / name, dirs_exist_ok=True)
            self._run(reach.measure, self.unchanged, self._scratch("measured"))
        scenarios = reach.read(self.folder / "measured")
        if failed := [text for one in scenarios.values() for text in one.failures]:
            sys.exit("The library fails without any change:\n" + "\n".join(failed))
        return scenarios

    def tried(self, number: int, mutation: Mutation, scenarios: Mapping[str, Reach]) -> Outcome:
        """The library against one change."""
        root, scratch = self.folder / f"copy-{number}", self._scratch(f"scratch-{number}")
        shutil.rmtree(root, ignore_errors=True)  # of a run that was stopped
        shutil.copytree(self.unchanged, root, copy_function=os.link)
        shutil.copytree(self.folder / "measured" / "cache", scratch / "cache")
        mutation.apply(root)
        self._run(attempt, root, scratch, dict(scenarios), self.turns)
        try:
            found = json.loads((scratch / "answer.json").read_text(encoding="utf-8"))
        except FileNotFoundError:
            found = {"caught": "no end", "text": "", "tried": 0, "otherwise": ()}
        shutil.rmtree(root)
        shutil.rmtree(scratch)
        outcome = Outcome(mutation, found["caught"], found["text"], found["tried"], tuple(found["otherwise"]))
        print(outcome.row(), file=sys.stderr, flush=True)
        return outcome

    @property
    def unchanged(self) -> Path:
        """The software as it is."""
        return self.folder / "unchanged"

    def _scratch(self, name: str) -> Path:
        shutil.rmtree(self.folder / name, ignore_errors=True)
        (self.folder / name).mkdir(parents=True)
        return self.folder / name

    def _run(self, *task: object) -> None:
        """A task in a process of its own, which ends."""
        process = self.context.Process(target=task[0], args=task[1:])
        process.start()
        process.join(TIMEOUT_S)
        process.kill()
        process.join()
