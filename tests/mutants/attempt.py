"""The shipped library against one copy of the software, up to the first test that fails."""

from __future__ import annotations

import json
import os
import resource
import sys
import traceback
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from comity.testing.measured import Measured
    from comity.testing.result import Result
    from tests.mutants.reach import Reach

PACKAGES = (".", "domain", "executor", "fis", "sim2d")
PROFILES = ("arab_woman", "german_man", "unknown", "british_elder", "japanese_woman")
"""Each scenario begins with another one of these."""
FIRST = (
    "empty-room",
    "row-of-three",
    "seated-visit",
    "bystander",
    "noisy-room",
    "group-at-the-window",
    "poor-sight",
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


def turns(scenarios: Mapping[str, Reach], most: int) -> Iterator[Turn]:
    """All scenarios for one profile each, the quick ones first; then for another profile.

    Args:
        scenarios: Those that can notice anything.
        most: For how many profiles each.
    """
    order = sorted(scenarios, key=lambda name: (_rank(name, scenarios[name].takes_s), name))
    for turn in range(most):
        for i, name in enumerate(order):
            own = scenarios[name].profiles
            if turn < (1 if scenarios[name].takes_s > LONG_S else max(1, len(own))):
                yield Turn(name, own[(i + turn) % len(own)] if own else None)


def _rank(name: str, takes_s: float) -> tuple[bool, int, float]:
    return takes_s > LONG_S, FIRST.index(name) if name in FIRST else len(FIRST), takes_s


def attempt(root: Path, scratch: Path, scenarios: Mapping[str, Reach], most: int = TURNS) -> None:
    """Try a copy of the software in this process, and leave an answer in the scratch folder.

    Args:
        root: The copy.
        scratch: For the answer, and what the software keeps.
        scenarios: Those that reach what was changed.
        most: For how many profiles each is tried at most.
    """
    resource.setrlimit(resource.RLIMIT_CPU, (MOST_CPU_S, MOST_CPU_S))
    resource.setrlimit(resource.RLIMIT_AS, (MOST_BYTES, MOST_BYTES))
    settle(root, scratch)
    try:
        answer = _tried(turns(scenarios, most))
    except BaseException as error:
        text = traceback.format_exc()
        answer = {"caught": "refused" if type(error).__name__ == "InputError" else "crash", "text": text}
    (scratch / "answer.json").write_text(json.dumps(answer), encoding="utf-8")


def settle(root: Path, scratch: Path) -> None:
    """Import the software from a copy, and let it keep what it keeps in a folder of its own."""
    paths = [str(root / package) for package in PACKAGES]
    sys.path[:0] = paths
    sys.dont_write_bytecode = True
    own = {"PYTHONPATH": os.pathsep.join(paths), "COMITY_HOME": str(scratch / "kept")}
    os.environ.update({**own, "COMITY_CACHE": str(scratch / "cache"), "PYTHONDONTWRITEBYTECODE": "1"})
    os.chdir(scratch)


def _tried(chosen: Iterator[Turn]) -> dict[str, Any]:
    library, tried = Library(), 0
    for turn in chosen:
        for result in library.results(turn):
            tried += 1
            if not result.good:
                return {"caught": result.id, "text": result.text, "tried": tried}
    return {"caught": None, "text": "", "tried": tried}


class Library:
    """The shipped scenarios, and what was measured in them so far: comparisons of profiles see all of it."""

    def __init__(self) -> None:
        self._measured: dict[str, Measured] = {}
        self._profiles: dict[str, list[str]] = {}

    def results(self, turn: Turn) -> Iterator[Result]:
        """The tests that a turn adds."""
        from comity.library import shipped
        from comity.testing.cases import claims_in
        from comity.testing.result import result_of

        profiles = self._profiles.setdefault(turn.scenario, [])
        profiles += [turn.profile] if turn.profile else []
        for claim in claims_in(Path(shipped("scenario")[turn.scenario]), profiles=profiles):
            if claim.id not in self._measured:
                result = result_of(claim, before=self._measured)
                if result.measured:
                    self._measured[claim.id] = result.measured
                yield result
