"""The library of scenarios against one copy of the software, up to the first test that fails."""

from __future__ import annotations

import json
import os
import resource
import sys
import traceback
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from comity.testing.measuring.measured import Measured
    from comity.testing.runner.result import Result
    from tests.mutants.reach import Reach

PACKAGES = (".", "domain", "executor", "fis", "sim2d")
PROFILES = ("arab_woman", "german_man", "unknown", "british_elder", "japanese_woman")
"""Of the first two most is expected; scenarios begin with the one and the other by turns, where both execute
what was changed."""
BASIC = "tests/empty-room-in-full"
"""For all profiles before anything else: what is inferred for them shows there at once."""
FIRST = (
    "tests/facts-of-many",
    "tests/evidence-of-many",
    "tests/tea-visit-in-full",
    "comity-bench-1/row-of-three",
    "seated-visit",
    "bystander",
    "tests/noisy-room-in-full",
    "tests/group-at-the-window-in-full",
    "noisy-sensor",
    "steps-back",
)
"""They hold most between them."""
LONG_S = 0.8
"""Scenarios that take longer are tried for one profile only, and last."""
MOST_CPU_S = 240
MOST_BYTES = 6_000_000_000
TURNS = len(PROFILES)


@dataclass(frozen=True)
class Turn:
    """A scenario for one profile; None for everybody as written."""

    scenario: str
    profile: str | None


def rounds(scenarios: Mapping[str, Reach], most: int) -> Iterator[list[Turn]]:
    """All scenarios for one profile each, the quick ones first; then for another profile.

    Args:
        scenarios: Those that can notice anything.
        most: For how many profiles each.
    """
    yield [Turn(BASIC, profile) for profile in PROFILES if BASIC in scenarios]
    order = sorted(scenarios.keys() - {BASIC}, key=lambda name: (_rank(name, scenarios[name].takes_s), name))
    for turn in range(most):
        yield list(_round(turn, order, scenarios))


def _round(turn: int, order: Sequence[str], scenarios: Mapping[str, Reach]) -> Iterator[Turn]:
    for i, name in enumerate(order):
        own = scenarios[name].profiles
        if turn < (1 if scenarios[name].takes_s > LONG_S else max(1, len(own))):
            yield Turn(name, own[_place(i, turn, scenarios[name].first) % len(own)] if own else None)


def _place(i: int, turn: int, first: int) -> int:
    """In the first two rounds the first two profiles take turns, where both execute what was changed."""
    return (i + turn) % 2 if turn < 2 and first > 1 else turn


def _rank(name: str, takes_s: float) -> tuple[bool, int, float]:
    return takes_s > LONG_S, FIRST.index(name) if name in FIRST else len(FIRST), takes_s


def attempt(
    root: Path, scratch: Path, scenarios: Mapping[str, Reach], most: int = TURNS, *, thorough: bool = False
) -> None:
    """Try a copy of the software in this process, and leave an answer in the scratch folder.

    Args:
        root: The copy.
        scratch: For the answer, and what the software keeps.
        scenarios: Those that reach what was changed.
        most: For how many profiles each is tried at most.
        thorough: Whether to go on where a round made no difference.
    """
    resource.setrlimit(resource.RLIMIT_CPU, (MOST_CPU_S, MOST_CPU_S))
    resource.setrlimit(resource.RLIMIT_AS, (MOST_BYTES, MOST_BYTES))
    settle(root, scratch)
    try:
        answer = _tried(scenarios, most, thorough=thorough)
    except BaseException as error:
        text = traceback.format_exc()
        caught = "refused" if type(error).__name__ == "InputError" else "crash"
        answer = {"caught": caught, "text": text, "tried": 0, "otherwise": ()}
    (scratch / "answer.json").write_text(json.dumps(answer), encoding="utf-8")


def settle(root: Path, scratch: Path) -> None:
    """Import the software from a copy, and let it keep what it keeps in a folder of its own."""
    paths = [str(root / package) for package in PACKAGES]
    sys.path[:0] = paths
    sys.dont_write_bytecode = True
    own = {"PYTHONPATH": os.pathsep.join(paths), "COMITY_HOME": str(scratch / "kept")}
    os.environ.update({**own, "PYTHONDONTWRITEBYTECODE": "1"})
    os.chdir(scratch)


def _tried(scenarios: Mapping[str, Reach], most: int, *, thorough: bool) -> dict[str, Any]:
    """Up to the first test that fails, or to the round after which no episode came out otherwise."""
    library, tried = Library(), 0
    before = {test: digest for one in scenarios.values() for test, digest in one.episodes.items()}
    otherwise: list[str] = []
    for number, turns in enumerate(rounds(scenarios, most)):
        for result in (result for turn in turns for result in library.results(turn)):
            tried += 1
            if not result.good:
                return {"caught": result.id, "text": result.text, "tried": tried, "otherwise": ()}
        otherwise = [test for test, digest in library.episodes.items() if before.get(test) != digest]
        if number and not otherwise and not thorough:
            break
    return {"caught": None, "text": "", "tried": tried, "otherwise": otherwise}


class Library:
    """The scenarios, and what was measured in them so far: comparisons of profiles see all of it."""

    def __init__(self) -> None:
        self.episodes: dict[str, str] = {}
        """By test, the digest by which its golden episode would be held."""
        self._measured: dict[str, Measured] = {}
        self._profiles: dict[str, list[str]] = {}

    def results(self, turn: Turn) -> Iterator[Result]:
        """The tests that a turn adds."""
        from comity.testing.collection.cases import claims_in
        from comity.testing.runner.result import result_of
        from comity.testing.trials.attempt import attempted
        from comity.testing.trials.case import Across
        from tests.scenarios.every import SCENARIOS

        profiles = self._profiles.setdefault(turn.scenario, [])
        profiles += [turn.profile] if turn.profile else []
        for claim in claims_in(SCENARIOS[turn.scenario], profiles=profiles):
            if claim.id not in self._measured:
                result = result_of(claim, before=self._measured)
                if result.measured:
                    self._measured[claim.id] = result.measured
                    assert not isinstance(claim.case, Across)
                    self.episodes[claim.id] = attempted(claim.case).trace_sha256
                yield result
