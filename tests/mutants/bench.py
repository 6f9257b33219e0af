"""A folder with an unchanged copy of the software, and processes that try changed ones."""

from __future__ import annotations

import json
import os
import shutil
import sys
from collections.abc import Mapping
from dataclasses import dataclass
from functools import partial
from multiprocessing.context import ForkServerContext
from pathlib import Path
from typing import Any

from tests.mutants import reach, telling_apart
from tests.mutants.attempt import PROFILES, attempt
from tests.mutants.mutation import Mutation
from tests.mutants.outcome import Outcome
from tests.mutants.progress import say
from tests.mutants.reach import Reach
from tests.mutants.selection import at_import
from tests.mutants.telling_apart import Apart

ROOT = Path(__file__).parents[2]
PACKAGES = ("comity", "domain", "executor", "fis", "sim2d")
TIMEOUT_S = 1800


@dataclass(frozen=True)
class Bench:
    """Where changes are tried."""

    folder: Path
    context: ForkServerContext
    turns: int
    random: int
    """Numbers from which random scenarios are drawn, to tell survivors from the original."""

    def measure(self) -> dict[str, Reach]:
        """What each scenario reaches, and that the library holds without any change."""
        if not (self.folder / "measured" / reach.FILE).exists():
            say("copying the software")
            shutil.rmtree(self.folder / "measured", ignore_errors=True)
            for name in PACKAGES:
                shutil.copytree(ROOT / name, self.unchanged / name, dirs_exist_ok=True)
            self._run(reach.measure, self.unchanged, self._scratch("measured"))
        if self.random and not (self.folder / "random").exists():
            self._run(telling_apart.measure, self.unchanged, self._scratch("random"), range(self.random))
        scenarios = reach.read(self.folder / "measured")
        if failed := [text for one in scenarios.values() for text in one.failures]:
            sys.exit("The library fails without any change:\n" + "\n".join(failed))
        return scenarios

    def tried(self, number: int, mutation: Mutation, scenarios: Mapping[str, Reach]) -> Outcome:
        """The library against one change."""
        root = self.folder / f"copy-{number}"
        shutil.rmtree(root, ignore_errors=True)  # of a run that was stopped
        shutil.copytree(self.unchanged, root, copy_function=os.link)
        mutation.apply(root)
        found = self._attempted(number, root, scenarios)
        apart = None if found["caught"] or not self.random else self.told_apart(number, mutation, root)
        if apart and apart.by is not None:
            found = self._attempted(number, root, scenarios, thorough=True)
        shutil.rmtree(root)
        outcome = Outcome(
            mutation, found["caught"], found["text"], found["tried"], tuple(found["otherwise"]), apart
        )
        say(outcome.row())
        return outcome

    def _attempted(
        self, number: int, root: Path, scenarios: Mapping[str, Reach], *, thorough: bool = False
    ) -> dict[str, Any]:
        """What the library says of a copy; thoroughly: for all profiles, whatever the first ones show."""
        scratch = self._scratch(f"scratch-{number}")
        turns = len(PROFILES) if thorough else self.turns
        self._run(partial(attempt, thorough=thorough), root, scratch, dict(scenarios), turns)
        try:
            found: dict[str, Any] = json.loads((scratch / "answer.json").read_text(encoding="utf-8"))
        except FileNotFoundError:
            found = {"caught": "no end", "text": "", "tried": 0, "otherwise": ()}
        shutil.rmtree(scratch)
        return found

    def told_apart(self, number: int, mutation: Mutation, root: Path) -> Apart:
        """Random episodes of a changed copy against those of the original."""
        known, scratch = self.folder / "random", self._scratch(f"scratch-{number}")
        everywhere = mutation.package == "rulebook" or mutation.line in at_import(
            self.unchanged, mutation.file
        )
        line = None if everywhere else mutation.line
        self._run(telling_apart.tell_apart, root, scratch, known, mutation.file, line)
        try:
            answer = Apart(**json.loads((scratch / telling_apart.ANSWER).read_text(encoding="utf-8")))
        except FileNotFoundError:
            answer = Apart(-1, "no end", 1)
        shutil.rmtree(scratch)
        return answer

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
