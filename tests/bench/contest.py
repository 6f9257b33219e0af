"""Contestants in processes of their own, timed in turn."""

from __future__ import annotations

import json
import subprocess
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from tests.bench.environment import NotInstalledError, interpreter
from tests.bench.rows import Row

WORKER = Path(__file__).parent / "worker.py"


@dataclass(frozen=True, slots=True)
class Bench:
    """How thoroughly to measure, and against whom."""

    quick: bool = False
    ours_only: bool = False

    @property
    def rounds(self) -> int:
        """Of every comparison."""
        return 1 if self.quick else 7

    @property
    def round_s(self) -> float:
        """About how long one contestant's turn lasts."""
        return 0.01 if self.quick else 0.15

    def contestants(self, *known: Contestant) -> list[Contestant]:
        """Those that take part; ours are those without an environment of their own."""
        return [one for one in known if one.environment is None or not self.ours_only]


@dataclass(slots=True)
class Contestant:
    """A module of `competitors`, in its environment."""

    name: str
    module: str
    environment: str | None = None
    """None: the bench's own."""
    _process: subprocess.Popen[str] | None = field(default=None, repr=False)

    def ask(self, do: str, **task: Any) -> dict[str, Any]:
        """Have it do something.

        Raises:
            NotInstalledError: if it cannot be had here.
            ContestantError: if it cannot do that.
        """
        if self._process is None:
            command = [str(interpreter(self.environment)), str(WORKER), self.module]
            self._process = subprocess.Popen(
                command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True
            )
        assert self._process.stdin
        assert self._process.stdout
        try:
            self._process.stdin.write(json.dumps({"do": do, **task}) + "\n")
            self._process.stdin.flush()
        except BrokenPipeError:
            raise ContestantError("ended without an answer") from None
        line = self._process.stdout.readline()
        if not line:
            raise ContestantError("ended without an answer")
        answer: dict[str, Any] = json.loads(line)
        if "error" in answer:
            raise ContestantError(answer["error"])
        return answer

    def close(self) -> None:
        """End its process."""
        if self._process is not None:
            self._process.communicate()
            self._process = None


class ContestantError(Exception):
    """A contestant could not do a task; the message says how it ended."""


def in_turn(
    turns: dict[str, Callable[[], float]], *, rounds: int, suite: str, task: str, per: str = "call"
) -> list[Row]:
    """Time everybody once per round; ratios are to the first one.

    Args:
        turns: By contestant, what takes one turn and gives the seconds per unit.
        rounds: How often.
        suite: For the rows.
        task: For the rows.
        per: What a unit is.
    """
    seconds: dict[str, list[float]] = {name: [] for name in turns}
    for _ in range(rounds):
        for name, turn in turns.items():
            seconds[name].append(turn())
    first, *_ = seconds
    return [
        Row(
            suite=suite,
            task=task,
            contestant=name,
            seconds=tuple(times),
            per=per,
            ratios=()
            if name == first
            else tuple(its / base for its, base in zip(times, seconds[first], strict=True)),
        )
        for name, times in seconds.items()
    ]


def calls_for(turn_s: float, call_s: float) -> int:
    """How many calls fill a turn; at least one."""
    return max(1, round(turn_s / max(call_s, 1e-9)))


def built(
    contestants: Sequence[Contestant], description: dict[str, Any], *, suite: str, task: str
) -> tuple[list[Contestant], list[Row]]:
    """The contestants that built the system, and a row for each.

    The row says how long it took and how far its answers lie from ours, or why it could not.
    """
    ready: list[Contestant] = []
    rows: list[Row] = []
    expected: list[float] = []
    for contestant in contestants:
        try:
            seconds = contestant.ask("build", description=description)["seconds"]
            answers = contestant.ask("one", calls=1)["answers"]
        except (NotInstalledError, ContestantError) as error:
            rows.append(Row(suite=suite, task=task, contestant=contestant.name, note=str(error)))
            continue
        ready.append(contestant)
        ours = next((row.seconds[0] for row in rows if row.seconds), None)
        expected = expected or answers
        error = max(abs(answer - one) for answer, one in zip(answers, expected, strict=True))
        ratios = () if ours is None else (seconds / ours,)
        rows.append(
            Row(
                suite=suite,
                task=task,
                contestant=contestant.name,
                seconds=(seconds,),
                per="system",
                ratios=ratios,
                note=f"answers within {error:.2g} of ours" if ratios else "imports included",
            )
        )
    return ready, rows
