"""Which lines each scenario executes, and what comes of it: only those can notice a change.

All of the project's scenarios judge, those that ship and those of the tests; golden numbers do not.
"""

from __future__ import annotations

import functools
import gc
import json
import time
from collections.abc import Sequence
from dataclasses import asdict, dataclass, field, replace
from pathlib import Path

from tests.mutants.attempt import PROFILES, Library, Turn, settle
from tests.mutants.progress import counted

FILE = "reach.json"
LINES = "lines.json"


@dataclass(frozen=True)
class Reach:
    """One scenario."""

    takes_s: float
    """For one profile, on this machine."""
    profiles: tuple[str, ...]
    """For which it is tried; empty where it has none to choose from."""
    lines: dict[str, list[int]]
    """By file from the root: what it executes for any of the profiles, imports left out."""
    episodes: dict[str, str]
    """By test, the digest by which its golden episode would be held."""
    failures: tuple[str, ...] = ()
    some: dict[str, dict[str, list[str]]] = field(default_factory=dict)
    """By file and line, for which profiles it is executed, where it is not for all of them."""

    first: int = 2
    """So many of the profiles begin, by turns."""

    def through(self, file: str, line: int) -> Reach:
        """The same, but those profiles begin for which a line is executed."""
        these = self.some.get(file, {}).get(str(line), self.profiles)
        others = [name for name in self.profiles if name not in these]
        return replace(self, profiles=(*these, *others), first=min(2, len(these)))


def measure(root: Path, scratch: Path) -> None:
    """Go through the library for every profile, and write what it reaches into the scratch folder.

    Args:
        root: An unchanged copy of the software.
        scratch: For the answer.
    """
    settle(root, scratch)
    from coverage import Coverage

    from tests.scenarios.every import SCENARIOS

    coverage = Coverage(data_file=None, source=[str(root)], config_file=False)
    names = counted("what a scenario reaches,", tuple(SCENARIOS))
    found = {name: _reach(name, coverage, root) for name in names}
    (scratch / LINES).write_text(json.dumps(_covered(coverage, root, found)), encoding="utf-8")
    text = json.dumps({name: asdict(reach) for name, reach in found.items()})
    (scratch / FILE).write_text(text, encoding="utf-8")


def _reach(name: str, coverage: object, root: Path) -> Reach:
    profiles = _profiles(name)
    turns = [Turn(name, profile) for profile in profiles or (None,)]
    library = Library()
    results, lines = [], list[dict[str, list[int]]]()
    for turn in turns:
        forget()
        coverage.erase()
        coverage.start()
        results += library.results(turn)
        coverage.stop()
        lines.append(executed(coverage, root))
    forget()
    quick = Library()
    start = time.process_time()
    list(quick.results(turns[0]))
    takes_s = time.process_time() - start
    failures = tuple(result.text for result in results if not result.good)
    everything, some = _joined(lines, profiles)
    return Reach(takes_s, profiles, everything, dict(library.episodes), failures, some)


def _joined(
    turns: Sequence[dict[str, list[int]]], profiles: Sequence[str]
) -> tuple[dict[str, list[int]], dict[str, dict[str, list[str]]]]:
    """What is executed for any profile, and what for some of them only."""
    everything = {
        file: sorted({line for turn in turns for line in turn.get(file, ())})
        for file in sorted({file for turn in turns for file in turn})
    }
    some: dict[str, dict[str, list[str]]] = {}
    for file, lines in everything.items():
        by_turn = [frozenset(turn.get(file, ())) for turn in turns]
        for line in lines if profiles else ():
            reach = [name for name, there in zip(profiles, by_turn, strict=True) if line in there]
            if len(reach) < len(profiles):
                some.setdefault(file, {})[str(line)] = reach
    return everything, some


def forget() -> None:
    """What is remembered within a process would hide from later scenarios what they reach."""
    for thing in gc.get_objects():
        if isinstance(thing, functools._lru_cache_wrapper):
            thing.cache_clear()


def read(scratch: Path) -> dict[str, Reach]:
    """What `measure` wrote."""
    found = json.loads((scratch / FILE).read_text(encoding="utf-8"))
    return {name: Reach(**{**one, "profiles": tuple(one["profiles"])}) for name, one in found.items()}


def covered(scratch: Path) -> dict[str, tuple[int, int]]:
    """By package, how many lines of its functions the library executes, and how many there are."""
    found = json.loads((scratch / LINES).read_text(encoding="utf-8"))
    return {package: (reached, there) for package, (reached, there) in found.items()}


def _profiles(scenario: str) -> tuple[str, ...]:
    from tests.scenarios.every import cases_of

    cases = [claim.case for claim in cases_of(scenario)]
    own = {case.profile_name for case in cases if case.profile}
    return tuple(name for name in PROFILES if name in own)


def executed(coverage: object, root: Path) -> dict[str, list[int]]:
    """By file from the root: the lines that were executed."""
    data = coverage.get_data()
    return {
        str(Path(file).relative_to(root)): sorted(data.lines(file) or ())
        for file in data.measured_files()
        if Path(file).is_relative_to(root)
    }


def _covered(coverage: object, root: Path, found: dict[str, Reach]) -> dict[str, tuple[int, int]]:
    from tests.mutants.selection import SHARES, at_import, is_judged

    counts: dict[str, tuple[int, int]] = {}
    for package in SHARES:
        reached = there = 0
        for path in sorted((root / package).rglob("*.py")) if (root / package).is_dir() else ():
            file = str(path.relative_to(root))
            if not is_judged(file):
                continue
            _, lines, *_ = coverage.analysis2(str(path))
            inside = set(lines) - at_import(root, file)
            there += len(inside)
            reached += len(inside & {line for one in found.values() for line in one.lines.get(file, ())})
        if there:
            counts[package] = (reached, there)
    return counts
